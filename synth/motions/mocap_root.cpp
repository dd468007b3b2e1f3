#include "synth/motions/mocap_root.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "synth/motions/mocap_figure.h"

namespace vitruvia {
namespace {

using Vector3d = Vector3<double>;
using enum BoneId;

// Two heights that differ by less than this share may be the same: feet have flesh below them.
constexpr double kSameHeight = 0.15;
constexpr double kClearShare = 0.8;  // of the frames in which a factor must explain the height
constexpr double kUpright = 0.3;     // least height of the root above the lowest joint, in legs
constexpr double kSameRoot = 1e-6;   // in legs: digits cut off
constexpr double kSlide = 0.15;      // of a foot that stands, in legs

struct UnitFactor {
  double factor;
  const char *larger, *smaller;  // units
};
constexpr std::array<UnitFactor, 4> kUnitFactors{{{100.0, "metres", "centimetres"},
                                                  {10.0, "centimetres", "millimetres"},
                                                  {1000.0, "metres", "millimetres"},
                                                  {2.54, "inches", "centimetres"}}};

// The joint whose positions carry the body: the pelvis where joints below the root move as well.
std::size_t Carrier(const MocapClip& clip, const MocapJoints& joints) {
  return clip.frames[0].offsets.empty() ? 0 : joints.At(kPelvis);
}

double LowestHeight(const MocapClip& clip, const MocapPose& pose) {
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < clip.joints.size(); ++i) {
    const double tip = (pose.rotations[i] * clip.joints[i].tip).y();
    lowest = std::min(lowest, pose.positions[i].y() + std::min(tip, 0.0));
  }
  return lowest;
}

struct RootHeights {
  std::vector<double> above_zero, above_lowest;  // of the frames in which the root is off the floor
  std::size_t frames = 0;

  // Of all frames: those in which the root would stand on a floor at 0 if its positions were
  // multiplied by `factor`.
  double ShareExplainedBy(double factor) const {
    int explained = 0;
    for (std::size_t i = 0; i < above_zero.size(); ++i) {
      explained += std::abs(factor * above_zero[i] / above_lowest[i] - 1.0) < kSameHeight;
    }
    return explained / static_cast<double>(frames);
  }
};

RootHeights MeasureHeights(const MocapClip& clip, const MocapJoints& joints,
                           const std::vector<MocapPose>& poses) {
  const double least = kUpright * LegLength(RestPositions(clip), joints);
  const std::size_t root = Carrier(clip, joints);
  RootHeights heights;
  heights.frames = poses.size();
  for (const MocapPose& pose : poses) {
    const double height = pose.positions[root].y(), above = height - LowestHeight(clip, pose);
    if (above < least) continue;
    heights.above_zero.push_back(height);
    heights.above_lowest.push_back(above);
  }
  return heights;
}

// The farthest that a foot gets from where it became the lower one while it is that.
double FarthestSlide(const MocapJoints& joints, const std::vector<MocapPose>& poses) {
  double farthest = 0.0;
  std::size_t standing = joints.At(kLeftFoot);
  Vector3d since = poses[0].positions[standing];
  for (const MocapPose& pose : poses) {
    const std::size_t left = joints.At(kLeftFoot), right = joints.At(kRightFoot);
    const std::size_t lower = pose.positions[left].y() <= pose.positions[right].y() ? left : right;
    if (lower != standing) since = pose.positions[lower];
    standing = lower;
    farthest = std::max(farthest, (pose.positions[standing] - since).norm());
  }
  return farthest;
}

}  // namespace

std::string RootUnitDoubt(const MocapClip& clip, const MocapJoints& joints,
                          const std::vector<MocapPose>& poses) {
  const RootHeights heights = MeasureHeights(clip, joints, poses);
  for (const auto& [factor, larger, smaller] : kUnitFactors) {
    const bool too_low = heights.ShareExplainedBy(factor) >= kClearShare;
    if (!too_low && heights.ShareExplainedBy(1.0 / factor) < kClearShare) continue;
    return fmt::format(
        "the root is {:.3g} m above 0, but {:.3g} m above the lowest joint (scaled to the body), "
        "a factor of about {:g}: are the root's positions in {} and the OFFSETs or lengths in {}? "
        "The path is then {:g} times too {}",
        heights.above_zero[0], heights.above_lowest[0], factor, too_low ? larger : smaller,
        too_low ? smaller : larger, factor, too_low ? "short" : "long");
  }
  return "";
}

std::string FixedRootDoubt(const MocapClip& clip, const MocapJoints& joints,
                           const std::vector<MocapPose>& poses) {
  const double leg = LegLength(RestPositions(clip), joints);
  const std::size_t root = Carrier(clip, joints);
  const Vector3d& start = poses[0].positions[root];
  const bool moves = std::ranges::any_of(poses, [&](const MocapPose& pose) {
    return (pose.positions[root] - start).norm() > kSameRoot * leg;
  });
  if (moves) return "";
  const double slide = FarthestSlide(joints, poses);
  if (slide < kSlide * leg) return "";
  return fmt::format(
      "the root stays at one place in all {} frames, but the foot that stands moves by {:.2f} m: "
      "are the root's positions lost, or taken out so that the performer moves in place? The feet "
      "then slide",
      poses.size(), slide);
}

}  // namespace vitruvia
