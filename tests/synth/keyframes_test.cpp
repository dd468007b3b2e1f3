#include <numbers>

#include <gmock/gmock.h>

#include "core/random.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "motion_files.h"
#include "synth/motions/keyframes_spline.h"

namespace vitruvia {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

double Slope(const MonotoneSpline& spline, double from, double to) {
  return (spline.At(to) - spline.At(from)) / (to - from);
}

TEST(MonotoneSpline, PassesThroughItsPointsWithOneDerivativeAndWithinTheirRange) {
  RandomStream random(7, "spline");
  for (const SplineEnds ends : {SplineEnds::kAtRest, SplineEnds::kLooped}) {
    std::vector<double> times{0.0}, values{random.Uniform(-3, 3)};
    for (int i = 1; i < 12; ++i) {
      times.push_back(times.back() + random.Uniform(0.1, 1.0));
      values.push_back(random.Uniform(-3, 3));
    }
    const MonotoneSpline spline(times, values, ends);
    for (std::size_t i = 0; i < times.size(); ++i) EXPECT_DOUBLE_EQ(spline.At(times[i]), values[i]);
    constexpr double kStep = 1e-6;
    for (std::size_t i = 1; i + 1 < times.size(); ++i) {
      EXPECT_NEAR(Slope(spline, times[i] - kStep, times[i]),
                  Slope(spline, times[i], times[i] + kStep), 1e-3);
    }
    for (std::size_t i = 1; i < times.size(); ++i) {
      const auto [low, high] = std::minmax(values[i - 1], values[i]);
      for (int k = 1; k < 20; ++k) {
        const double value = spline.At(std::lerp(times[i - 1], times[i], k / 20.0));
        EXPECT_GE(value, low - 1e-12);
        EXPECT_LE(value, high + 1e-12);
      }
    }
  }
}

TEST(MonotoneSpline, StandsStillAtItsEndsOrGoesRound) {
  const std::vector<double> times{0.0, 1.0, 2.0, 3.0}, values{0.0, 1.0, 2.0, 3.0};
  constexpr double kStep = 1e-6;
  const MonotoneSpline at_rest(times, values, SplineEnds::kAtRest);
  EXPECT_NEAR(Slope(at_rest, 0.0, kStep), 0.0, 1e-5);
  EXPECT_NEAR(Slope(at_rest, 3.0 - kStep, 3.0), 0.0, 1e-5);
  const MonotoneSpline looped(times, values, SplineEnds::kLooped);
  for (const double t : {0.1, 0.7, 1.5, 2.9}) EXPECT_NEAR(looped.At(t), t, 1e-12);
}

TEST(MonotoneSpline, RejectsTimesThatDoNotIncrease) {
  EXPECT_THROW(MonotoneSpline({0.0, 1.0, 1.0}, {0, 0, 0}, SplineEnds::kAtRest),
               std::invalid_argument);
  EXPECT_THROW(MonotoneSpline({0.0}, {0, 0}, SplineEnds::kAtRest), std::invalid_argument);
  EXPECT_THROW(MonotoneSpline({}, {}, SplineEnds::kAtRest), std::invalid_argument);
}

constexpr const char* kSquatAndTurn = R"({
  "poses": [{"name": "low", "angles": {"hips": {"flexion_deg": 50}, "knees": {"flexion_deg": 70}}}],
  "keyframes": [
    {"time_s": 0, "planted": ["left_foot", "right_foot"]},
    {"time_s": 0.8, "pose": "low", "angles": {"left_elbow": {"flexion_deg": 40}}, "planted": ["left_foot", "right_foot"]},
    {"time_s": 1.3, "angles": {"left_elbow": {"flexion_deg": 90}}, "planted": ["left_foot", "right_foot"], "heading_deg": 10},
    {"time_s": 2.1, "pose": "low", "position_m": [0.2, 0.1], "planted": ["left_foot"], "clearance_m": 0.2},
    {"time_s": 3, "heading_deg": -5}]})";

