#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "math/rigid.h"
#include "math/rotation.h"
#include "mocap_support.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using Vector3d = Vector3<double>;
using Matrix3d = Matrix3<double>;
using enum BoneId;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Each bone's rotation from the rest pose in the subject's axes.
std::array<Matrix3d, kBoneCount> Turned(const MotionSample& sample) {
  std::array<Matrix3d, kBoneCount> turned;
  const BoneTransforms bones = ForwardKinematics(TestSkeleton(), sample.pose);
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) turned[bone] = bones[bone].rotation;
  return turned;
}

Matrix3d TurnOf(const Motion& motion, BoneId bone, double time_s = 0.0) {
  return Turned(motion.At(time_s))[static_cast<std::size_t>(bone)];
}

// In which direction a bone points that points to `at_rest` in the rest pose.
Vector3d DirectionOf(const Motion& motion, BoneId bone, const Vector3d& at_rest) {
  return TurnOf(motion, bone) * at_rest;
}

Vector3d RestDirection(BoneId bone) {
  const auto i = static_cast<std::size_t>(bone);
  return (TestSkeleton().tips[i] - TestSkeleton().joints[i]).normalized();
}

void ExpectSameMotion(const Motion& a, const Motion& b, double tolerance = 1e-9) {
  EXPECT_LT(Difference(a, b), tolerance);
}

// --- Poses
// -------------------------------------------------------------------------------------------

TEST(Mocap, RestingPerformerStandsInTheRestPose) {
  const auto bvh = FromBvh(TestBvh(TestSkeleton()).Text({TestFrame{}}));
  const JointPose rest = JointPose::Rest(TestSkeleton());
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    EXPECT_LT((bvh->At(0).pose.local_rotations[bone] - Matrix3d::Identity()).norm(), 1e-9);
  }
  EXPECT_NEAR(bvh->At(0).pose.pelvis_position.y(), rest.pelvis_position.y(), 1e-9);
  EXPECT_EQ(bvh->At(0).clearance_m, 0.0);
  EXPECT_TRUE(bvh->At(0).grounded);
}

TEST(Mocap, EachBoneOfTheSameBuildTurnsAsItsJointDoes) {
  const std::vector<TestFrame> frames = Wriggle();
  const auto motion = FromBvh(TestBvh(TestSkeleton()).Text(frames));
  const TestBvh names(TestSkeleton());
  for (const std::size_t i : {std::size_t{0}, std::size_t{7}, std::size_t{39}}) {
    const auto turned = Turned(motion->At(0.01 * static_cast<double>(i)));
    // Joints multiply down the tree, as the file says: z, y, x.
    std::array<Matrix3d, kBoneCount> expected;
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      const auto found = frames[i].angles_deg.find(names.names[bone]);
      const Vector3d angles =
          found == frames[i].angles_deg.end() ? Vector3d::Zero() : found->second;
      expected[bone] = Turn(angles.z(), Vector3d::UnitZ()) * Turn(angles.y(), Vector3d::UnitY()) *
                       Turn(angles.x(), Vector3d::UnitX());
      const int parent = Bones()[bone].parent;
      if (parent >= 0) expected[bone] = expected[static_cast<std::size_t>(parent)] * expected[bone];
    }
    // Up to the turn that lets the subject face the front in the first frame.
    const Matrix3d heading = turned[0] * expected[0].transpose();
    EXPECT_NEAR(heading(1, 1), 1.0, 1e-9);
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      EXPECT_LT((turned[bone] - heading * expected[bone]).norm(), 1e-8) << Bones()[bone].name;
    }
  }
}

