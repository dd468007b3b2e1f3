#include "synth/motions/mocap_check.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/angles.h"
#include "synth/motions/mocap_figure.h"
#include "synth/motions/mocap_root.h"

namespace vitruvia {
namespace {

using Vector3d = Vector3<double>;
using enum BoneId;

// Shares of a mean length: what is told, and what is refused.
constexpr double kTellChange = 0.05, kRefuseChange = 0.5;
// The longer side by the shorter one.
constexpr double kTellAsymmetry = 1.15, kRefuseAsymmetry = 2.0;
constexpr double kShortest = 0.1;          // of a segment, as a share of a leg
constexpr double kBentDeg = 25.0;          // a knee that is clearly bent
constexpr double kFewest = 10;             // bent knees from which something can be said
constexpr double kFastest_m_s = 15.0;      // nobody runs faster
constexpr double kImpossible_m_s = 100.0;  // in most frames
constexpr double kFarthest_m = 1000.0;     // from the first frame's place
constexpr double kLevelFoot = 0.3;         // least level share of a foot that points anywhere
constexpr double kToTheBackDeg = 60.0;     // from the back, at most, of a foot that points there
constexpr double kMostHeadDown = 0.5;      // of the frames
constexpr double kMostKneesForward = 0.5;

struct LimbPair {
  const char* name;
  BoneId left_from, left_to, right_from, right_to;
};
constexpr std::array<LimbPair, 4> kSegments{
    {{"upper arm", kLeftUpperArm, kLeftForearm, kRightUpperArm, kRightForearm},
     {"forearm", kLeftForearm, kLeftHand, kRightForearm, kRightHand},
     {"thigh", kLeftThigh, kLeftShin, kRightThigh, kRightShin},
     {"shin", kLeftShin, kLeftFoot, kRightShin, kRightFoot}}};

// One length by another, of adults and children with room on both sides.
struct Proportion {
  const char* name;
  double least, most;
};
constexpr Proportion kForearm{"forearm by upper arm", 0.55, 1.5};
constexpr Proportion kShin{"shin by thigh", 0.6, 1.6};
constexpr Proportion kArm{"arm by leg", 0.4, 1.1};
constexpr Proportion kTrunk{"trunk with neck by leg", 0.45, 1.2};

class Range {
 public:
  void Add(double value) {
    least_ = count_ == 0 ? value : std::min(least_, value);
    most_ = std::max(most_, value);
    sum_ += value;
    ++count_;
  }
  double Mean() const { return count_ == 0 ? 0.0 : sum_ / count_; }
  double LeastShare() const { return Mean() > 0.0 ? least_ / Mean() : 1.0; }
  double MostShare() const { return Mean() > 0.0 ? most_ / Mean() : 1.0; }

 private:
  double least_ = 0.0, most_ = 0.0, sum_ = 0.0;
  int count_ = 0;
};

class Checker {
 public:
  Checker(const MocapClip& clip, const MocapJoints& joints) : clip_(clip), joints_(joints) {
    for (const MocapFrame& frame : clip.frames) poses_.push_back(PoseOf(clip, frame));
  }

  MocapCheck Check() {
    MeasureLimbs();
    MeasureTrunk();
    CheckLengths();
    CheckSides();
    CheckProportions();
    CheckHead();
    CheckFront();
    CheckRoot();
    CheckSpeed();
    return std::move(check_);
  }

 private:
  template <class... Args>
  void Warn(fmt::format_string<Args...> text, Args&&... args) {
    check_.warnings.push_back(clip_.file.string() + ": " +
                              fmt::format(text, std::forward<Args>(args)...));
  }
  template <class... Args>
  [[noreturn]] void Fail(fmt::format_string<Args...> text, Args&&... args) const {
    throw DataError(clip_.file.string() + ": " + fmt::format(text, std::forward<Args>(args)...));
  }

  const Vector3d& At(const MocapPose& pose, BoneId bone) const {
    return pose.positions[joints_.At(bone)];
  }
  Vector3d Middle(const MocapPose& pose, BoneId a, BoneId b) const {
    return 0.5 * (At(pose, a) + At(pose, b));
  }

