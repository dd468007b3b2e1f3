#include "body/bone_limits.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "body/joint_limits.h"
#include "math/angles.h"

namespace vitruvia {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Range {
  double min_deg = -kInfinite, max_deg = kInfinite;
};

// The range of share · angle.
Range Scaled(const Range& range, double share) {
  const auto [low, high] = std::minmax({share * range.min_deg, share * range.max_deg});
  return {low, high};
}

Range RangeOf(std::span<const JointInfo> joints, int angle) {
  for (const JointInfo& joint : joints) {
    const int within = angle - joint.first;
    if (within < 0 || within >= static_cast<int>(joint.angles.size())) continue;
    const AngleInfo& info = joint.angles[static_cast<std::size_t>(within)];
    return {info.min_deg, info.max_deg};
  }
  return {};
}

BoneLimits Limits(const Range& x, const Range& y, const Range& z) {
  return {kRadiansPerDegree * Vector3<double>(x.min_deg, y.min_deg, z.min_deg),
          kRadiansPerDegree * Vector3<double>(x.max_deg, y.max_deg, z.max_deg)};
}

std::array<BoneLimits, kBoneCount> MakeLimits() {
  using enum BoneId;
  std::array<BoneLimits, kBoneCount> limits;
  limits.fill(Limits({}, {}, {}));
  const auto of = [&](BoneId bone, int step = 0) -> BoneLimits& {
    return limits[static_cast<std::size_t>(bone) + static_cast<std::size_t>(step)];
  };
  const auto midline = [](int angle, double share) {
    return Scaled(RangeOf(MidlineJoints(), angle), share);
  };
  const auto side = [](int angle, double share) {
    return Scaled(RangeOf(SideJoints(), angle), share);
  };

  of(kAbdomen) = of(kChest) =
      Limits(midline(kSpineFlexion, 0.5), midline(kSpineTurn, 0.5), midline(kSpineBend, -0.5));
  of(kNeck) = of(kHead) =
      Limits(midline(kNeckFlexion, 0.5), midline(kNeckTurn, 0.5), midline(kNeckBend, -0.5));
  for (const auto& [arm, thigh, outward] : {std::tuple{kLeftUpperArm, kLeftThigh, 1.0},
                                            std::tuple{kRightUpperArm, kRightThigh, -1.0}}) {
    of(arm, 1) = Limits({}, side(kElbowFlexion, -outward), {});
    of(arm, 2) = Limits(side(kPronation, 0.5), side(kUlnarDeviation, outward),
                        side(kWristFlexion, -outward));
    of(thigh) =
        Limits(side(kHipFlexion, -1.0), side(kHipRotation, -outward), side(kHipAbduction, outward));
    of(thigh, 1) = Limits(side(kKneeFlexion, 1.0), {}, {});
    of(thigh, 2) = Limits(side(kDorsiflexion, -1.0), {}, side(kInversion, -outward));
  }
  return limits;
}

}  // namespace

const std::array<BoneLimits, kBoneCount>& LimitsOfBones() {
  static const std::array<BoneLimits, kBoneCount> limits = MakeLimits();
  return limits;
}

}  // namespace vitruvia
