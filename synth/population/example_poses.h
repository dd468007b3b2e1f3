// Examples for learning skinning weights: one person in many poses, with deformations that linear
// blend skinning cannot represent.
#pragma once

#include <filesystem>
#include <vector>

#include "config/settings.h"
#include "core/random.h"
#include "synth/bodies/body_source.h"

namespace vitruvia {

struct ExamplePoseSettings {
  int poses = 70;
  std::vector<std::filesystem::path> motions;  // key-frame files; none: joint limits only
  double motion_share = 0.25;                  // of the poses; the others from the joint limits
  double limits_used = 0.8;     // share of each joint's range round its middle that is drawn from
  double bulge_m = 0.012;       // at a joint bent by a right angle, outwards in its fold
  double bulge_reach_m = 0.07;  // its standard deviation along the surface
  int weight_diffusion = 4;     // steps that the deforming weights differ from the rig's
  double noise_m = 0.0;         // standard deviation of every coordinate

  void Describe(Fields& fields);
};

// Poses of a skeleton, drawn from motions and joint limits.
std::vector<JointPose> DrawPoses(const ExamplePoseSettings& settings, const Skeleton& skeleton,
                                 RandomStream& random);

// The body's surface in that pose: dual quaternions by the body's weights, then bulges at elbows
// and knees along the surface's normals, then noise.
std::vector<Vector3f> Deform(const ExamplePoseSettings& settings, const BodyModel& body,
                             const JointPose& pose, RandomStream& random);

}  // namespace vitruvia