TEST(Mocap, LimbsPointWhereThePerformersDoWhateverTheRestPose) {
  // CMU's rest pose has the legs 20° apart; turning them back makes the performer stand upright.
  const auto upright = FromAmc(Amc(AmcFrame(1, {{"lfemur", "0 0 -20"}, {"rfemur", "0 0 20"}})));
  for (const BoneId bone : {kLeftThigh, kLeftShin, kRightThigh, kRightShin}) {
    EXPECT_LT((DirectionOf(*upright, bone, RestDirection(bone)) + Vector3d::UnitY()).norm(), 1e-6);
  }
  // The feet, which CMU tilts with the legs, then stand flat and point to the front.
  EXPECT_LT((TurnOf(*upright, kLeftFoot) - Matrix3d::Identity()).norm(), 1e-6);
  EXPECT_LT((TurnOf(*upright, kRightFoot) - Matrix3d::Identity()).norm(), 1e-6);

  const auto apart = FromAmc(Amc(AmcFrame(1, {})));
  EXPECT_NEAR(DirectionOf(*apart, kLeftThigh, RestDirection(kLeftThigh)).x(),
              std::sin(20 * kRadiansPerDegree), 1e-6);
  EXPECT_NEAR(DirectionOf(*apart, kRightShin, RestDirection(kRightShin)).x(),
              -std::sin(20 * kRadiansPerDegree), 1e-6);
}

TEST(Mocap, KneesAndElbowsOfAnAsfBendAboutItsOwnAxes) {
  const auto motion =
      FromAmc(Amc(AmcFrame(1, {{"lfemur", "-90 0 -20"}, {"ltibia", "90"}, {"lradius", "90"}})));
  // The thigh is raised to the front by −90° about x; the knee lets the shin hang again.
  EXPECT_LT(
      (DirectionOf(*motion, kLeftThigh, RestDirection(kLeftThigh)) - Vector3d::UnitZ()).norm(),
      1e-6);
  EXPECT_LT((DirectionOf(*motion, kLeftShin, RestDirection(kLeftShin)) + Vector3d::UnitY()).norm(),
            1e-6);
  // The axis of CMU's left elbow: x of Rz(−90°) Ry(−30°) Rx(180°).
  const Vector3d axis = Turn(-90, Vector3d::UnitZ()) * Turn(-30, Vector3d::UnitY()) *
                        Turn(180, Vector3d::UnitX()) * Vector3d::UnitX();
  EXPECT_LT((DirectionOf(*motion, kLeftForearm, RestDirection(kLeftForearm)) -
             Turn(90, axis) * Vector3d::UnitX())
                .norm(),
            1e-6);
}

TEST(Mocap, ArmsThatHangInTheRestPoseHangInTheMotion) {
  Skeleton hanging = TestSkeleton();
  for (const auto& [upper_arm, forearm, hand] :
       {std::tuple{kLeftUpperArm, kLeftForearm, kLeftHand},
        std::tuple{kRightUpperArm, kRightForearm, kRightHand}}) {
    const Vector3d shoulder = hanging.joints[static_cast<std::size_t>(upper_arm)];
    const auto hang = [&](Vector3d& point) {
      point = shoulder - (point - shoulder).norm() * Vector3d::UnitY();
    };
    hang(hanging.joints[static_cast<std::size_t>(forearm)]);
    hang(hanging.joints[static_cast<std::size_t>(hand)]);
    hang(hanging.tips[static_cast<std::size_t>(hand)]);
  }
  const auto motion = FromBvh(TestBvh(hanging).Text({TestFrame{}}));
  for (const BoneId bone : {kLeftUpperArm, kLeftForearm, kRightUpperArm, kRightForearm}) {
    EXPECT_LT((DirectionOf(*motion, bone, RestDirection(bone)) + Vector3d::UnitY()).norm(), 1e-9);
  }
  // Palms, which look down in the T-pose, look at the thighs.
  EXPECT_NEAR(DirectionOf(*motion, kLeftHand, -Vector3d::UnitY()).x(), -1.0, 1e-6);
  EXPECT_NEAR(DirectionOf(*motion, kRightHand, -Vector3d::UnitY()).x(), 1.0, 1e-6);
}

