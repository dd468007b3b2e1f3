// What the tests of Dynamic share: the shipped skeleton, random joint values, a posed small body.
#pragma once

#include <string>

#include "core/random.h"
#include "methods/dynamic/kinematic_tree.h"
#include "methods/dynamic/surface.h"
#include "methods/dynamic/tracked_mesh.h"
#include "support/tiny_body.h"

namespace vitruvia::dynamic {

inline SkeletonFile HumanSkeleton() {
  return ReadSkeletonFile(std::string(VITRUVIA_SOURCE_DIR) + "/configs/skeletons/human.json");
}

inline Rigidd CameraFromStart() {
  return {Vector3d(1.0, -1.0, -1.0).asDiagonal(), Vector3d(0.05, 0.9, 2.8)};
}

// Values inside the limits, hinges within ±range_rad and slides within ±4 cm.
inline Eigen::VectorXd RandomTheta(const KinematicTree& tree, double range_rad,
                                   std::uint64_t seed) {
  RandomStream random(seed, "theta");
  Eigen::VectorXd theta(tree.joint_count());
  for (int k = 0; k < tree.joint_count(); ++k) {
    const double range = tree.joints()[k].type == JointType::kHinge ? range_rad : 0.04;
    theta[k] = random.Uniform(-range, range);
  }
  tree.Clamp(theta);
  return theta;
}

inline BodyModel BlendedBody() {
  // Weights blended further than the boxes' own, so that most vertices have two to four bones.
  BodyModel body = TinyBody(2);
  Eigen::MatrixXf weights = Dense(body.weights, kBoneCount), sums = weights;
  for (int step = 0; step < 2; ++step) {
    for (const Triangle& t : body.rest.triangles) {
      for (int k = 0; k < 3; ++k) sums.row(t[k]) += weights.row(t[(k + 1) % 3]);
    }
    weights = sums.array().colwise() / sums.rowwise().sum().array();
    sums = weights;
  }
  body.weights = Sparsified(weights);
  return body;
}

template <class Scalar>
Surface<Scalar> SurfaceOf(const TrackedMesh& mesh) {
  return Surface<Scalar>(mesh.weights, mesh.vertices, mesh.normals);
}

template <class Scalar>
void PoseAll(const TreePose& pose, Surface<Scalar>& surface) {
  const auto motions = MotionsOf<Scalar>(pose);
  for (const Patch& patch : surface.layout.patches) PosePatch(patch, motions, surface);
}

}  // namespace vitruvia::dynamic
