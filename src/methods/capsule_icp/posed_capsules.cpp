#include "methods/capsule_icp/posed_capsules.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "math/rigid.h"

namespace vitruvia::capsule_icp {

PosedCapsules::PosedCapsules(std::vector<Capsule> capsules) : rest_(std::move(capsules)) {
  Require(!rest_.empty(), "PosedCapsules: no capsules");
  groups_.resize((rest_.size() + kLanes - 1) / kLanes);
  Pose(BoneTransforms(kBoneCount));
}

void PosedCapsules::Pose(const BoneTransforms& camera_from_rest) {
  constexpr double kSteepest = 0.99;
  camera_from_rest_ = camera_from_rest;
  for (std::size_t k = 0; k < kLanes * groups_.size(); ++k) {
    const Capsule& c = rest_[std::min(k, rest_.size() - 1)];
    const Rigidd& moved = camera_from_rest[c.bone];
    const Vector3f start = (moved * c.start).cast<float>();
    const double length = std::max((c.end - c.start).norm(), 1e-9);
    const Vector3f axis = (moved.rotation * (c.end - c.start) / length).cast<float>();
    const double slope = (c.start_radius_m - c.end_radius_m) / length;
    const double sine = std::clamp(slope, -kSteepest, kSteepest);
    Group& group = groups_[k / kLanes];
    const std::size_t lane = k % kLanes;
    group.start_x[lane] = start.x();
    group.start_y[lane] = start.y();
    group.start_z[lane] = start.z();
    group.axis_x[lane] = axis.x();
    group.axis_y[lane] = axis.y();
    group.axis_z[lane] = axis.z();
    group.length[lane] = static_cast<float>(length);
    group.radius[lane] = static_cast<float>(c.start_radius_m);
    group.slope[lane] = static_cast<float>(slope);
    group.tangent[lane] = static_cast<float>(sine / std::sqrt(1.0 - sine * sine));
  }
}

PosedCapsules::Nearest PosedCapsules::FindNearest(const Vector3f& x) const {
  Nearest nearest{0, std::numeric_limits<float>::infinity(), Vector3f::Zero()};
  float place = 0.0f;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Group& c = groups_[g];
    const Lanes dx = x.x() - c.start_x, dy = x.y() - c.start_y, dz = x.z() - c.start_z;
    const Lanes along = dx * c.axis_x + dy * c.axis_y + dz * c.axis_z;
    const Lanes across_squared = (dx * dx + dy * dy + dz * dz - along * along).max(0.0f);
    const Lanes z = (along - across_squared.sqrt() * c.tangent).max(0.0f).min(c.length);
    const Lanes rest = along - z;
    const Lanes distance = (rest * rest + across_squared).sqrt() - c.radius + z * c.slope;
    Eigen::Index lane = 0;
    const float least = distance.minCoeff(&lane);
    if (!(least < nearest.distance_m)) continue;
    nearest.distance_m = least;
    nearest.capsule = static_cast<int>(g) * kLanes + static_cast<int>(lane);
    place = z[lane];
  }
  nearest.capsule = std::min(nearest.capsule, static_cast<int>(rest_.size()) - 1);
  const Group& group = groups_[static_cast<std::size_t>(nearest.capsule / kLanes)];
  const int lane = nearest.capsule % kLanes;
  nearest.normal = Vector3f(x.x() - group.start_x[lane] - place * group.axis_x[lane],
                            x.y() - group.start_y[lane] - place * group.axis_y[lane],
                            x.z() - group.start_z[lane] - place * group.axis_z[lane])
                       .normalized();
  return nearest;
}

Capsule PosedCapsules::InCamera(int k) const {
  Capsule capsule = rest_[k];
  const Rigidd& moved = camera_from_rest_[capsule.bone];
  capsule.start = moved * capsule.start;
  capsule.end = moved * capsule.end;
  return capsule;
}

}  // namespace vitruvia::capsule_icp