  void MeasureLimbs() {
    for (std::size_t i = 0; i < kSegments.size(); ++i) {
      const LimbPair& s = kSegments[i];
      Range left, right;
      for (const MocapPose& pose : poses_) {
        left.Add((At(pose, s.left_to) - At(pose, s.left_from)).norm());
        right.Add((At(pose, s.right_to) - At(pose, s.right_from)).norm());
      }
      check_.limbs[i] = {s.name, left.Mean(), right.Mean(),
                         std::min(left.LeastShare(), right.LeastShare()),
                         std::max(left.MostShare(), right.MostShare())};
    }
  }

  void MeasureTrunk() {
    Range trunk;
    for (const MocapPose& pose : poses_) {
      trunk.Add((At(pose, kHead) - Middle(pose, kLeftThigh, kRightThigh)).norm());
    }
    check_.trunk_m = trunk.Mean();
  }

  double Leg() const {
    return 0.5 * (check_.limbs[2].left_m + check_.limbs[2].right_m + check_.limbs[3].left_m +
                  check_.limbs[3].right_m);
  }

  void CheckLengths() {
    for (const LimbLengths& limb : check_.limbs) {
      if (std::min(limb.left_m, limb.right_m) < kShortest * Leg()) {
        Fail(
            "the {} is {:.3f} of a leg long on the left and {:.3f} on the right; expected at least "
            "{:g}: another joint is meant, or the OFFSETs are damaged",
            limb.name, limb.left_m / Leg(), limb.right_m / Leg(), kShortest);
      }
      const double change = std::max(1.0 - limb.least_share, limb.most_share - 1.0);
      const std::string told =
          fmt::format("the length of the {} goes from {:.0f} % to {:.0f} % of its mean", limb.name,
                      100.0 * limb.least_share, 100.0 * limb.most_share);
      if (change > kRefuseChange) {
        Fail("{}; expected rigid limbs: position channels that are no places of joints?", told);
      }
      if (change > kTellChange) Warn("{}; only its direction is taken", told);
    }
  }

  void CheckSides() {
    for (const LimbLengths& limb : check_.limbs) {
      const double ratio = std::max(limb.left_m / limb.right_m, limb.right_m / limb.left_m);
      if (ratio <= kTellAsymmetry) continue;
      const std::string told =
          fmt::format("the left {} is {:.3f} m long, the right one {:.3f} m (scaled to the body)",
                      limb.name, limb.left_m, limb.right_m);
      if (ratio > kRefuseAsymmetry) {
        Fail(
            "{}; expected two equal sides: an OFFSET or length is damaged, or the two are not the "
            "same joint's",
            told);
      }
      Warn("{}: are both sides the same joint's?", told);
    }
  }

  void CheckProportion(const Proportion& proportion, double value) {
    if (value >= proportion.least && value <= proportion.most) return;
    Warn("{} is {:.2f}; expected {:g} … {:g} of a person: is every joint the one it is taken for?",
         proportion.name, value, proportion.least, proportion.most);
  }

  void CheckProportions() {
    const auto mean = [&](std::size_t i) {
      return 0.5 * (check_.limbs[i].left_m + check_.limbs[i].right_m);
    };
    CheckProportion(kForearm, mean(1) / mean(0));
    CheckProportion(kShin, mean(3) / mean(2));
    CheckProportion(kArm, (mean(0) + mean(1)) / Leg());
    CheckProportion(kTrunk, check_.trunk_m / Leg());
  }

  void CheckHead() {
    const auto above = std::ranges::count_if(poses_, [&](const MocapPose& pose) {
      return At(pose, kHead).y() > Middle(pose, kLeftFoot, kRightFoot).y();
    });
    const auto count = static_cast<double>(poses_.size());
    check_.head_above_feet = static_cast<double>(above) / count;
    if (check_.head_above_feet >= kMostHeadDown) return;
    Warn("the head is above the feet in {} of {} frames only: is the motion's up_axis right?",
         above, poses_.size());
  }

  // Knees and feet show the front; the names of the sides must imply the same one.
  void CheckFront() {
    CountKnees();
    std::vector<std::string> evidence;
    const int forwards = check_.bent_knees - check_.knees_backwards;
    if (check_.bent_knees >= kFewest && forwards > kMostKneesForward * check_.bent_knees) {
      evidence.push_back(
          fmt::format("{} of {} bent knees bend to the front", forwards, check_.bent_knees));
    }
    if (PointsToTheBack(kLeftFoot) && PointsToTheBack(kRightFoot)) {
      evidence.emplace_back("both feet point to the back in the rest pose");
    }
    if (evidence.empty()) return;
    Warn(
        "{}, if the joints that are called left are on the left: are left and right exchanged, or "
        "is the file mirrored?",
        fmt::join(evidence, ", and "));
  }

