#include "fitting/pose_variation.h"

#include <numbers>
#include <span>
#include <utility>

#include "math/angles.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

// A variant replaces a pose only if its distance is at most this share of the pose's: smaller
// differences are noise, and the current pose has been fitted.
constexpr double kBetter = 0.98;

BodyState Turned(BodyState state, double angle_rad) {
  state.rotation = ExpSo3<double>({0.0, angle_rad, 0.0}) * state.rotation;
  return state;
}

// Faces the other way with its limbs where they were, as far as joints let them.
BodyState Reversed(const BodyState& state) {
  AnatomicalPose pose = PoseOf(state.angles_deg);
  std::swap(pose.sides_deg[kLeft], pose.sides_deg[kRight]);
  for (SideAngles& side : pose.sides_deg) {
    side[kShoulderFlexion] *= -1.0;
    side[kHipFlexion] *= -1.0;
  }
  for (const int angle : {kSpineFlexion, kSpineBend, kNeckFlexion, kNeckBend}) {
    pose.midline_deg[static_cast<std::size_t>(angle)] *= -1.0;
  }
  BodyState reversed = Turned(state, std::numbers::pi);
  reversed.angles_deg = WithinLimits(AnglesOf(pose));
  return reversed;
}

std::vector<BodyState> Limbs(const BodyState& state, Side side, std::span<const SideAngles> poses,
                             int first_angle, int end_angle) {
  std::vector<BodyState> variants;
  for (const SideAngles& pose : poses) {
    variants.push_back(WithLimb(state, side, pose, first_angle, end_angle));
  }
  return variants;
}

}  // namespace

BodyState WithLimb(BodyState state, Side side, const SideAngles& angles_deg, int first_angle,
                   int end_angle) {
  for (int a = first_angle; a < end_angle; ++a) {
    state.angles_deg[AngleIndex(side, a)] = angles_deg[static_cast<std::size_t>(a)];
  }
  return state;
}

PoseVariation::PoseVariation(PoseFit& fit, DepthTarget& target, double far_m)
    : fit_(fit), target_(target), far_m_(far_m), posed_(fit.body()) {}

JudgedPose PoseVariation::Judged(const BodyState& state) {
  posed_.Set(state);
  return {state, target_.ImageDistance(posed_, far_m_)};
}

JudgedPose PoseVariation::Better(JudgedPose pose, const std::vector<BodyState>& variants) {
  double below_m = kBetter * pose.image_distance_m;
  for (const BodyState& variant : variants) {
    JudgedPose judged = Judged(variant);
    if (judged.image_distance_m >= below_m) continue;
    below_m = judged.image_distance_m;
    pose = std::move(judged);
  }
  return pose;
}

std::vector<BodyState> PoseVariation::Centered(std::vector<BodyState> states) {
  for (BodyState& state : states) state = fit_.Centered(target_, std::move(state));
  return states;
}

JudgedPose PoseVariation::WithTrunk(JudgedPose pose) {
  std::vector<BodyState> variants;
  for (const double turn_deg : {-60, -30, -15, 15, 30, 60}) {
    variants.push_back(Turned(pose.state, turn_deg * kRadiansPerDegree));
  }
  variants.push_back(Reversed(pose.state));
  pose = Better(std::move(pose), Centered(std::move(variants)));
  variants.clear();
  for (const double flexion_deg : {0, 15, 30, 50}) {
    variants.push_back(pose.state);
    variants.back().angles_deg[kSpineFlexion] = flexion_deg;
  }
  return Better(std::move(pose), Centered(std::move(variants)));
}

JudgedPose PoseVariation::WithLegs(JudgedPose pose) {
  for (const Side side : {kLeft, kRight}) {
    const auto variants = Limbs(pose.state, side, LegPoses(), kHipFlexion, kSideAngleCount);
    pose = Better(std::move(pose), variants);
  }
  return pose;
}

JudgedPose PoseVariation::WithArms(JudgedPose pose) {
  for (const Side side : {kLeft, kRight}) {
    const auto variants = Limbs(pose.state, side, ArmPoses(), kShoulderFlexion, kHipFlexion);
    pose = Better(std::move(pose), variants);
  }
  return pose;
}

JudgedPose PoseVariation::Varied(const BodyState& state) {
  return WithArms(WithLegs(WithTrunk(Judged(state))));
}

}  // namespace vitruvia
