// Determines the up and front directions in the axes of a motion capture file.
//
// Two things may differ: the axes of the file's world, in which the performer moves, and those of
// its rest pose, in which every rotation is zero. In most files the rest pose is a figure that
// stands upright in the world. In others, all bones lie along one axis, or the root has to be
// rotated for the figure to be upright. The world's up direction is then taken from the frames.
#pragma once

#include <string>

#include "config/settings.h"
#include "synth/motions/mocap_joints.h"

namespace vitruvia {

// The up direction of the file's world.
enum class UpAxis { kFromFile, kPlusX, kMinusX, kPlusY, kMinusY, kPlusZ, kMinusZ };

void DescribeUpAxis(Fields& fields, UpAxis& up_axis);

struct MocapAxes {
  Matrix3<double> subject_from_world;  // of the frames' positions and the root's rotation
  Matrix3<double> subject_from_rest;   // of the rest pose
  std::string up;                      // of the world: "+y", or the direction
  std::string evidence;                // the observations in rest pose and frames
  std::string warning;                 // "" if rest pose and frames agree
};

// A clip whose rest pose is an upright figure, and the axes. If the file's rest pose is not an
// upright figure, the frame nearest to a standing T-pose replaces it: the rest pose only defines
// the zero of rotations. DataError with the evidence if neither the rest pose nor any frame is an
// upright figure, or if rest pose and frames contradict each other.
MocapAxes FindAxes(MocapClip& clip, const MocapJoints& joints, UpAxis up_axis);

// The clip with the pose of one frame as its rest pose: the same positions in all frames.
void TakeAsRestPose(MocapClip& clip, std::size_t frame);

}  // namespace vitruvia
