// The capsules of a body in a pose, in a layout for comparing a point with eight of them at once.
#pragma once

#include "math/lanes.h"
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
  using Lanes = Eigen::Array<float, kLanes, 1>;

  // Eight capsules in the camera frame: start, axis, length, first radius, decrease of the radius
  // per metre, and tan φ. The last group is padded with copies of the last capsule.
  struct Group {
    Lanes start_x, start_y, start_z, axis_x, axis_y, axis_z, length, radius, slope, tangent;
  };

  std::vector<Capsule> rest_;
  BoneTransforms camera_from_rest_;
  std::vector<Group> groups_;
};

}  // namespace vitruvia::capsule_icp
