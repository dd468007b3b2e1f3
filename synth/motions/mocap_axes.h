// Which way is up and which way the performer faces, in the axes of a motion capture file.
//
// Two things may differ: the axes of the file's world, in which the performer moves, and those of
// its rest pose, in which every rotation is zero. In most files the rest pose is a figure that
// stands upright in the world. In others it is not: bones that all lie along one axis, or a figure
// that a rotation of the root has to raise. The world's up is then taken from the frames.
#pragma once

#include <string>

#include "config/settings.h"
#include "synth/motions/mocap_joints.h"

namespace vitruvia {

// Which way is up in the file's world.
enum class UpAxis { kFromFile, kPlusX, kMinusX, kPlusY, kMinusY, kPlusZ, kMinusZ };

void DescribeUpAxis(Fields& fields, UpAxis& up_axis);

struct MocapAxes {
  Matrix3<double> subject_from_world;  // of the frames' positions and the root's rotation
  Matrix3<double> subject_from_rest;   // of the rest pose
  std::string up;                      // of the world: "+y", or the direction
  std::string evidence;                // what was seen in rest pose and frames
  std::string warning;                 // "" where rest pose and frames agree
};

// A clip whose rest pose is an upright figure, and the axes. If the file's own rest pose is none,
// the frame that comes nearest to a standing T-pose takes its place: the rest pose is nothing but
// the place from which rotations are counted. DataError with the evidence if the rest pose is no
// figure and no frame is, or if rest pose and frames contradict each other.
MocapAxes FindAxes(MocapClip& clip, const MocapJoints& joints, UpAxis up_axis);

// The clip with the pose of one frame as its rest pose: the same positions in all frames.
void TakeAsRestPose(MocapClip& clip, std::size_t frame);

}  // namespace vitruvia
