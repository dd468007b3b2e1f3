#include "methods/sdf_parts/posed_parts.h"

#include <algorithm>

namespace vitruvia::sdf_parts {

PosedParts::PosedParts(const std::vector<Part>& parts, double cell_m, double margin_m) {
  for (const Part& part : parts) {
    fields_.emplace_back(part.mesh, cell_m, margin_m);
    const Vector3f middle = BoundingBox(part.mesh.vertices).center();
    float radius = 0.0f;
    for (const Vector3f& v : part.mesh.vertices) radius = std::max(radius, (v - middle).norm());
    middles_[part.bone] = middle;
    radii_[part.bone] = radius;
  }
}

// In two loops. g++ 12 at -O3 addresses the fields of both in one loop by a multiple of `this` that
// it no longer knows for a pointer, finds the function pure (-fdump-tree-local-pure-const), and
// drops calls of it from the same unit.
void PosedParts::Pose(const BoneTransforms& camera_from_rest) {
  for (int b = 0; b < kBoneCount; ++b) {
    rest_from_camera_[b] = Inverse(camera_from_rest[b]).Cast<float>();
  }
  for (int b = 0; b < kBoneCount; ++b) {
    const Vector3f middle = camera_from_rest[b].Cast<float>() * middles_[b];
    ball_x_[b] = middle.x();
    ball_y_[b] = middle.y();
    ball_z_[b] = middle.z();
  }
}

PosedParts::Nearest PosedParts::DistanceFrom(int bone, const Vector3f& x) const {
  const Rigidf& rest_from_camera = rest_from_camera_[bone];
  const Vector3f rest = rest_from_camera * x;
  if (!fields_[bone].Covers(rest)) return {};
  const DistanceField::Sample sample = fields_[bone].At(rest);
  return {bone, sample.distance_m, rest_from_camera.rotation.transpose() * sample.gradient};
}

PosedParts::Nearest PosedParts::FindNearest(const Vector3f& x, float within_m) const {
  const Balls squared = (ball_x_ - x.x()).square() + (ball_y_ - x.y()).square() +
                        (ball_z_ - x.z()).square() - (radii_ + within_m).max(0.0f).square();
  Nearest nearest;
  float least = within_m;
  for (int bone = 0; bone < kBoneCount; ++bone) {
    if (squared[bone] > 0.0f) continue;
    const Vector3f rest = rest_from_camera_[bone] * x;
    if (!fields_[bone].Covers(rest)) continue;
    const float distance = fields_[bone].DistanceAt(rest);
    if (distance > least) continue;
    least = distance;
    nearest.bone = bone;
  }
  return nearest.bone < 0 ? nearest : DistanceFrom(nearest.bone, x);
}

}  // namespace vitruvia::sdf_parts
