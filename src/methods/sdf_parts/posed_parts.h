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
  // The part with the smallest signed distance from a point in the camera frame; none if that is
  // more than within_m.
  Nearest FindNearest(const Vector3f& x, float within_m) const;
  // The distance from one part.
  Nearest DistanceFrom(int bone, const Vector3f& x) const;

 private:
  // A part lies in a ball, in the camera frame. Padded to whole vector registers.
  static constexpr int kPadded = 24;
  using Balls = Eigen::Array<float, kPadded, 1>;

  std::vector<DistanceField> fields_;
  std::array<Vector3f, kBoneCount> middles_;  // of the balls, in the rest pose
  Balls ball_x_ = Balls::Zero(), ball_y_ = Balls::Zero(), ball_z_ = Balls::Zero(),
        radii_ = Balls::Constant(-1e3f);
  std::array<Rigidf, kBoneCount> rest_from_camera_;
};

}  // namespace vitruvia::sdf_parts
