#include "methods/sdf_parts/posed_parts.h"

namespace vitruvia::sdf_parts {

PosedParts::PosedParts(const std::vector<Part>& parts, double cell_m, double margin_m) {
  for (const Part& part : parts) fields_.emplace_back(part.mesh, cell_m, margin_m);
}

void PosedParts::Pose(const BoneTransforms& camera_from_rest) {
  for (int b = 0; b < kBoneCount; ++b) {
    rest_from_camera_[b] = Inverse(camera_from_rest[b]).Cast<float>();
  }
}

PosedParts::Nearest PosedParts::DistanceFrom(int bone, const Vector3f& x) const {
  const Rigidf& rest_from_camera = rest_from_camera_[bone];
  const Vector3f rest = rest_from_camera * x;
  if (!fields_[bone].Covers(rest)) return {};
  const DistanceField::Sample sample = fields_[bone].At(rest);
  return {bone, sample.distance_m, rest_from_camera.rotation.transpose() * sample.gradient};
}

PosedParts::Nearest PosedParts::FindNearest(const Vector3f& x) const {
  Nearest nearest;
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const Nearest candidate = DistanceFrom(bone, x);
    if (candidate.bone < 0) continue;
    if (nearest.bone < 0 || candidate.distance_m < nearest.distance_m) nearest = candidate;
  }
  return nearest;
}

}  // namespace vitruvia::sdf_parts
