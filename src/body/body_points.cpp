#include "body/body_points.h"

#include <algorithm>

#include "core/error.h"
#include "math/rigid.h"

namespace vitruvia {
namespace {

std::array<BodyPointInfo, kBodyPointCount> MakePoints() {
  std::array<BodyPointInfo, kBodyPointCount> points;
  for (int b = 0; b < kBoneCount; ++b) {
    points[b] = {std::string(Bones()[b].joint), b, false, Bones()[b].parent};
  }
  std::array<bool, kBoneCount> has_child{};
  for (const BoneInfo& bone : Bones()) {
    if (bone.parent >= 0) has_child[bone.parent] = true;
  }
  int next = kBoneCount;
  for (int b = 0; b < kBoneCount; ++b) {
    if (!has_child[b]) points[next++] = {fmt::format("{}_tip", Bones()[b].name), b, true, b};
  }
  return points;
}

}  // namespace

const std::array<BodyPointInfo, kBodyPointCount>& BodyPoints() {
  static const std::array<BodyPointInfo, kBodyPointCount> points = MakePoints();
  return points;
}

int FindBodyPoint(std::string_view name) {
  const auto& points = BodyPoints();
  const auto found = std::find_if(points.begin(), points.end(),
                                  [&](const BodyPointInfo& point) { return point.name == name; });
  return found == points.end() ? -1 : static_cast<int>(found - points.begin());
}

double SizeOf(const Skeleton& skeleton) {
  constexpr double kUsual_m = 1.6;
  const auto y = [](const auto& points, BoneId bone) {
    return points[static_cast<std::size_t>(bone)].y();
  };
  const double ankles =
      0.5 * (y(skeleton.joints, BoneId::kLeftFoot) + y(skeleton.joints, BoneId::kRightFoot));
  return (y(skeleton.tips, BoneId::kHead) - ankles) / kUsual_m;
}

BodyPointPositions RestPoints(const Skeleton& skeleton) {
  BodyPointPositions positions;
  for (int p = 0; p < kBodyPointCount; ++p) {
    const BodyPointInfo& point = BodyPoints()[p];
    positions[p] = point.is_tip ? skeleton.tips[point.bone] : skeleton.joints[point.bone];
  }
  return positions;
}

BodyPointPositions PosedPoints(const Skeleton& skeleton, const BoneTransforms& posed_from_rest) {
  BodyPointPositions positions = RestPoints(skeleton);
  for (int p = 0; p < kBodyPointCount; ++p) {
    positions[p] = posed_from_rest[BodyPoints()[p].bone] * positions[p];
  }
  return positions;
}

}  // namespace vitruvia
