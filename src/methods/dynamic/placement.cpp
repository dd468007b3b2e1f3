#include "methods/dynamic/placement.h"

#include <algorithm>
#include <limits>

#include <Eigen/Cholesky>

#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia::dynamic {
namespace {

template <class Predicate>
Vector3d MeanWhere(const std::vector<Vector3f>& points, const Predicate& is_counted) {
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  for (const Vector3f& p : points) {
    if (!is_counted(p)) continue;
    sum += p.cast<double>();
    count += 1.0;
  }
  return sum / std::max(count, 1.0);
}

}  // namespace

Rigidd UprightPlacement(const std::vector<Vector3f>& rest_vertices,
                        const std::vector<Vector3f>& cloud) {
  const Vector3d cloud_mean = MeanWhere(cloud, [](const Vector3f&) { return true; });
  const Vector3d front_mean =
      MeanWhere(rest_vertices, [](const Vector3f& p) { return p.z() > 0.0f; });
  float top = std::numeric_limits<float>::infinity(), crown = -top;
  for (const Vector3f& p : cloud) top = std::min(top, p.y());
  for (const Vector3f& p : rest_vertices) crown = std::max(crown, p.y());
  Rigidd placement;
  placement.rotation = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  placement.translation = {cloud_mean.x() - front_mean.x(), double{top} + double{crown},
                           cloud_mean.z() + front_mean.z()};
  return placement;
}

TreeStart StartFrom(const KinematicTree& tree, const BoneTransforms& camera_from_rest) {
  return Approached(tree, camera_from_rest,
                    {camera_from_rest.front(), Eigen::VectorXd::Zero(tree.joint_count())});
}

TreeStart Approached(const KinematicTree& tree, const BoneTransforms& camera_from_rest,
                     TreeStart start) {
  constexpr int kIterations = 50;
  constexpr double kDamping = 1e-3;
  const int count = tree.joint_count();
  // The pelvis is in place already.
  const std::vector<int>& root = tree.ChainOf(static_cast<int>(BoneId::kPelvis));
  const auto is_free = [&](int joint) {
    return std::find(root.begin(), root.end(), joint) == root.end();
  };
  TreePose pose;
  for (int i = 0; i < kIterations; ++i) {
    tree.Pose(start.camera_from_start, start.theta, pose);
    Eigen::MatrixXd normal = kDamping * Eigen::MatrixXd::Identity(count, count);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
    for (int bone = 1; bone < kBoneCount; ++bone) {
      const Matrix3<double> turn = camera_from_rest[bone].rotation *
                                   pose.camera_from_rest[bone].ToRigid().rotation.transpose();
      const Vector3d wanted = LogSo3<double>(turn);
      for (const int j : tree.ChainOf(bone)) {
        if (!is_free(j)) continue;
        const Vector3d axis = pose.twists[j].head<3>();
        right[j] += axis.dot(wanted);
        for (const int k : tree.ChainOf(bone)) {
          if (is_free(k)) normal(j, k) += axis.dot(pose.twists[k].head<3>());
        }
      }
    }
    start.theta += normal.ldlt().solve(right);
    tree.Clamp(start.theta);
  }
  return start;
}

}  // namespace vitruvia::dynamic
