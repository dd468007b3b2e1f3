#include "synth/motions/mocap_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "math/rotation.h"
#include "synth/motions/smooth_step.h"

namespace vitruvia {
namespace {

using Vector3d = Vector3<double>;
using Matrix3d = Matrix3<double>;
using enum BoneId;

// Longer than half a flight: a jump of 0.8 s would rise 0.78 m.
constexpr double kHalfWindow_s = 0.4;
// Markers and ankles wobble by about 2 cm on the floor. Heights up to this share of the leg length
// count as 0, heights from twice this share on are unchanged, with a smooth transition in between.
constexpr double kNoiseOfLeg = 0.03;
// A heel lies behind its ankle by this share of the distance from the ankle to the toes.
constexpr double kHeelOfFoot = 0.25;

// A point that moves with a joint, and the flesh below it.
struct ContactPoint {
  std::size_t joint = 0;
  Vector3d offset = Vector3d::Zero();  // at rest, from the joint
  double radius_m = 0.0;
};

// Flesh round joints, as shares of leg length; read off a body model. Feet are dealt with apart.
struct FleshyJoint {
  BoneId bone;
  bool at_tip;  // of the joint's bone, rather than at the joint
  double radius_of_leg;
};
constexpr std::array<FleshyJoint, 10> kFleshyJoints{{{kLeftThigh, false, 0.12},
                                                     {kRightThigh, false, 0.12},
                                                     {kLeftShin, false, 0.06},
                                                     {kRightShin, false, 0.06},
                                                     {kChest, false, 0.14},
                                                     {kHead, true, 0.02},
                                                     {kLeftForearm, false, 0.05},
                                                     {kRightForearm, false, 0.05},
                                                     {kLeftHand, true, 0.02},
                                                     {kRightHand, true, 0.02}}};

// Heel and toes on the sole, which is as far below the ankle as the lowest of the foot's joints.
void AddFoot(const MocapClip& clip, std::size_t shin, std::size_t foot,
             std::vector<ContactPoint>& points) {
  const std::vector<Vector3d> rest = RestPositions(clip);
  const Matrix3d rest_from_flat = RestFromFlatFoot(rest[foot] - rest[shin]);
  double sole = 0.0;
  Vector3d toes = Vector3d::Zero();
  for (std::size_t joint = foot; joint < clip.joints.size(); ++joint) {
    if (!Descends(clip, static_cast<int>(joint), static_cast<int>(foot))) continue;
    const Vector3d from_ankle = rest[joint] + clip.joints[joint].tip - rest[foot];
    const Vector3d flat = rest_from_flat.transpose() * from_ankle;
    sole = std::min(sole, flat.y());
    const Vector3d level(flat.x(), 0.0, flat.z());
    if (level.norm() > toes.norm()) toes = level;
  }
  const Vector3d below(0.0, sole, 0.0);
  points.push_back({foot, rest_from_flat * (below + toes), 0.0});
  points.push_back({foot, rest_from_flat * (below - kHeelOfFoot * toes), 0.0});
}

std::vector<ContactPoint> ContactPoints(const MocapClip& clip, const MocapJoints& joints,
                                        double leg_length_m) {
  std::vector<ContactPoint> points;
  AddFoot(clip, joints.At(kLeftShin), joints.At(kLeftFoot), points);
  AddFoot(clip, joints.At(kRightShin), joints.At(kRightFoot), points);
  for (const FleshyJoint& fleshy : kFleshyJoints) {
    const std::size_t joint = joints.At(fleshy.bone);
    const Vector3d offset = fleshy.at_tip ? clip.joints[joint].tip : Vector3d::Zero();
    points.push_back({joint, offset, fleshy.radius_of_leg * leg_length_m});
  }
  return points;
}

// The least height in a window round each frame, averaged over windows of the same width.
std::vector<double> FloorHeights(const std::vector<double>& heights, std::ptrdiff_t half_window) {
  const auto count = static_cast<std::ptrdiff_t>(heights.size());
  const auto over_windows = [&](const std::vector<double>& values, auto&& summary) {
    std::vector<double> result;
    result.reserve(values.size());
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      result.push_back(summary(values.begin() + std::max<std::ptrdiff_t>(i - half_window, 0),
                               values.begin() + std::min(i + half_window + 1, count)));
    }
    return result;
  };
  const std::vector<double> least =
      over_windows(heights, [](auto begin, auto end) { return *std::min_element(begin, end); });
  return over_windows(least, [](auto begin, auto end) {
    return std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin);
  });
}

}  // namespace

Matrix3<double> RestFromFlatFoot(const Vector3<double>& shin_direction_at_rest) {
  return RotationBetween<double>(-Vector3d::UnitY(), shin_direction_at_rest);
}

std::vector<double> Clearances(const MocapClip& clip, const MocapJoints& joints,
                               double leg_length_m) {
  const std::vector<ContactPoint> points = ContactPoints(clip, joints, leg_length_m);
  std::vector<double> heights;
  heights.reserve(clip.frames.size());
  for (const MocapFrame& frame : clip.frames) {
    const MocapPose pose = PoseOf(clip, frame);
    double lowest = std::numeric_limits<double>::infinity();
    for (const ContactPoint& point : points) {
      const Vector3d place =
          pose.positions[point.joint] + pose.rotations[point.joint] * point.offset;
      lowest = std::min(lowest, place.y() - point.radius_m);
    }
    heights.push_back(lowest);
  }
  const auto half_window = static_cast<std::ptrdiff_t>(std::ceil(kHalfWindow_s / clip.frame_s));
  const std::vector<double> floor = FloorHeights(heights, half_window);
  const double noise_m = kNoiseOfLeg * leg_length_m;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double height = heights[i] - floor[i];
    heights[i] = std::max(0.0, height * SmoothStep(height / noise_m - 1.0));
  }
  return heights;
}

}  // namespace vitruvia