  // In the axes of the pelvis' front, a bent knee lies before the line from hip to ankle.
  void CountKnees() {
    for (const MocapPose& pose : poses_) {
      const Vector3d left = HipsLeft(pose.positions, joints_);
      for (const auto& [hip, knee, ankle] : {std::tuple{kLeftThigh, kLeftShin, kLeftFoot},
                                             std::tuple{kRightThigh, kRightShin, kRightFoot}}) {
        const Vector3d thigh = At(pose, knee) - At(pose, hip);
        const Vector3d shin = At(pose, ankle) - At(pose, knee);
        const Vector3d axis = thigh.cross(shin);
        if (std::atan2(axis.norm(), thigh.dot(shin)) < kRadiansPerDegree * kBentDeg) continue;
        ++check_.bent_knees;
        if (axis.dot(left) > 0.0) ++check_.knees_backwards;
      }
    }
  }

  // At rest, from ankle to toes; not of a foot without toes or one that hangs.
  bool PointsToTheBack(BoneId foot) const {
    const Vector3d& toes = clip_.joints[joints_.At(foot)].tip;
    const double level = std::hypot(toes.x(), toes.z());
    return level > kLevelFoot * toes.norm() &&
           -toes.z() > std::cos(kRadiansPerDegree * kToTheBackDeg) * level;
  }

  void CheckRoot() {
    unit_doubt_ = RootUnitDoubt(clip_, joints_, poses_);
    if (!unit_doubt_.empty()) Warn("{}", unit_doubt_);
    const std::string fixed = FixedRootDoubt(clip_, joints_, poses_);
    if (!fixed.empty()) Warn("{}", fixed);
  }

  Vector3d Hips(std::size_t frame) const { return Middle(poses_[frame], kLeftThigh, kRightThigh); }

  void CheckSpeed() {
    std::size_t jumps = 0, impossible = 0;
    for (std::size_t i = 1; i < poses_.size(); ++i) {
      RequireNear(i);
      const double speed = (Hips(i) - Hips(i - 1)).norm() / clip_.frame_s;
      jumps += speed > kFastest_m_s;
      impossible += speed > kImpossible_m_s;
      if (speed <= check_.fastest_m_s) continue;
      check_.fastest_m_s = speed;
      check_.fastest_frame = static_cast<int>(i - 1);
    }
    if (2 * impossible > poses_.size() - 1) {
      Fail(
          "the hips move faster than {:g} m/s between {} of {} pairs of frames; expected a person: "
          "the unit of the root's positions or the rate is wrong{}",
          kImpossible_m_s, impossible, poses_.size() - 1, UnitEvidence());
    }
    if (jumps == 0) return;
    Warn(
        "the hips move faster than {:g} m/s {} times, {:.3g} m/s after frame {} of {}: frames are "
        "missing, or the rate or the unit of the positions is wrong",
        kFastest_m_s, jumps, check_.fastest_m_s, check_.fastest_frame + 1, poses_.size());
  }

  void RequireNear(std::size_t frame) const {
    const double away = (Hips(frame) - Hips(0)).norm();
    if (away <= kFarthest_m) return;
    Fail(
        "in frame {} of {} the hips are {:.3g} m away from where they are in frame 1; expected at "
        "most {:g} m: a number of that frame is damaged, or the unit of the root's positions is "
        "wrong{}",
        frame + 1, poses_.size(), away, kFarthest_m, UnitEvidence());
  }

  std::string UnitEvidence() const {
    return unit_doubt_.empty() ? "" : fmt::format(" ({})", unit_doubt_);
  }

  const MocapClip& clip_;
  const MocapJoints& joints_;
  std::vector<MocapPose> poses_;
  MocapCheck check_;
  std::string unit_doubt_;  // of the root's positions
};

}  // namespace

MocapCheck CheckClip(const MocapClip& clip, const MocapJoints& joints) {
  return Checker(clip, joints).Check();
}

}  // namespace vitruvia