TEST(Mocap, ForearmTakesHalfOfAWristsTwist) {
  std::string asf = kTestAsf;
  const std::string bone = "  begin\n    name lhand";
  asf.insert(
      asf.find(bone),
      "  begin\n name lwrist\n direction 1 0 0\n length 1\n axis 0 90 90 XYZ\n dof ry\n end\n");
  const std::string link = "lradius lhand";
  asf.replace(asf.find(link), link.size(), "lradius lwrist\n lwrist lhand");
  const auto motion = FromAmc(Amc(AmcFrame(1, {}) + "lwrist 60\n"), asf);
  const Vector3d twist = LogSo3<double>(TurnOf(*motion, kLeftForearm));
  const Vector3d whole = LogSo3<double>(TurnOf(*motion, kLeftHand));
  EXPECT_NEAR(twist.norm(), 30 * kRadiansPerDegree, 1e-6);
  EXPECT_NEAR(whole.norm(), 60 * kRadiansPerDegree, 1e-6);
  EXPECT_NEAR(std::abs(twist.normalized().x()), 1.0, 1e-6);
}

// --- What must not matter
// ----------------------------------------------------------------------------

TEST(Mocap, UnitOfTheFileDoesNotMatter) {
  TestBvh metres(TestSkeleton()), inches(TestSkeleton());
  inches.unit = 39.37;
  ExpectSameMotion(*FromBvh(metres.Text(Wriggle())), *FromBvh(inches.Text(Wriggle())), 1e-7);
}

TEST(Mocap, UpAxisOfTheFileDoesNotMatter) {
  // z up, −y to the front. Channels are named by the file's axes, so the same turn has other
  // letters: about x stays, about our y is about their z, about our z about their −y.
  TestBvh z_up(TestSkeleton());
  z_up.to_file = [](const Vector3d& v) { return Vector3d(v.x(), -v.z(), v.y()); };
  std::vector<TestFrame> ours(3), theirs(3);
  for (int i = 0; i < 3; ++i) {
    ours[i].root = theirs[i].root = {0.1 * i, 0.0, 0.2 * i};
    ours[i].angles_deg = {{"LeftUpLeg", {-20.0 * i, 0, 0}}, {"Hips", {0, 10.0 + i, 0}}};
    theirs[i].angles_deg = {{"LeftUpLeg", {-20.0 * i, 0, 0}}, {"Hips", {0, 0, 10.0 + i}}};
  }
  ExpectSameMotion(*FromBvh(TestBvh(TestSkeleton()).Text(ours)), *FromBvh(z_up.Text(theirs)));
}

TEST(Mocap, NamesOfCommonRigsAreUnderstood) {
  const std::string expected = TestBvh(TestSkeleton()).Text(Wriggle());
  const auto motion = FromBvh(expected);
  const std::array<std::array<std::string, kBoneCount>, 4> rigs{{
      {"mixamorig:Hips", "mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Neck", "mixamorig:Head",
       "mixamorig:LeftArm", "mixamorig:LeftForeArm", "mixamorig:LeftHand", "mixamorig:RightArm",
       "mixamorig:RightForeArm", "mixamorig:RightHand", "mixamorig:LeftUpLeg", "mixamorig:LeftLeg",
       "mixamorig:LeftFoot", "mixamorig:RightUpLeg", "mixamorig:RightLeg", "mixamorig:RightFoot"},
      {"Bip01", "Bip01_Spine", "Bip01_Spine1", "Bip01_Neck", "Bip01_Head", "Bip01_L_UpperArm",
       "Bip01_L_Forearm", "Bip01_L_Hand", "Bip01_R_UpperArm", "Bip01_R_Forearm", "Bip01_R_Hand",
       "Bip01_L_Thigh", "Bip01_L_Calf", "Bip01_L_Foot", "Bip01_R_Thigh", "Bip01_R_Calf",
       "Bip01_R_Foot"},
      {"Hips", "Chest", "Chest2", "Neck", "Head", "LeftShoulder", "LeftElbow", "LeftWrist",
       "RightShoulder", "RightElbow", "RightWrist", "LeftHip", "LeftKnee", "LeftAnkle", "RightHip",
       "RightKnee", "RightAnkle"},
      {"pelvis", "a", "b", "c", "head", "upper_arm.L", "forearm.L", "hand.L", "upper_arm.R",
       "forearm.R", "hand.R", "thigh.L", "shin.L", "foot.L", "thigh.R", "shin.R", "foot.R"},
  }};
  for (const auto& names : rigs) {
    SCOPED_TRACE(names[5]);
    TestBvh rig(TestSkeleton());
    rig.names = names;
    ExpectSameMotion(*motion, *FromBvh(rig.Text(Renamed(Wriggle(), names))));
  }
}

