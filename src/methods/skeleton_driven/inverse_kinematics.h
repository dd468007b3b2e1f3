// The pose of a skeleton of fixed bone lengths whose joints come nearest to given positions.
//
// min Σ_p ρ(|x_p(q) − y_p|² / σ²) + w Σ_b |Log(R̄_bᵀ R_b)|²_{Σ_b}, over the pelvis' position and a
// rotation of each bone. x_p are the posed points, y_p the given ones, of which some may be
// missing; ρ is Huber's; R_b are rotations against the parent, R̄_b and Σ_b those of captured motion
// (body/pose_statistics.h), which decide what positions leave open: the twist of a straight arm, a
// hand without a tip. Levenberg–Marquardt with analytic rows, from a pose in closed form: the trunk
// by the best rigid motion of its joints, every other bone by the smallest turn against its parent
// that points it at its far end.
#pragma once

#include <optional>

#include "body/body_points.h"
#include "config/settings.h"
#include "math/rigid.h"

namespace vitruvia::skeleton_driven {

struct InverseKinematicsSettings {
  double point_deviation_m = 0.03;
  double huber_m = 0.06;
  double pose_weight = 0.001;
  int iterations = 10;
  double stop_rad = 1e-3;

  void Describe(Fields& fields);
};

using GivenPoints = std::array<std::optional<Vector3<double>>, kBodyPointCount>;  // camera frame

struct SkeletonPose {
  std::array<Matrix3<double>, kBoneCount> rotations;          // camera_from_bone
  Vector3<double> pelvis_position = Vector3<double>::Zero();  // camera frame, metres
};
BoneTransforms ToTransforms(const Skeleton& skeleton, const SkeletonPose& pose);

struct FoundPose {
  SkeletonPose pose;
  int iterations = 0;
  bool converged = false;
  double point_energy = 0.0, pose_energy = 0.0;
  double median_m = 0.0;  // distance of the posed points from the given ones
};

// The residuals at a pose and their derivatives by a step: translation of the pelvis, then for each
// bone the rotation vector (camera frame) by which it and all below it turn about its posed joint.
struct InverseKinematicsRows {
  static constexpr int kParameters = 3 + 3 * kBoneCount;
  static constexpr int kPointRows = 3 * kBodyPointCount, kPoseRows = 3 * (kBoneCount - 1);

  Eigen::Matrix<double, kPointRows + kPoseRows, 1> residuals;  // zero for points that are missing
  Eigen::Matrix<double, kPointRows + kPoseRows, kParameters, Eigen::RowMajor> rows;
};

class InverseKinematics {
 public:
  InverseKinematics(const Skeleton& skeleton, const InverseKinematicsSettings& settings);

  // Nothing if fewer than three of the trunk's points are given.
  std::optional<FoundPose> Find(const GivenPoints& points) const;

  // The parts, for tests. Huber's weights are not in the rows.
  std::optional<SkeletonPose> ClosedForm(const GivenPoints& points) const;
  InverseKinematicsRows Rows(const SkeletonPose& pose, const GivenPoints& points) const;
  SkeletonPose Stepped(const SkeletonPose& pose, const Eigen::VectorXd& step) const;

 private:
  struct Energy {
    double points = 0.0, pose = 0.0;
    double total() const { return points + pose; }
  };
  Energy EnergyOf(const InverseKinematicsRows& rows) const;

  Skeleton skeleton_;
  InverseKinematicsSettings settings_;
  BodyPointPositions rest_;
};

}  // namespace vitruvia::skeleton_driven
