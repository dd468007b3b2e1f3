// The parts' distance fields in a pose.
#pragma once

#include <array>

#include "math/rigid.h"
#include "methods/sdf_parts/distance_field.h"
#include "methods/sdf_parts/part.h"

namespace vitruvia::sdf_parts {

class PosedParts {
 public:
  // One part for each bone, in their order.
  PosedParts(const std::vector<Part>& parts, double cell_m, double margin_m);

  void Pose(const BoneTransforms& camera_from_rest);

  struct Nearest {
    int bone = -1;  // -1: no part's field covers the point
    float distance_m = 0.0f;
    Vector3f gradient = Vector3f::Zero();  // camera frame
  };
  // The part with the smallest signed distance from a point in the camera frame.
  Nearest FindNearest(const Vector3f& x) const;
  // That of one part.
  Nearest DistanceFrom(int bone, const Vector3f& x) const;

 private:
  std::vector<DistanceField> fields_;
  std::array<Rigidf, kBoneCount> rest_from_camera_;
};

}  // namespace vitruvia::sdf_parts