// --- Where the body is
// -------------------------------------------------------------------------------

TEST(Mocap, StartsAtTheOriginFacingTheFrontAndWalksAsThePerformer) {
  std::vector<TestFrame> frames(2);
  const Vector3d facing = Turn(130, Vector3d::UnitY()) * Vector3d::UnitZ();
  frames[0].root = {3.0, 0.0, -5.0};
  frames[1].root = frames[0].root + 0.7 * facing;
  for (TestFrame& frame : frames) frame.angles_deg["Hips"] = {0, 130, 0};
  const auto motion = FromBvh(TestBvh(TestSkeleton()).Text(frames));
  EXPECT_LT((TurnOf(*motion, kPelvis) - Matrix3d::Identity()).norm(), 1e-9);
  const Vector3d start = motion->At(0).pose.pelvis_position,
                 end = motion->At(1).pose.pelvis_position;
  EXPECT_NEAR(start.x(), 0.0, 1e-9);
  EXPECT_LT((end - start - 0.7 * Vector3d::UnitZ()).norm(), 1e-9);
}

TEST(Mocap, StepsAreScaledByLegLength) {
  Skeleton tall = TestSkeleton();
  for (auto* points : {&tall.joints, &tall.tips}) {
    for (Vector3d& point : *points) point *= 1.2;
  }
  std::vector<TestFrame> frames(2);
  frames[1].root.z() = 1.2;
  const auto motion = FromBvh(TestBvh(tall).Text(frames));
  EXPECT_NEAR(motion->At(1).pose.pelvis_position.z() - motion->At(0).pose.pelvis_position.z(), 1.0,
              1e-9);
}

TEST(Mocap, JumpsRiseAsFarAsThePerformerAndStandingStaysOnTheFloor) {
  // A flight of 0.5 s in the middle of 3 s: rises g t²/8 = 0.307 m.
  constexpr double kGravity = 9.81, kFlight_s = 0.5;
  std::vector<TestFrame> frames(300);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double t = 0.01 * static_cast<double>(i) - 1.5;
    frames[i].root.y() = std::max(0.0, 0.5 * kGravity * (kFlight_s * kFlight_s / 4.0 - t * t));
  }
  const auto motion = FromBvh(TestBvh(TestSkeleton()).Text(frames));
  EXPECT_NEAR(motion->At(1.5).clearance_m, kGravity * kFlight_s * kFlight_s / 8.0, 1e-3);
  for (const double time : {0.0, 0.5, 1.2, 1.8, 2.9}) EXPECT_EQ(motion->At(time).clearance_m, 0.0);
}

TEST(Mocap, SlopingAndWobblingFloorsAreNoJumps) {
  std::vector<TestFrame> frames(400);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double t = 0.01 * static_cast<double>(i);
    frames[i].root = {0.0, 0.02 * t + 0.008 * std::sin(7.0 * t), 1.2 * t};
  }
  const auto motion = FromBvh(TestBvh(TestSkeleton()).Text(frames));
  for (double time = 0.0; time < 4.0; time += 0.03) EXPECT_LT(motion->At(time).clearance_m, 0.005);
}

