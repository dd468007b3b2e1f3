#include "methods/skeleton_driven/inverse_kinematics.h"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "body/pose_statistics.h"
#include "math/rigid_fit.h"
#include "math/rotation.h"
#include "math/rotation_derivatives.h"
#include "math/statistics.h"

namespace vitruvia::skeleton_driven {
namespace {

constexpr double kFirstDamping = 1e-4, kDampingFactor = 10.0, kLargestDamping = 1e6;
constexpr std::size_t kLeastTrunkPoints = 3;

using enum BoneId;
// Joints that move with the trunk as if it were rigid.
constexpr std::array kTrunkPoints{kPelvis,    kAbdomen,    kChest,        kNeck,
                                  kLeftThigh, kRightThigh, kLeftUpperArm, kRightUpperArm};
constexpr std::array kTrunkBones{kPelvis, kAbdomen, kChest};

// The point at the far end of each bone that has one beyond it on a chain; −1 for trunk bones.
std::array<int, kBoneCount> MakeFarEnds() {
  std::array<int, kBoneCount> ends;
  ends.fill(-1);
  for (int p = kBodyPointCount - 1; p > 0; --p) ends[BodyPoints()[p].parent] = p;
  for (const BoneId bone : kTrunkBones) ends[static_cast<std::size_t>(bone)] = -1;
  return ends;
}

// The last bone of the chain whose rotations move a point.
int LastMoverOf(const BodyPointInfo& point) {
  return point.is_tip ? point.bone : Bones()[point.bone].parent;
}

double HuberEnergy(double norm, double limit) {
  return norm <= limit ? norm * norm : limit * (2.0 * norm - limit);
}

}  // namespace

void InverseKinematicsSettings::Describe(Fields& f) {
  f.Number("point_deviation_m", point_deviation_m,
           {.meaning = "what a joint's position is expected to be off by",
            .unit = "m",
            .min = 1e-4,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "neither paper A nor the trackers of that time say"});
  f.Number("huber_m", huber_m,
           {.meaning = "a joint farther from its position than this is pulled by a constant force",
            .unit = "m",
            .min = 1e-3,
            .max = 10.0,
            .origin = Origin::kGuessed});
  f.Number("pose_weight", pose_weight,
           {.meaning = "weight of how usual the pose is",
            .min = 1e-6,
            .max = 1e3,
            .origin = Origin::kGuessed});
  f.Integer(
      "iterations", iterations,
      {.meaning = "steps of the fit at most", .min = 0, .max = 1000, .origin = Origin::kGuessed});
  f.Number("stop_rad", stop_rad,
           {.meaning = "stop when every bone turned by less in a step",
            .unit = "rad",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
}

BoneTransforms ToTransforms(const Skeleton& skeleton, const SkeletonPose& pose) {
  BoneTransforms camera_from_rest(kBoneCount);
  for (int b = 0; b < kBoneCount; ++b) {
    const int parent = Bones()[b].parent;
    const Vector3<double> joint =
        parent < 0 ? pose.pelvis_position
                   : Vector3<double>(camera_from_rest[parent] * skeleton.joints[b]);
    camera_from_rest[b] = {pose.rotations[b], joint - pose.rotations[b] * skeleton.joints[b]};
  }
  return camera_from_rest;
}

InverseKinematics::InverseKinematics(const Skeleton& skeleton,
                                     const InverseKinematicsSettings& settings)
    : skeleton_(skeleton), settings_(settings), rest_(RestPoints(skeleton)) {}

std::optional<FoundPose> InverseKinematics::Find(const GivenPoints& points) const {
  const std::optional<SkeletonPose> start = ClosedForm(points);
  if (!start) return {};
  FoundPose found{*start};
  InverseKinematicsRows rows = Rows(found.pose, points);
  Energy energy = EnergyOf(rows);
  double damping = kFirstDamping;
  const double huber = settings_.huber_m / settings_.point_deviation_m;
  while (found.iterations < settings_.iterations && !found.converged) {
    ++found.iterations;
    auto weighted = rows.rows;
    for (int p = 0; p < kBodyPointCount; ++p) {
      const double norm = rows.residuals.segment<3>(3 * p).norm();
      if (norm > huber) weighted.middleRows<3>(3 * p) *= huber / norm;
    }
    const Eigen::MatrixXd hessian = weighted.transpose() * rows.rows;
    const Eigen::VectorXd gradient = weighted.transpose() * rows.residuals;
    bool improved = false;
    while (!improved && damping < kLargestDamping) {
      Eigen::MatrixXd damped = hessian;
      damped.diagonal() *= 1.0 + damping;
      damped.diagonal().array() += 1e-9;
      const Eigen::VectorXd step = -damped.ldlt().solve(gradient);
      const SkeletonPose stepped = Stepped(found.pose, step);
      const InverseKinematicsRows stepped_rows = Rows(stepped, points);
      const Energy stepped_energy = EnergyOf(stepped_rows);
      improved = stepped_energy.total() <= energy.total();
      damping *= improved ? 1.0 / kDampingFactor : kDampingFactor;
      const double largest_rad = step.tail(3 * kBoneCount).cwiseAbs().maxCoeff();
      found.converged = largest_rad < settings_.stop_rad;
      if (improved) {
        found.pose = stepped;
        rows = stepped_rows;
        energy = stepped_energy;
      }
      if (found.converged) break;
    }
    if (!improved) break;
  }
  found.point_energy = energy.points;
  found.pose_energy = energy.pose;
  std::vector<double> distances_m;
  for (int p = 0; p < kBodyPointCount; ++p) {
    if (points[p])
      distances_m.push_back(settings_.point_deviation_m * rows.residuals.segment<3>(3 * p).norm());
  }
  found.median_m = Quantile(distances_m, 0.5);
  return found;
}

std::optional<SkeletonPose> InverseKinematics::ClosedForm(const GivenPoints& points) const {
  std::vector<PointPair> pairs;
  for (const BoneId id : kTrunkPoints) {
    const auto p = static_cast<std::size_t>(id);
    if (points[p]) pairs.push_back({rest_[p], *points[p]});
  }
  if (pairs.size() < kLeastTrunkPoints) return {};
  const Rigidd trunk = FitRigid(pairs.size(), [&](std::size_t i) { return pairs[i]; });
  static const std::array<int, kBoneCount> far_ends = MakeFarEnds();
  SkeletonPose pose;
  pose.pelvis_position = trunk * rest_[0];
  std::array<Vector3<double>, kBoneCount> joints;
  for (int b = 0; b < kBoneCount; ++b) {
    const int parent = Bones()[b].parent, end = far_ends[b];
    joints[b] =
        parent < 0
            ? pose.pelvis_position
            : Vector3<double>(joints[parent] + pose.rotations[parent] * (rest_[b] - rest_[parent]));
    pose.rotations[b] = parent < 0 ? trunk.rotation : pose.rotations[parent];
    if (end < 0 || !points[end]) continue;
    const Vector3<double> unturned = pose.rotations[b] * (rest_[end] - rest_[b]);
    const Vector3<double> wanted = *points[end] - joints[b];
    pose.rotations[b] = RotationBetween(unturned, wanted) * pose.rotations[b];
  }
  return pose;
}

InverseKinematicsRows InverseKinematics::Rows(const SkeletonPose& pose,
                                              const GivenPoints& points) const {
  const BoneTransforms camera_from_rest = ToTransforms(skeleton_, pose);
  InverseKinematicsRows result;
  result.residuals.setZero();
  result.rows.setZero();
  const double per_m = 1.0 / settings_.point_deviation_m;
  for (int p = 0; p < kBodyPointCount; ++p) {
    if (!points[p]) continue;
    const BodyPointInfo& point = BodyPoints()[p];
    const Vector3<double> x = camera_from_rest[point.bone] * rest_[p];
    result.residuals.segment<3>(3 * p) = per_m * (x - *points[p]);
    result.rows.block<3, 3>(3 * p, 0) = per_m * Matrix3<double>::Identity();
    for (int b = LastMoverOf(point); b >= 0; b = Bones()[b].parent) {
      const Vector3<double> joint = camera_from_rest[b] * rest_[b];
      result.rows.block<3, 3>(3 * p, 3 + 3 * b) = -per_m * Skew<double>(x - joint);
    }
  }
  const double root_weight = std::sqrt(settings_.pose_weight);
  for (int b = 1; b < kBoneCount; ++b) {
    const LocalRotationStatistics& usual = CapturedPoseStatistics()[b];
    const Matrix3<double> local = pose.rotations[Bones()[b].parent].transpose() * pose.rotations[b];
    const Vector3<double> d = LogSo3<double>(usual.mean.transpose() * local);
    const Vector3<double> scale = root_weight * usual.deviation_rad.cwiseInverse();
    const int row = InverseKinematicsRows::kPointRows + 3 * (b - 1);
    result.residuals.segment<3>(row) = scale.cwiseProduct(d);
    result.rows.block<3, 3>(row, 3 + 3 * b) =
        scale.asDiagonal() * InverseRightJacobian(d) * pose.rotations[b].transpose();
  }
  return result;
}

SkeletonPose InverseKinematics::Stepped(const SkeletonPose& pose,
                                        const Eigen::VectorXd& step) const {
  SkeletonPose stepped;
  stepped.pelvis_position = pose.pelvis_position + step.head<3>();
  for (int b = 0; b < kBoneCount; ++b) {
    const int parent = Bones()[b].parent;
    const Matrix3<double> turned = ExpSo3<double>(step.segment<3>(3 + 3 * b)) * pose.rotations[b];
    stepped.rotations[b] = parent < 0
                               ? turned
                               : Matrix3<double>(stepped.rotations[parent] *
                                                 pose.rotations[parent].transpose() * turned);
  }
  return stepped;
}

InverseKinematics::Energy InverseKinematics::EnergyOf(const InverseKinematicsRows& rows) const {
  const double huber = settings_.huber_m / settings_.point_deviation_m;
  Energy energy;
  for (int p = 0; p < kBodyPointCount; ++p)
    energy.points += HuberEnergy(rows.residuals.segment<3>(3 * p).norm(), huber);
  energy.pose = rows.residuals.tail<InverseKinematicsRows::kPoseRows>().squaredNorm();
  return energy;
}

}  // namespace vitruvia::skeleton_driven