TEST(Keyframes, HaveTheAnglesOfTheirFileAtTheirTimes) {
  const auto motion = MotionOf(kSquatAndTurn);
  EXPECT_DOUBLE_EQ(motion->duration_s(), 3.0);
  const auto angle = [&](double time, BoneId bone) {
    const auto rotation = motion->At(time).pose.local_rotations[static_cast<std::size_t>(bone)];
    return LogSo3<double>(rotation).norm() * kDegreesPerRadian;
  };
  EXPECT_NEAR(angle(0.8, BoneId::kLeftForearm), 40.0, 1e-9);
  EXPECT_NEAR(angle(1.3, BoneId::kLeftForearm), 90.0, 1e-9);
  EXPECT_NEAR(angle(0.8, BoneId::kRightShin), 70.0, 1e-9);
  EXPECT_NEAR(angle(1.3, BoneId::kRightShin), 0.0, 1e-9);
  EXPECT_NEAR(angle(1.3, BoneId::kPelvis), 10.0, 1e-9);
  EXPECT_DOUBLE_EQ(motion->At(2.1).clearance_m, 0.2);
  EXPECT_TRUE(motion->At(2.1).grounded);
  const double between = angle(1.0, BoneId::kLeftForearm);
  EXPECT_GT(between, 40.0);
  EXPECT_LT(between, 90.0);
}

TEST(Keyframes, MoveWithOneVelocityOnBothSidesOfAKey) {
  const auto motion = MotionOf(kSquatAndTurn);
  constexpr double kStep = 1e-5;
  for (const double key : {0.8, 1.3, 2.1}) {
    const PosedBones before(*motion, key - kStep), at(*motion, key), after(*motion, key + kStep);
    for (std::size_t i = 0; i < kBoneCount; ++i) {
      const Vector3<double> jump =
          (after.joints[i] - at.joints[i]) - (at.joints[i] - before.joints[i]);
      EXPECT_LT(jump.norm() / kStep, 2e-3) << Bones()[i].joint << " at " << key << " s";
    }
  }
}

TEST(Keyframes, KeepPlantedFeetWhereTheyAre) {
  const auto motion = MotionOf(kSquatAndTurn);
  const PosedBones start(*motion, 0.0);
  double pelvis_moves = 0.0;
  for (double time = 0.0; time < 0.8; time += 0.05) {
    const PosedBones now(*motion, time);
    // The foot turns about its middle, since this ankle is held.
    const Vector3<double> middle = now.Joint(BoneId::kLeftFoot) + now.Tip(BoneId::kLeftFoot);
    const Vector3<double> first = start.Joint(BoneId::kLeftFoot) + start.Tip(BoneId::kLeftFoot);
    EXPECT_NEAR(middle.x(), first.x(), 1e-6);
    EXPECT_NEAR(middle.z(), first.z(), 1e-6);
    pelvis_moves = std::max(pelvis_moves, (now.joints[0] - start.joints[0]).norm());
  }
  EXPECT_GT(pelvis_moves, 0.1);
}

TEST(Keyframes, LoopWithoutASeamAndCarryTheirPathOn) {
  const auto motion = MotionOf(R"({"loop": true, "keyframes": [
    {"time_s": 0, "angles": {"knees": {"flexion_deg": 10}}},
    {"time_s": 0.5, "angles": {"knees": {"flexion_deg": 60}}, "position_m": [0, 0.4], "heading_deg": 170},
    {"time_s": 1.2, "angles": {"knees": {"flexion_deg": 10}}, "position_m": [0.1, 1], "heading_deg": 360}]})");
  for (const double time : {0.0, 0.3, 1.1}) {
    const PosedBones first(*motion, time), third(*motion, time + 2.4);
    for (std::size_t i = 0; i < kBoneCount; ++i) {
      EXPECT_NEAR((third.joints[i] - first.joints[i] - Vector3<double>(0.2, 0.0, 2.0)).norm(), 0.0,
                  1e-12);
    }
  }
  constexpr double kStep = 1e-6;
  const auto knee = [&](double time) {
    return LogSo3<double>(
               motion->At(time).pose.local_rotations[static_cast<std::size_t>(BoneId::kLeftShin)])
        .x();
  };
  EXPECT_NEAR(knee(1.2 - kStep), knee(1.2 + kStep), 1e-5);
  EXPECT_NEAR(knee(1.2) - knee(1.2 - kStep), knee(1.2 + kStep) - knee(1.2), 1e-9);
}