TEST(Mocap, HandsOnTheFloorAreNoFlight) {
  // For 0.3 s the performer stands on the finger tips: upside down, arms past the head.
  const auto joint = [](BoneId bone) {
    return TestSkeleton().joints[static_cast<std::size_t>(bone)];
  };
  const double reach =
      (TestSkeleton().tips[static_cast<std::size_t>(kLeftHand)] - joint(kLeftUpperArm)).norm();
  const double pelvis = joint(kPelvis).y();
  const double pelvis_on_hands = joint(kLeftUpperArm).y() + reach - pelvis;
  const auto frames_with_hands_at = [&](double height) {
    std::vector<TestFrame> frames(200);
    for (std::size_t i = 100; i < 130; ++i) {
      frames[i].angles_deg = {
          {"Hips", {180, 0, 0}}, {"LeftArm", {0, 0, 90}}, {"RightArm", {0, 0, -90}}};
      frames[i].root.y() = height + pelvis_on_hands - pelvis;
    }
    return frames;
  };
  const TestBvh performer(TestSkeleton());
  const auto handstand = FromBvh(performer.Text(frames_with_hands_at(0.0)));
  EXPECT_NEAR(
      (Turned(handstand->At(1.15))[static_cast<std::size_t>(kLeftUpperArm)] * Vector3d::UnitX())
          .y(),
      -1.0, 1e-6);
  EXPECT_EQ(handstand->At(1.15).clearance_m, 0.0);
  const auto flying = FromBvh(performer.Text(frames_with_hands_at(0.3)));
  // The flesh below finger tips and toe joints, which no file tells, stays a matter of centimetres.
  EXPECT_NEAR(flying->At(1.15).clearance_m, 0.3, 0.07);
}

TEST(Mocap, GoesTheShortWayBetweenFramesAndHoldsTheEnds) {
  std::vector<TestFrame> frames(2);
  frames[0].angles_deg["Head"] = {0, 40, 0};
  frames[1].angles_deg["Head"] = {0, 80, 0};
  const auto motion = FromBvh(TestBvh(TestSkeleton()).Text(frames));
  EXPECT_DOUBLE_EQ(motion->duration_s(), 0.01);
  EXPECT_LT((TurnOf(*motion, kHead, 0.0025) - Turn(50, Vector3d::UnitY())).norm(), 1e-9);
  EXPECT_LT((TurnOf(*motion, kHead, -1.0) - Turn(40, Vector3d::UnitY())).norm(), 1e-9);
  EXPECT_LT((TurnOf(*motion, kHead, 5.0) - Turn(80, Vector3d::UnitY())).norm(), 1e-9);
}

TEST(Mocap, AmcPlaysAt120FramesPerSecond) {
  std::string frames;
  for (int i = 1; i <= 61; ++i) frames += AmcFrame(i, {});
  EXPECT_DOUBLE_EQ(FromAmc(Amc(frames))->duration_s(), 0.5);
}

// --- Files
// -------------------------------------------------------------------------------------------

TEST(MocapFile, AsfPlacesBonesAtTheirParentsEnds) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.asf") << kTestAsf;
  std::ofstream(folder / "a.amc") << Amc(AmcFrame(1, {}));
  const MocapClip clip = ReadAsfAmc(folder / "a.amc", folder / "a.asf");
  ASSERT_EQ(clip.joints.size(), 21u);
  const MocapPose pose = PoseOf(clip, clip.frames[0]);
  for (std::size_t i = 0; i < clip.joints.size(); ++i) {
    if (clip.joints[i].name == "head") {
      EXPECT_LT((pose.positions[i] - Vector3d(0, 17 + 2 + 4 + 2, 0)).norm(), 1e-9);
    }
    if (clip.joints[i].name == "lhand") {
      EXPECT_LT((pose.positions[i] - Vector3d(3 + 5 + 4, 17 + 2 + 4, 0)).norm(), 1e-9);
    }
  }
}

