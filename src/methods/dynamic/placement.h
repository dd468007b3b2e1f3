// Initial placement of the body in the first frame.
#pragma once

#include <vector>

#include "geometry/mesh.h"
#include "math/rigid.h"
#include "math/vector.h"
#include "methods/dynamic/kinematic_tree.h"

namespace vitruvia::dynamic {

// camera_from_subject of an upright body that faces the camera: its crown at the highest point of
// the cloud, and the mean of its front vertices at the cloud's mean. Also works if only the upper
// part of the body is in view. Vertices in the subject frame (y up, z to the front), cloud in the
// camera frame, metres; neither may be empty.
Rigidd UprightPlacement(const std::vector<Vector3f>& rest_vertices,
                        const std::vector<Vector3f>& cloud);

// The tree's start frame and joint values that best match a pose given by its bones' motions: the
// pelvis' motion is that of the start frame, and the joint values, within their limits, minimise
// the squared rotation vectors between wanted and obtained bone rotations (camera frame).
struct TreeStart {
  Rigidd camera_from_start;
  Eigen::VectorXd theta;
};
TreeStart StartFrom(const KinematicTree& tree, const BoneTransforms& camera_from_rest);
// The same from known joint values near the wanted ones; the pelvis stays where `start` has it.
TreeStart Approached(const KinematicTree& tree, const BoneTransforms& camera_from_rest,
                     TreeStart start);

}  // namespace vitruvia::dynamic