TEST(Keyframes, MirrorWhatTheyAreToldTo) {
  constexpr const char* kAngles = R"("angles": {
      "left_shoulder": {"flexion_deg": 50, "abduction_deg": 30, "internal_rotation_deg": 20},
      "left_elbow": {"flexion_deg": 80, "pronation_deg": 30},
      "right_wrist": {"flexion_deg": 40, "ulnar_deviation_deg": 20},
      "left_hip": {"flexion_deg": 60, "abduction_deg": 20, "internal_rotation_deg": -15},
      "right_knee": {"flexion_deg": 70}, "right_ankle": {"dorsiflexion_deg": 10, "inversion_deg": 15},
      "spine": {"flexion_deg": 20, "bend_left_deg": 10, "turn_left_deg": 25},
      "neck": {"flexion_deg": -5, "bend_left_deg": -10, "turn_left_deg": 35}}, "roll_deg": 12, "pitch_deg": 8)";
  const auto plain = MotionOf(fmt::format(R"({{"keyframes": [{{"time_s": 0, {}}}]}})", kAngles));
  const auto mirrored =
      MotionOf(fmt::format(R"({{"keyframes": [{{"time_s": 0, "mirrored": true, {}}}]}})", kAngles));
  const auto then = MotionOf(fmt::format(
      R"({{"then_mirrored": true, "keyframes": [{{"time_s": 0}}, {{"time_s": 1, {}}}, {{"time_s": 2}}]}})",
      kAngles));
  EXPECT_DOUBLE_EQ(then->duration_s(), 4.0);
  const PosedBones bones(*plain, 0.0), once(*mirrored, 0.0), third(*then, 3.0);
  for (std::size_t i = 0; i < kBoneCount; ++i) {
    const Vector3<double> expected = bones.tips[i].cwiseProduct(Vector3<double>(-1, 1, 1));
    const std::size_t other = static_cast<std::size_t>(Bones()[i].mirror);
    EXPECT_NEAR((once.tips[other] - expected).norm(), 0.0, 1e-12) << Bones()[i].name;
    EXPECT_NEAR((third.tips[other] - expected).norm(), 0.0, 1e-12) << Bones()[i].name;
  }
  EXPECT_GT((bones.Tip(BoneId::kLeftHand) - once.Tip(BoneId::kLeftHand)).norm(), 0.3);
}

// Whether `angles` bring the far end of a bone from where it is in the neutral position towards
// `direction`, by at least 5 cm and more than anywhere else.
void ExpectMoves(const std::string& angles, BoneId bone, const Vector3<double>& direction,
                 const std::string& before = "") {
  const PosedBones neutral(*StillOf(before), 0.0);
  const PosedBones posed(*StillOf(before.empty() ? angles : before + ", " + angles), 0.0);
  const Vector3<double> moved = posed.Tip(bone) - neutral.Tip(bone);
  EXPECT_GT(moved.dot(direction), 0.05) << angles;
  EXPECT_GT(moved.normalized().dot(direction), 0.6) << angles << " moves by " << moved.transpose();
}

TEST(JointAngles, AreZeroWhereTheArmsHang) {
  const PosedBones neutral(*StillOf(""), 0.0);
  for (const BoneId arm : {BoneId::kLeftUpperArm, BoneId::kRightUpperArm}) {
    const int hand = static_cast<int>(arm) + 2;
    const Vector3<double> along = neutral.Tip(static_cast<BoneId>(hand)) - neutral.Joint(arm);
    EXPECT_NEAR(along.normalized().y(), -1.0, 1e-12);
  }
  const PosedBones t(*StillOf(R"("shoulders": {"abduction_deg": 90})"), 0.0);
  for (std::size_t i = 0; i < kBoneCount; ++i) {
    EXPECT_NEAR((t.tips[i] - TestSkeleton().tips[i]).norm(), 0.0, 1e-12) << Bones()[i].name;
  }
}