TEST(MocapFile, AmcErrorsNameFileAndLine) {
  const std::string frame = AmcFrame(1, {});
  const auto problem = [&](const std::string& amc) {
    try {
      FromAmc(amc);
    } catch (const DataError& error) {
      return std::string(error.what());
    }
    return std::string("no DataError");
  };
  EXPECT_THAT(problem(Amc("")), HasSubstr("clip.amc:3: no frames"));
  EXPECT_THAT(
      problem(Amc(frame + "2\nhead 0 0 0\n")),
      AllOf(HasSubstr("clip.amc:23: the frame that begins here lacks"), HasSubstr("cut short")));
  EXPECT_THAT(problem(Amc(AmcFrame(1, {{"head", "0 0"}}))),
              HasSubstr("clip.amc:5: head: 2 numbers, expected 3"));
  EXPECT_THAT(problem(Amc(AmcFrame(1, {{"head", "0 zero 0"}}))),
              HasSubstr("clip.amc:5: head: expected a number, got zero"));
  EXPECT_THAT(problem(Amc(AmcFrame(1, {{"head", "0 nan 0"}}))),
              HasSubstr("clip.amc:5: head: expected a number, got nan"));
  EXPECT_THAT(problem(Amc(frame + "tail 1\n")), HasSubstr("clip.amc:22: unknown bone tail"));
  EXPECT_THAT(problem(Amc(frame + "head 1 2 3\n")), HasSubstr("clip.amc:22: head twice"));
  EXPECT_THAT([] { LoadAsfAmc("no.amc", "no.asf", TestSkeleton()); },
              ThrowsMessage<DataError>(HasSubstr("no.asf")));
}

TEST(MocapFile, AsfErrorsNameFileAndLine) {
  const auto problem = [&](const std::string& before, const std::string& after) {
    std::string asf = kTestAsf;
    asf.replace(asf.find(before), before.size(), after);
    try {
      FromAmc(Amc(AmcFrame(1, {})), asf);
    } catch (const DataError& error) {
      return std::string(error.what());
    }
    return std::string("no DataError");
  };
  EXPECT_THAT(problem("length 2\n", "length two\n"),
              HasSubstr("clip.asf:20: length: expected a number, got two"));
  EXPECT_THAT(problem("direction 0.8 -0.6 0", "direction 0.8"),
              HasSubstr("clip.asf:19: direction: expected three numbers"));
  EXPECT_THAT(problem("axis 0 0 20 XYZ", "axis 0 0 20 XXZ"),
              HasSubstr("clip.asf:28: expected three angles and their order"));
  EXPECT_THAT(problem("dof rx ry rz", "dof rx ry l"),
              HasSubstr("clip.asf:29: unknown degree of freedom l"));
  EXPECT_THAT(problem("angle deg", "angle grad"), HasSubstr("clip.asf:7: angle: expected deg"));
  EXPECT_THAT(problem("neck head", "neck heed"), HasSubstr("unknown bone heed"));
  EXPECT_THAT(problem("    neck head\n", ""), HasSubstr("bone head does not hang on the root"));
  EXPECT_THAT(problem("name rhand", "name lhand"), HasSubstr("a second bone lhand"));
  EXPECT_THAT(problem(kTestAsf, ":version 1\n"), HasSubstr("clip.asf:1: no bones"));
  EXPECT_THAT(
      problem(kTestAsf, std::string(kTestAsf).substr(0, std::string(kTestAsf).rfind('\n', 700))),
      HasSubstr("a bone's end is missing"));
}

TEST(MocapFile, BvhErrorsNameFileAndLine) {
  const std::string good = TestBvh(TestSkeleton()).Text({TestFrame{}, TestFrame{}});
  const auto problem = [&](const std::string& before, const std::string& after) {
    std::string bvh = good;
    bvh.replace(bvh.find(before), before.size(), after);
    try {
      FromBvh(bvh);
    } catch (const DataError& error) {
      return std::string(error.what());
    }
    return std::string("no DataError");
  };
  EXPECT_THAT(problem("HIERARCHY", "HIERARCHIE"),
              HasSubstr("clip.bvh:1: expected HIERARCHY, got HIERARCHIE"));
  EXPECT_THAT(problem("OFFSET 0", "OFFSET x"),
              HasSubstr("clip.bvh:4: OFFSET: expected a number, got x"));
  EXPECT_THAT(problem("Zrotation", "Wrotation"),
              HasSubstr("clip.bvh:5: unknown channel Wrotation"));
  EXPECT_THAT(problem("Frames: 2", "Frames: 3"), HasSubstr("the file ends in frame 3 of 3"));
  EXPECT_THAT(problem("Frames: 2", "Frames: 1"), HasSubstr("more numbers than 1 frames"));
  EXPECT_THAT(problem("Frames: 2", "Frames: 0"), HasSubstr("no frames"));
  EXPECT_THAT(problem("Frame Time: 0.01", "Frame Time: 0"), HasSubstr("expected above 0"));
  EXPECT_THAT(problem(good, ""), HasSubstr("clip.bvh:1: the file ends here, expected HIERARCHY"));
  EXPECT_THAT(problem(good, good.substr(0, 300)), HasSubstr("the file ends here"));
  EXPECT_THAT(problem("JOINT LeftForeArm", "JOINT Tentacle"),
              AllOf(HasSubstr("clip.bvh: cannot tell which joint is the left elbow"),
                    HasSubstr("the file has Hips, Spine")));
}

