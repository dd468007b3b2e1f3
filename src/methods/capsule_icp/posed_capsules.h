// The capsules of a body in a pose, laid out so that a point is compared with all of them at once.
#pragma once

#include "methods/capsule_icp/capsule.h"

namespace vitruvia::capsule_icp {

class PosedCapsules {
 public:
  explicit PosedCapsules(std::vector<Capsule> capsules);

  void Pose(const BoneTransforms& camera_from_rest);
  const std::vector<Capsule>& rest() const { return rest_; }

  struct Nearest {
    int capsule;
    float distance_m;  // signed, negative inside
    Vector3f normal;   // outward at the point
  };
  // Of a point in the camera frame: the capsule with the smallest signed distance.
  Nearest FindNearest(const Vector3f& x) const;
  // Capsule k in the camera frame.
  Capsule InCamera(int k) const;

 private:
  static constexpr int kMost = 32;  // a multiple of the width of a vector register

  std::vector<Capsule> rest_;
  BoneTransforms camera_from_rest_;
  int padded_ = 0;  // capsules, and copies of the last one up to a full register
  // In the camera frame: start, axis, length, first radius, its loss per metre, and tan φ.
  struct Lanes {
    alignas(32) float start_x[kMost], start_y[kMost], start_z[kMost];
    alignas(32) float axis_x[kMost], axis_y[kMost], axis_z[kMost];
    alignas(32) float length[kMost], radius[kMost], slope[kMost], tangent[kMost];
  };
  Lanes lanes_{};
};

}  // namespace vitruvia::capsule_icp
