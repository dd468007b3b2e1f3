// Loading of clips that a test has written, and comparisons of motions.
#pragma once

#include <numbers>

#include <gtest/gtest.h>

#include "math/rotation.h"
#include "mocap_files.h"
#include "motion_files.h"

namespace vitruvia {

inline std::unique_ptr<Motion> FromBvh(const std::string& text,
                                       const Skeleton& skeleton = TestSkeleton(),
                                       const MocapSettings& settings = {}) {
  const TemporaryFolder folder;
  std::ofstream(folder / "clip.bvh") << text;
  return LoadBvh(folder / "clip.bvh", skeleton, settings);
}

inline std::unique_ptr<Motion> FromAmc(const std::string& amc, const std::string& asf = kTestAsf,
                                       const Skeleton& skeleton = TestSkeleton(),
                                       const AmcSettings& settings = {}) {
  const TemporaryFolder folder;
  std::ofstream(folder / "clip.amc") << amc;
  std::ofstream(folder / "clip.asf") << asf;
  return LoadAsfAmc(folder / "clip.amc", folder / "clip.asf", skeleton, settings);
}

// What is said of a file that is refused; "accepted" otherwise.
template <class Load>
std::string RefusalOf(Load&& load) {
  try {
    load();
  } catch (const DataError& error) {
    return error.what();
  }
  return "accepted";
}

inline std::string RefusalOfBvh(const std::string& text, const MocapSettings& settings = {}) {
  return RefusalOf([&] { FromBvh(text, TestSkeleton(), settings); });
}

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
// Motions that differ by less than this are one motion (Difference()).
inline constexpr double kSame = 1e-7;

inline Matrix3<double> Turn(double degrees, const Vector3<double>& axis) {
  return ExpSo3<double>(kRadiansPerDegree * degrees * axis);
}

constexpr std::size_t Index(BoneId bone) { return static_cast<std::size_t>(bone); }

// The largest difference of bone rotations, places (m) and clearances (m) at nine times.
inline double Difference(const Motion& a, const Motion& b) {
  double largest = std::abs(a.duration_s() - b.duration_s());
  for (double share = 0.0; share <= 1.0; share += 0.125) {
    const MotionSample at_a = a.At(share * a.duration_s()), at_b = b.At(share * b.duration_s());
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      largest = std::max(
          largest, (at_a.pose.local_rotations[bone] - at_b.pose.local_rotations[bone]).norm());
    }
    largest = std::max({largest, (at_a.pose.pelvis_position - at_b.pose.pelvis_position).norm(),
                        std::abs(at_a.clearance_m - at_b.clearance_m)});
  }
  return largest;
}

// A clip in which everything moves.
inline std::vector<TestFrame> Wriggle() {
  std::vector<TestFrame> frames;
  for (int i = 0; i < 40; ++i) {
    const double t = 0.1 * i;
    TestFrame frame;
    frame.root = {0.1 * t, 0.02 * std::sin(t), 0.3 * t};
    frame.angles_deg = {{"Hips", {5 * t, 20 * std::sin(t), 3}},
                        {"Spine", {10 * std::sin(t), 4, 2 * t}},
                        {"Chest", {0, 15 * std::sin(2 * t), 0}},
                        {"Neck", {0, 0, 10 * t}},
                        {"Head", {5, 10 * t, 0}},
                        {"LeftArm", {30 * t, 0, -40}},
                        {"LeftForeArm", {0, -60 * std::sin(t), 10}},
                        {"LeftHand", {0, 0, 20}},
                        {"RightArm", {0, 30, 50 * std::sin(t)}},
                        {"RightForeArm", {0, 45, 0}},
                        {"LeftUpLeg", {-40 * std::sin(t), 0, 5}},
                        {"LeftLeg", {30 + 20 * std::sin(t), 0, 0}},
                        {"LeftFoot", {10, 0, 0}},
                        {"RightUpLeg", {20 * std::sin(t), 10, 0}},
                        {"RightLeg", {15, 0, 0}}};
    frames.push_back(frame);
  }
  return frames;
}

// The same with a T-pose before it.
inline std::vector<TestFrame> WriggleAfterTPose() {
  std::vector<TestFrame> frames = Wriggle();
  frames.insert(frames.begin(), TestFrame{});
  return frames;
}

// The same angles under other names.
inline std::vector<TestFrame> Renamed(std::vector<TestFrame> frames,
                                      const std::array<std::string, kBoneCount>& names) {
  const TestBvh before(TestSkeleton());
  for (TestFrame& frame : frames) {
    std::map<std::string, Vector3<double>> renamed;
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      const auto found = frame.angles_deg.find(before.names[bone]);
      if (found != frame.angles_deg.end()) renamed[names[bone]] = found->second;
    }
    frame.angles_deg = renamed;
  }
  return frames;
}

}  // namespace vitruvia