// --- CMU's clips
// -------------------------------------------------------------------------------------

class CmuClip : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("VITRUVIA_DATA");
    if (data == nullptr) GTEST_SKIP() << "VITRUVIA_DATA is not set";
    folder_ = fs::path(data) / "cmu";
    if (!fs::exists(folder_)) GTEST_SKIP() << folder_ << " does not exist";
  }

  std::unique_ptr<Motion> Load(const std::string& clip) const {
    return LoadAsfAmc(folder_ / (clip + ".amc"), folder_ / (clip.substr(0, 2) + ".asf"),
                      TestSkeleton());
  }

  fs::path folder_;
};

TEST_F(CmuClip, WalkGoesThreeMetresToTheFrontOnTheFloor) {
  const auto walk = Load("02_01");
  EXPECT_NEAR(walk->duration_s(), 342.0 / 120.0, 1e-9);
  EXPECT_GT(TurnOf(*walk, kPelvis)(2, 2), 0.95);
  const Vector3d way = walk->At(10.0).pose.pelvis_position - walk->At(0.0).pose.pelvis_position;
  EXPECT_NEAR(way.z(), 3.4, 0.3);
  EXPECT_LT(std::abs(way.x()), 0.8);
  for (double time = 0.0; time < walk->duration_s(); time += 0.02) {
    EXPECT_LT(walk->At(time).clearance_m, 0.035) << time;  // marker noise, not flight
  }
}

TEST_F(CmuClip, JumpsLeaveTheFloorAndComeBack) {
  const auto jumps = Load("01_01");
  double highest = 0.0, on_the_floor = 0.0;
  int samples = 0;
  for (double time = 0.0; time < jumps->duration_s(); time += 0.02, ++samples) {
    const double clearance = jumps->At(time).clearance_m;
    highest = std::max(highest, clearance);
    on_the_floor += clearance == 0.0;
  }
  EXPECT_GT(highest, 0.15);
  EXPECT_LT(highest, 0.6);
  EXPECT_GT(on_the_floor / samples, 0.6);
}

TEST_F(CmuClip, KneesAndElbowsBendOneWayOnly) {
  for (const char* clip : {"01_01", "02_01", "02_05", "02_06", "11_01"}) {
    SCOPED_TRACE(clip);
    const auto motion = Load(clip);
    for (double time = 0.0; time < motion->duration_s(); time += 0.1) {
      const auto turned = Turned(motion->At(time));
      // In the axes of the thigh, a bent shin points backwards; in those of the upper arm, which
      // the T-pose has palms down, a bent forearm points to the front.
      for (const auto& [upper, lower, bent_to] :
           {std::tuple{kLeftThigh, kLeftShin, -1.0}, std::tuple{kRightThigh, kRightShin, -1.0},
            std::tuple{kLeftUpperArm, kLeftForearm, 1.0},
            std::tuple{kRightUpperArm, kRightForearm, 1.0}}) {
        const Vector3d in_upper = turned[static_cast<std::size_t>(upper)].transpose() *
                                  turned[static_cast<std::size_t>(lower)] * RestDirection(lower);
        EXPECT_GT(bent_to * in_upper.z(), -0.15) << Bones()[static_cast<std::size_t>(lower)].name;
      }
    }
  }
}

}  // namespace
}  // namespace vitruvia
