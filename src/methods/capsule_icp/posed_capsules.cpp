#include "methods/capsule_icp/posed_capsules.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/rigid.h"

namespace vitruvia::capsule_icp {

PosedCapsules::PosedCapsules(std::vector<Capsule> capsules) : rest_(std::move(capsules)) {
  constexpr int kRegister = 8;
  Require(!rest_.empty() && rest_.size() <= kMost, "PosedCapsules: {} capsules, at most {}",
          rest_.size(), int{kMost});
  padded_ = (static_cast<int>(rest_.size()) + kRegister - 1) / kRegister * kRegister;
  Pose(BoneTransforms(kBoneCount));
}

void PosedCapsules::Pose(const BoneTransforms& camera_from_rest) {
  constexpr double kSteepest = 0.99;
  camera_from_rest_ = camera_from_rest;
  for (int k = 0; k < padded_; ++k) {
    const Capsule& c = rest_[std::min<std::size_t>(k, rest_.size() - 1)];
    const Rigidd& moved = camera_from_rest[c.bone];
    const Vector3f start = (moved * c.start).cast<float>();
    const double length = std::max((c.end - c.start).norm(), 1e-9);
    const Vector3f axis = (moved.rotation * (c.end - c.start) / length).cast<float>();
    const double sine =
        std::clamp((c.start_radius_m - c.end_radius_m) / length, -kSteepest, kSteepest);
    lanes_.start_x[k] = start.x();
    lanes_.start_y[k] = start.y();
    lanes_.start_z[k] = start.z();
    lanes_.axis_x[k] = axis.x();
    lanes_.axis_y[k] = axis.y();
    lanes_.axis_z[k] = axis.z();
    lanes_.length[k] = static_cast<float>(length);
    lanes_.radius[k] = static_cast<float>(c.start_radius_m);
    lanes_.slope[k] = static_cast<float>((c.start_radius_m - c.end_radius_m) / length);
    lanes_.tangent[k] = static_cast<float>(sine / std::sqrt(1.0 - sine * sine));
  }
}

PosedCapsules::Nearest PosedCapsules::FindNearest(const Vector3f& x) const {
  alignas(32) std::array<float, kMost> distances{}, places{};
  const float px = x.x(), py = x.y(), pz = x.z();
  const int count = padded_;
  for (int k = 0; k < count; ++k) {
    const float dx = px - lanes_.start_x[k], dy = py - lanes_.start_y[k],
                dz = pz - lanes_.start_z[k];
    const float along = dx * lanes_.axis_x[k] + dy * lanes_.axis_y[k] + dz * lanes_.axis_z[k];
    const float squared = dx * dx + dy * dy + dz * dz - along * along;
    const float across = std::sqrt(squared > 0.0f ? squared : 0.0f);
    float z = along - across * lanes_.tangent[k];
    z = z < 0.0f ? 0.0f : z;
    z = z > lanes_.length[k] ? lanes_.length[k] : z;
    const float rest = along - z;
    distances[k] =
        std::sqrt(rest * rest + across * across) - lanes_.radius[k] + z * lanes_.slope[k];
    places[k] = z;
  }
  int best = 0;
  for (int k = 1; k < count; ++k) best = distances[k] < distances[best] ? k : best;
  const float z = places[best];
  const Vector3f away(px - lanes_.start_x[best] - z * lanes_.axis_x[best],
                      py - lanes_.start_y[best] - z * lanes_.axis_y[best],
                      pz - lanes_.start_z[best] - z * lanes_.axis_z[best]);
  return {best, distances[best], away.normalized()};
}

Capsule PosedCapsules::InCamera(int k) const {
  Capsule capsule = rest_[k];
  const Rigidd& moved = camera_from_rest_[capsule.bone];
  capsule.start = moved * capsule.start;
  capsule.end = moved * capsule.end;
  return capsule;
}

}  // namespace vitruvia::capsule_icp