TEST(JointAngles, MeanWhatAnAnatomistMeans) {
  const Vector3<double> left(1, 0, 0), up(0, 1, 0), front(0, 0, 1);
  const Vector3<double> right = -left, back = -front;
  using enum BoneId;
  ExpectMoves(R"("left_elbow": {"flexion_deg": 60})", kLeftForearm, front);
  ExpectMoves(R"("right_elbow": {"flexion_deg": 60})", kRightForearm, front);
  ExpectMoves(R"("left_shoulder": {"flexion_deg": 60})", kLeftUpperArm, front);
  ExpectMoves(R"("right_shoulder": {"flexion_deg": -50})", kRightUpperArm, back);
  ExpectMoves(R"("left_shoulder": {"abduction_deg": 60})", kLeftUpperArm, left);
  ExpectMoves(R"("right_shoulder": {"abduction_deg": 60})", kRightUpperArm, right);
  ExpectMoves(R"("left_hip": {"flexion_deg": 60})", kLeftThigh, front);
  ExpectMoves(R"("right_hip": {"abduction_deg": 40})", kRightThigh, right);
  ExpectMoves(R"("left_knee": {"flexion_deg": 60})", kLeftShin, back);
  ExpectMoves(R"("right_knee": {"flexion_deg": 60})", kRightShin, back);
  ExpectMoves(R"("left_ankle": {"dorsiflexion_deg": 20})", kLeftFoot, up);
  ExpectMoves(R"("left_wrist": {"flexion_deg": 60})", kLeftHand, right);
  ExpectMoves(R"("right_wrist": {"flexion_deg": 60})", kRightHand, left);
  ExpectMoves(R"("left_wrist": {"ulnar_deviation_deg": 30})", kLeftHand, back);
  ExpectMoves(R"("right_wrist": {"ulnar_deviation_deg": 30})", kRightHand, back);
  ExpectMoves(R"("spine": {"flexion_deg": 40})", kHead, front);
  ExpectMoves(R"("spine": {"bend_left_deg": 30})", kHead, left);
  ExpectMoves(R"("spine": {"turn_left_deg": 45})", kLeftHand, back,
              R"("shoulders": {"abduction_deg": 90})");
  ExpectMoves(R"("neck": {"flexion_deg": 40})", kHead, front);
  ExpectMoves(R"("neck": {"bend_left_deg": 40})", kHead, left);
  // Axial rotations show in what hangs on the limb.
  ExpectMoves(R"("left_shoulder": {"internal_rotation_deg": 60})", kLeftForearm, right,
              R"("left_elbow": {"flexion_deg": 90})");
  ExpectMoves(R"("right_shoulder": {"internal_rotation_deg": 60})", kRightForearm, left,
              R"("right_elbow": {"flexion_deg": 90})");
  ExpectMoves(R"("left_hip": {"internal_rotation_deg": 40})", kLeftFoot, right);
  ExpectMoves(R"("right_hip": {"internal_rotation_deg": 40})", kRightFoot, left);
  // Pronation turns the palm of a hanging hand to the back, which then flexes backwards.
  ExpectMoves(R"("left_wrist": {"flexion_deg": 60})", kLeftHand, back,
              R"("left_elbow": {"pronation_deg": 80})");
  ExpectMoves(R"("right_wrist": {"flexion_deg": 60})", kRightHand, back,
              R"("right_elbow": {"pronation_deg": 80})");
}

TEST(JointAngles, FlexingAnElbowBringsTheHandToTheShoulder) {
  const PosedBones bent(*StillOf(R"("elbows": {"flexion_deg": 140})"), 0.0);
  for (const BoneId arm : {BoneId::kLeftUpperArm, BoneId::kRightUpperArm}) {
    const BoneId hand = static_cast<BoneId>(static_cast<int>(arm) + 2);
    EXPECT_LT((bent.Joint(hand) - bent.Joint(arm)).norm(), 0.2);
  }
}

TEST(JointAngles, InversionTurnsTheSolesTowardsEachOther) {
  const auto motion = StillOf(R"("ankles": {"inversion_deg": 30})");
  const BoneTransforms bones = ForwardKinematics(TestSkeleton(), motion->At(0.0).pose);
  const Vector3<double> down(0, -1, 0);
  EXPECT_NEAR((bones[static_cast<std::size_t>(BoneId::kLeftFoot)].rotation * down).x(), -0.5,
              1e-12);
  EXPECT_NEAR((bones[static_cast<std::size_t>(BoneId::kRightFoot)].rotation * down).x(), 0.5,
              1e-12);
}

TEST(JointAngles, AreRefusedBeyondTheirLimits) {
  EXPECT_EQ(
      ProblemOf(
          R"({"keyframes": [{"time_s": 0}, {"time_s": 1, "angles": {"left_knee": {"flexion_deg": 170}}}]})"),
      "motion.json: keyframes[1].angles.left_knee.flexion_deg: expected a number in 0 … 150 deg, "
      "got 170");
  EXPECT_EQ(
      ProblemOf(R"({"keyframes": [{"time_s": 0, "angles": {"elbows": {"flexion_deg": -20}}}]})"),
      "motion.json: keyframes[0].angles.elbows.flexion_deg: expected a number in 0 … 150 deg, got "
      "-20");
  EXPECT_EQ(
      ProblemOf(
          R"({"keyframes": [{"time_s": 0, "angles": {"shoulders": {"flexion_deg": 150, "abduction_deg": 150}}}]})"),
      "motion.json: keyframes[0].angles.left_shoulder: flexion_deg 150 and abduction_deg 150 make "
      "a swing of "
      "212.1 deg; expected at most 180 deg");
}

TEST(MotionFile, RefusesWhatItDoesNotUnderstand) {
  EXPECT_EQ(ProblemOf(R"({"keyframes": []})"),
            "motion.json: keyframes: expected at least one key frame, got an empty list");
  EXPECT_EQ(ProblemOf("{}"), "motion.json: keyframes: missing; expected: the key frames");
  EXPECT_EQ(ProblemOf(R"({"keyframes": [{"time_s": 0.5}]})"),
            "motion.json: keyframes[0].time_s: expected 0 s, got 0.5 s");
  EXPECT_EQ(ProblemOf(R"({"keyframes": [{"time_s": 0}, {"time_s": 1}, {"time_s": 1}]})"),
            "motion.json: keyframes[2].time_s: expected more than the 1 s before it, got 1 s");
  EXPECT_EQ(ProblemOf(R"({"keyframes": [{"angles": {}}]})"),
            "motion.json: keyframes[0].time_s: missing; expected: time of the key frame");
  EXPECT_THAT(ProblemOf(R"({"keyframes": [{"time_s": 0, "angles": {"left_kneee": {}}}]})"),
              testing::StartsWith("motion.json: keyframes[0].angles.left_kneee: unknown key (value "
                                  "{}); did you mean \"left_knee\"?"));
  EXPECT_EQ(ProblemOf(R"({"keyframes": [{"time_s": 0, "angles": {"neck": {"flexion": 3}}}]})"),
            "motion.json: keyframes[0].angles.neck.flexion: unknown key (value 3); valid keys "
            "here: bend_left_deg, flexion_deg, turn_left_deg");
  EXPECT_EQ(ProblemOf(R"({"keyframe": []})"),
            "motion.json: keyframe: unknown key (value []); did you mean \"keyframes\"? valid keys "
            "here: keyframes, loop, poses, then_mirrored, title");
  EXPECT_EQ(
      ProblemOf(
          R"({"poses": [{"name": "stand", "angles": {}}], "keyframes": [{"time_s": 0, "pose": "stnad"}]})"),
      "motion.json: keyframes[0].pose: expected the name of a pose in this file (stand), got "
      "\"stnad\"; did "
      "you mean \"stand\"?");
  EXPECT_EQ(
      ProblemOf(
          R"({"poses": [{"name": "a", "angles": {}}, {"name": "a", "angles": {}}], "keyframes": [{"time_s": 0}]})"),
      "motion.json: poses[1].name: \"a\" is taken by poses[0]");
  EXPECT_EQ(ProblemOf(R"({"keyframes": [{"time_s": 0, "planted": ["left_leg"]}]})"),
            "motion.json: keyframes[0]: planted: expected any of left_foot, right_foot, left_hand, "
            "right_hand; got "
            "\"left_leg\", did you mean \"left_foot\"?");
  EXPECT_EQ(
      ProblemOf(
          R"({"keyframes": [{"time_s": 0, "angles": {"knees": {"flexion_deg": 3}, "left_knee": {"flexion_deg": 4}}}]})"),
      "motion.json: keyframes[0].angles: flexion_deg of the left_knee is given twice: by \"knees\" "
      "and by "
      "\"left_knee\"");
}

TEST(MotionFile, RefusesALoopThatDoesNotClose) {
  EXPECT_EQ(
      ProblemOf(
          R"({"loop": true, "keyframes": [{"time_s": 0}, {"time_s": 1, "angles": {"left_hip": {"flexion_deg": 5}}}]})"),
      "motion.json: loop: expected the motion to end as it begins: left_hip.flexion_deg is 5 and "
      "0");
  EXPECT_EQ(
      ProblemOf(
          R"({"loop": true, "keyframes": [{"time_s": 0}, {"time_s": 1, "heading_deg": 90}]})"),
      "motion.json: loop: expected the motion to end as it begins: it turns by 90 degrees, no "
      "multiple of 360");
  EXPECT_EQ(ProblemOf(R"({"loop": true, "keyframes": [{"time_s": 0}]})"),
            "motion.json: keyframes: expected at least two of a motion that repeats, got 1");
  EXPECT_EQ(
      ProblemOf(
          R"({"then_mirrored": true, "keyframes": [{"time_s": 0, "angles": {"left_knee": {"flexion_deg": 9}}},
                          {"time_s": 1, "angles": {"left_knee": {"flexion_deg": 9}}}]})"),
      "motion.json: then_mirrored: expected the last key frame to be the mirror image of the "
      "first: left_knee.flexion_deg is 9 and 0");
}

}  // namespace
}  // namespace vitruvia
