// Motion capture files of the wild: rest poses, rigs, encodings, headers and rates that differ from
// what most files have. Each is understood or refused with file, place and cause.
#include <numbers>

#include <gmock/gmock.h>

#include "core/random.h"
#include "math/rotation.h"
#include "mocap_support.h"

namespace vitruvia {
namespace {

using Vector3d = Vector3<double>;
using Matrix3d = Matrix3<double>;
using enum BoneId;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string Replaced(std::string text, const std::string& before, const std::string& after) {
  const std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before;
  return text.replace(at, before.size(), after);
}

std::string ReplacedAll(std::string text, const std::string& before, const std::string& after) {
  for (std::size_t at = text.find(before); at != std::string::npos;
       at = text.find(before, at + after.size())) {
    text.replace(at, before.size(), after);
  }
  return text;
}

const std::unique_ptr<Motion>& PlainWriggle() {
  static const auto motion = FromBvh(TestBvh(TestSkeleton()).Text(WriggleAfterTPose()));
  return motion;
}

// --- The zero pose

// All bones of the zero pose lie along one axis, as programs have it whose bones have axes of their
// own.
TestBvh WithBonesAlong(const Vector3d& axis) {
  TestBvh bvh(TestSkeleton());
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    const Vector3d along = TestSkeleton().tips[bone] - TestSkeleton().joints[bone];
    bvh.zero_pose[bone] = RotationBetween<double>(axis, along);
  }
  return bvh;
}

TEST(MocapZeroPose, BonesAlongOneAxisTakeTheStandingFrameAsRestPose) {
  for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 0, 1), Vector3d(0, -1, 0)}) {
    const auto motion = FromBvh(WithBonesAlong(axis).Text(WriggleAfterTPose()));
    EXPECT_LT(Difference(*motion, *PlainWriggle()), kSame) << axis.transpose();
    EXPECT_THAT(motion->warnings(), testing::Contains(AllOf(HasSubstr("no upright figure"),
                                                            HasSubstr("frame 1 of 41"))));
  }
}

TEST(MocapZeroPose, AnyTurnsOfItsBonesDoNotMatter) {
  RandomStream random(7, "zero pose");
  TestBvh bvh(TestSkeleton());
  for (Matrix3d& turn : bvh.zero_pose) {
    turn = ExpSo3<double>(
        Vector3d(random.Uniform(-3, 3), random.Uniform(-3, 3), random.Uniform(-3, 3)));
  }
  EXPECT_LT(Difference(*FromBvh(bvh.Text(WriggleAfterTPose())), *PlainWriggle()), kSame);
}

// A figure that lies along z, or hangs head down, until a rotation of the root raises it.
TEST(MocapZeroPose, FigureThatTheRootRaisesStands) {
  for (const Matrix3d& raise :
       {Turn(-90, Vector3d::UnitX()), Turn(180, Vector3d::UnitZ()), Turn(90, Vector3d::UnitZ())}) {
    TestBvh bvh(TestSkeleton());
    bvh.zero_pose.fill(raise);
    const auto motion = FromBvh(bvh.Text(WriggleAfterTPose()));
    EXPECT_LT(Difference(*motion, *PlainWriggle()), kSame);
    EXPECT_THAT(motion->warnings(), Each(Not(HasSubstr("up"))));
  }
}

TEST(MocapZeroPose, FigureThatFacesBetweenTwoAxesIsTurnedExactly) {
  TestBvh bvh(TestSkeleton());
  bvh.zero_pose.fill(Turn(40, Vector3d::UnitY()));
  const auto motion = FromBvh(bvh.Text({TestFrame{}}));
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    EXPECT_LT((motion->At(0).pose.local_rotations[bone] - Matrix3d::Identity()).norm(), kSame);
  }
}

TEST(MocapZeroPose, IsRefusedWhereNoFrameShowsAStandingFigure) {
  std::vector<TestFrame> sitting(5);
  for (TestFrame& frame : sitting) {
    frame.angles_deg = {{"LeftUpLeg", {-90, 0, 0}}, {"RightUpLeg", {-90, 0, 0}}};
  }
  EXPECT_THAT(
      RefusalOfBvh(WithBonesAlong(Vector3d::UnitX()).Text(sitting)),
      AllOf(HasSubstr("clip.bvh: "), HasSubstr("no upright figure"),
            HasSubstr("in the frames the head is above the feet along no axis in any frame")));
  // The rest pose of a file that stands upright is enough.
  EXPECT_EQ(RefusalOfBvh(TestBvh(TestSkeleton()).Text(sitting)), "accepted");
}

std::vector<TestFrame> Lying(double height) {
  std::vector<TestFrame> frames(5);
  for (TestFrame& frame : frames) {
    frame.angles_deg["Hips"] = {-90, 0, 0};
    frame.root.y() = height - TestSkeleton().joints[0].y();
  }
  return frames;
}

TEST(MocapZeroPose, PerformerWhoLiesOnTheFloorIsToldAndLeftLying) {
  const auto motion = FromBvh(TestBvh(TestSkeleton()).Text(Lying(0.1)));
  EXPECT_THAT(motion->warnings(),
              ElementsAre(AllOf(HasSubstr("+y is taken to be up"), HasSubstr("-z in 100 %"))));
  const PosedBones bones(*motion, 0.0);
  EXPECT_NEAR(bones.Joint(kHead).y(), bones.Joint(kLeftFoot).y(), 0.1);
}

TEST(MocapZeroPose, RestPoseAgainstFramesIsRefusedUnlessTheUserSaysWhatIsUp) {
  const std::string text = TestBvh(TestSkeleton()).Text(Lying(3.0));
  EXPECT_THAT(RefusalOfBvh(text),
              AllOf(HasSubstr("clip.bvh: cannot tell which way is up"), HasSubstr("up_axis")));
  MocapSettings settings;
  settings.up_axis = UpAxis::kMinusZ;
  const auto standing = FromBvh(text, TestSkeleton(), settings);
  EXPECT_LT((standing->At(0).pose.local_rotations[0] - Matrix3d::Identity()).norm(), kSame);
  settings.up_axis = UpAxis::kPlusY;
  const PosedBones lying(*FromBvh(text, TestSkeleton(), settings), 0.0);
  EXPECT_NEAR(lying.Joint(kHead).y(), lying.Joint(kLeftFoot).y(), 0.1);
}

// --- Translations

TEST(MocapTranslation, HipsBelowAFixedRootCarryTheBody) {
  TestBvh bvh(TestSkeleton());
  bvh.above = "Reference";
  EXPECT_LT(Difference(*FromBvh(bvh.Text(WriggleAfterTPose())), *PlainWriggle()), kSame);
  bvh.places_are_added = true;
  EXPECT_LT(Difference(*FromBvh(bvh.Text(WriggleAfterTPose())), *PlainWriggle()), kSame);
}

TEST(MocapTranslation, LimbsPointFromJointToJoint) {
  // The left forearm has position channels, which move the wrist 30° downwards.
  std::string text = TestBvh(TestSkeleton()).Text({TestFrame{}, TestFrame{}});
  const Vector3d forearm =
      TestSkeleton().joints[Index(kLeftHand)] - TestSkeleton().joints[Index(kLeftForearm)];
  const std::size_t hand = text.find("LeftHand");
  const std::string channels = "CHANNELS 3";
  text.replace(text.find(channels, hand), channels.size(),
               "CHANNELS 6 Xposition Yposition Zposition");
  const Vector3d moved = Turn(-30, Vector3d::UnitZ()) * forearm;
  // The hand's numbers come after those of the root and of seven joints.
  std::size_t line = text.find("Frame Time");
  for (int frame = 0; frame < 2; ++frame) {
    line = text.find('\n', line) + 1;
    std::size_t word = line;
    for (int i = 0; i < 6 + 3 * 6; ++i) word = text.find(' ', word) + 1;
    text.insert(word, fmt::format("{} {} {} ", moved.x(), moved.y(), moved.z()));
  }
  const auto motion = FromBvh(text);
  const PosedBones bones(*motion, 0.0);
  const Vector3d along = bones.Joint(kLeftHand) - bones.Joint(kLeftForearm);
  EXPECT_LT((along.normalized() - moved.normalized()).norm(), 1e-5);
  EXPECT_THAT(motion->warnings(), IsEmpty());
}

TEST(MocapTranslation, BoneOfAnAsfMovesInItsOwnAxes) {
  std::string asf = kTestAsf;
  const std::string femur = "name lfemur";
  asf = asf.substr(0, asf.find(femur)) +
        Replaced(asf.substr(asf.find(femur)), "dof rx ry rz", "dof tx ty tz rx ry rz");
  const TemporaryFolder folder;
  std::ofstream(folder / "a.asf") << asf;
  std::ofstream(folder / "a.amc") << Amc(AmcFrame(1, {{"lfemur", "1 0 0 0 0 0"}}));
  const MocapClip clip = ReadAsfAmc(folder / "a.amc", folder / "a.asf");
  const MocapPose pose = PoseOf(clip, clip.frames[0]);
  // Its axes are turned by 20° about z.
  const Vector3d expected =
      Vector3d(1.6, 17 - 1.2, 0) +
      Vector3d(std::cos(20 * kRadiansPerDegree), std::sin(20 * kRadiansPerDegree), 0);
  for (std::size_t i = 0; i < clip.joints.size(); ++i) {
    if (clip.joints[i].name != "lfemur") continue;
    EXPECT_LT((pose.positions[i] - expected).norm(), 1e-9);
  }
}

// --- Rigs

struct Rig {
  const char* name;
  std::array<std::string, kBoneCount> joints;
  std::array<std::string, 4> beyond;  // in the left and right hand and foot
};

const std::vector<Rig>& RigsWithHandsAndToes() {
  static const std::vector<Rig> kRigs{
      {"SMPL, Kinect, Xsens BVH",
       {"Pelvis", "Spine1", "Spine3", "Neck", "Head", "L_Shoulder", "L_Elbow", "L_Wrist",
        "R_Shoulder", "R_Elbow", "R_Wrist", "L_Hip", "L_Knee", "L_Ankle", "R_Hip", "R_Knee",
        "R_Ankle"},
       {"L_Hand", "R_Hand", "L_Foot", "R_Foot"}},
      {"SMPL, Kinect, Xsens BVH",
       {"m_avg_Pelvis", "m_avg_Spine1", "m_avg_Spine3", "m_avg_Neck", "m_avg_Head",
        "m_avg_L_Shoulder", "m_avg_L_Elbow", "m_avg_L_Wrist", "m_avg_R_Shoulder", "m_avg_R_Elbow",
        "m_avg_R_Wrist", "m_avg_L_Hip", "m_avg_L_Knee", "m_avg_L_Ankle", "m_avg_R_Hip",
        "m_avg_R_Knee", "m_avg_R_Ankle"},
       {"m_avg_L_Hand", "m_avg_R_Hand", "m_avg_L_Foot", "m_avg_R_Foot"}},
      {"SMPL, Kinect, Xsens BVH",
       {"SpineBase", "SpineMid", "SpineShoulder", "Neck", "Head", "ShoulderLeft", "ElbowLeft",
        "WristLeft", "ShoulderRight", "ElbowRight", "WristRight", "HipLeft", "KneeLeft",
        "AnkleLeft", "HipRight", "KneeRight", "AnkleRight"},
       {"HandLeft", "HandRight", "FootLeft", "FootRight"}},
      {"Mixamo, MotionBuilder, LAFAN",
       {"Model:Hips", "Model:Spine", "Model:Spine1", "Model:Neck", "Model:Head", "Model:LeftArm",
        "Model:LeftForeArm", "Model:LeftHand", "Model:RightArm", "Model:RightForeArm",
        "Model:RightHand", "Model:LeftUpLeg", "Model:LeftLeg", "Model:LeftFoot", "Model:RightUpLeg",
        "Model:RightLeg", "Model:RightFoot"},
       {"Model:LeftHandMiddle1", "Model:RightHandMiddle1", "Model:LeftToeBase",
        "Model:RightToeBase"}},
      {"3ds Max Biped",
       {"Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine1", "Bip01 Neck", "Bip01 Head",
        "Bip01 L UpperArm", "Bip01 L Forearm", "Bip01 L Hand", "Bip01 R UpperArm",
        "Bip01 R Forearm", "Bip01 R Hand", "Bip01 L Thigh", "Bip01 L Calf", "Bip01 L Foot",
        "Bip01 R Thigh", "Bip01 R Calf", "Bip01 R Foot"},
       {"Bip01 L Finger0", "Bip01 R Finger0", "Bip01 L Toe0", "Bip01 R Toe0"}},
      {"Xsens MVN",
       {"Pelvis", "L5", "T8", "Neck", "Head", "LeftUpperArm", "LeftForeArm", "LeftHand",
        "RightUpperArm", "RightForeArm", "RightHand", "LeftUpperLeg", "LeftLowerLeg", "LeftFoot",
        "RightUpperLeg", "RightLowerLeg", "RightFoot"},
       {"LeftHandEnd", "RightHandEnd", "LeftToe", "RightToe"}},
      {"3ds Max Biped",
       {"root", "spine", "chest", "neck", "head", "upperarm_l_jnt", "forearm_l_jnt", "wrist_l_jnt",
        "upperarm_r_jnt", "forearm_r_jnt", "wrist_r_jnt", "thigh_l_jnt", "calf_l_jnt",
        "ankle_l_jnt", "thigh_r_jnt", "calf_r_jnt", "ankle_r_jnt"},
       {"hand_l_jnt", "hand_r_jnt", "foot_l_jnt", "foot_r_jnt"}}};
  return kRigs;
}

TestBvh OfRig(const Rig& rig) {
  TestBvh bvh(TestSkeleton());
  bvh.names = rig.joints;
  bvh.beyond[Index(kLeftHand)] = rig.beyond[0];
  bvh.beyond[Index(kRightHand)] = rig.beyond[1];
  bvh.beyond[Index(kLeftFoot)] = rig.beyond[2];
  bvh.beyond[Index(kRightFoot)] = rig.beyond[3];
  return bvh;
}

TEST(MocapRig, HandsAndToesAreNotTakenForWristsAndAnkles) {
  for (const Rig& rig : RigsWithHandsAndToes()) {
    SCOPED_TRACE(rig.joints[7]);
    Rig used = rig;
    if (used.joints[0] == "root") {  // a word at the end of all names does not count
      for (std::size_t bone = 0; bone < 5; ++bone) used.joints[bone] += "_jnt";
    }
    const std::string text = OfRig(used).Text(Renamed(WriggleAfterTPose(), used.joints));
    const TemporaryFolder folder;
    std::ofstream(folder / "clip.bvh") << text;
    EXPECT_EQ(FindMocapJoints(ReadBvh(folder / "clip.bvh")).rig, rig.name);
    const auto motion = FromBvh(text);
    EXPECT_LT(Difference(*motion, *PlainWriggle()), kSame);
    EXPECT_THAT(motion->warnings(), IsEmpty());
  }
}

TEST(MocapRig, BothSidesMustHaveNamesOfOneKind) {
  Rig rig = RigsWithHandsAndToes()[0];
  rig.joints[Index(kLeftHand)] = "L_Palm";
  EXPECT_THAT(RefusalOfBvh(OfRig(rig).Text({TestFrame{}})),
              AllOf(HasSubstr("clip.bvh: cannot tell which joint is the"), HasSubstr("left wrist"),
                    HasSubstr("L_Palm")));
}

TEST(MocapRig, TwoJointsOfOneNameAreRefused) {
  TestBvh bvh(TestSkeleton());
  bvh.beyond[Index(kLeftHand)] = "left_hand";
  EXPECT_THAT(RefusalOfBvh(bvh.Text({TestFrame{}})),
              AllOf(HasSubstr("two joints have one name, LeftHand and left_hand")));
}

TEST(MocapRig, UserSaysWhichJointIsWhich) {
  TestBvh bvh(TestSkeleton());
  std::array<std::string, kBoneCount> names = bvh.names;
  names[Index(kLeftHand)] = "Flosse links";
  names[Index(kRightHand)] = "Flosse rechts";
  bvh.names = names;
  const std::string text = bvh.Text(Renamed(WriggleAfterTPose(), names));
  EXPECT_THAT(RefusalOfBvh(text), HasSubstr("left wrist, right wrist"));
  MocapSettings settings;
  settings.joints = {{"Flosse links", "left_wrist"}, {"Flosse rechts", "right_wrist"}};
  EXPECT_LT(Difference(*FromBvh(text, TestSkeleton(), settings), *PlainWriggle()), kSame);
  settings.joints[1].file = "Flosse recht";
  EXPECT_THAT(RefusalOfBvh(text, settings), AllOf(HasSubstr("there is no joint Flosse recht"),
                                                  HasSubstr("is Flosse rechts meant")));
}

TEST(MocapRig, SettingsOfJointsAreChecked) {
  EXPECT_THAT((MocapJointName{"a", "left_paw"}).Problem(),
              AllOf(HasSubstr("left_paw"), HasSubstr("left_wrist")));
  MocapSettings settings;
  settings.joints = {{"a", "left_wrist"}, {"b", "left_wrist"}};
  EXPECT_THAT(settings.Problem(), HasSubstr("left_wrist is named twice"));
}

// --- Text

TEST(MocapText, HashStartsACommentAtAWordsBeginningOnly) {
  const std::string good = TestBvh(TestSkeleton()).Text(WriggleAfterTPose());
  const std::string commented = ReplacedAll(good, "{\n", "{ # opens\n# a whole line\n");
  EXPECT_EQ(Difference(*FromBvh(commented), *PlainWriggle()), 0.0);
  const std::string without_last = good.substr(0, good.rfind(' ') + 1);
  const auto lines = 1 + std::count(good.begin(), good.end() - 1, '\n');
  EXPECT_THAT(
      RefusalOfBvh(without_last + "-1.#IND\n"),
      AllOf(HasSubstr(fmt::format("clip.bvh:{}: MOTION: expected a number, got -1.#IND", lines)),
            HasSubstr("not numbers")));
  EXPECT_THAT(RefusalOfBvh(Replaced(good, "Frame Time: 0.01\n", "Frame Time: 0.01\n1.#QNAN ")),
              HasSubstr("expected a number, got 1.#QNAN"));
  EXPECT_THAT(RefusalOfBvh(Replaced(good, "OFFSET 0.0", "OFFSET 0,0")),
              HasSubstr("(a decimal comma?)"));
}

TEST(MocapText, Utf8MarksAndAllLineEndsAreRead) {
  const std::string mark = "\xEF\xBB\xBF";
  const std::string bvh = TestBvh(TestSkeleton()).Text(WriggleAfterTPose());
  EXPECT_EQ(Difference(*FromBvh(mark + bvh), *PlainWriggle()), 0.0);
  for (const char* line_end : {"\r\n", "\r"}) {
    EXPECT_EQ(Difference(*FromBvh(ReplacedAll(bvh, "\n", line_end)), *PlainWriggle()), 0.0);
  }
  const std::string asf =
      ReplacedAll(ReplacedAll(std::string(kTestAsf).substr(12), "angle deg", "angle rad"),
                  " 20 XYZ", " 0.349065850398866 XYZ");
  const std::string amc = ":FULLY-SPECIFIED\n" + AmcFrame(1, {{"head", "0.3 0 0"}}) +
                          AmcFrame(2, {{"lfemur", "0.5 0 0.2"}});
  EXPECT_EQ(Difference(*FromAmc(mark + amc, mark + asf), *FromAmc(amc, asf)), 0.0);
}

TEST(MocapText, OtherEncodingsAreRefused) {
  EXPECT_THAT(RefusalOfBvh(std::string("\xFF\xFEH\0", 4)),
              HasSubstr("clip.bvh:1: the text is UTF-16"));
  EXPECT_THAT(RefusalOfBvh(std::string("HIERARCHY\nRO\0T", 14)),
              HasSubstr("clip.bvh:2: a zero byte"));
}

TEST(MocapText, KeywordsMayBeInAnyCase) {
  std::string text = TestBvh(TestSkeleton()).Text(WriggleAfterTPose());
  for (const auto& [word, other] : {std::pair{"HIERARCHY", "Hierarchy"},
                                    {"OFFSET", "Offset"},
                                    {"CHANNELS", "channels"},
                                    {"Zrotation", "zRotation"},
                                    {"End Site", "End site"},
                                    {"Frame Time:", "FRAME TIME:"}}) {
    text = ReplacedAll(text, word, other);
  }
  EXPECT_EQ(Difference(*FromBvh(text), *PlainWriggle()), 0.0);
}

TEST(MocapText, MissingAndRepeatedPartsOfAJointAreRefused) {
  const std::string good = TestBvh(TestSkeleton()).Text({TestFrame{}, TestFrame{}});
  const std::size_t offset = good.find("OFFSET");
  const std::string line = good.substr(offset, good.find('\n', offset) + 1 - offset);
  EXPECT_THAT(RefusalOfBvh(Replaced(good, line, "")),
              HasSubstr("clip.bvh:2: joint Hips has no OFFSET"));
  EXPECT_THAT(RefusalOfBvh(Replaced(good, line, line + line)),
              HasSubstr("clip.bvh:5: joint Hips has a second OFFSET"));
  EXPECT_THAT(RefusalOfBvh(Replaced(good, "Yposition", "Xposition")),
              HasSubstr("clip.bvh:5: joint Hips has the channel Xposition twice"));
  EXPECT_THAT(RefusalOfBvh(Replaced(good, "MOTION", "ROOT Other")), HasSubstr("a second ROOT"));
}

TEST(MocapText, NumbersOfAFrameEndWithALine) {
  const std::string good = TestBvh(TestSkeleton()).Text({TestFrame{}, TestFrame{}, TestFrame{}});
  const auto first_frame = 1 + std::count(good.begin(), good.end(), '\n') - 3;
  const std::string one_less = Replaced(good, "Frame Time: 0.01\n0.0", "Frame Time: 0.01\n 0.0");
  ASSERT_EQ(RefusalOfBvh(one_less), "accepted");
  std::string shifted = good;
  shifted.erase(shifted.rfind(' '), good.size() - 1 - shifted.rfind(' '));  // in the last frame
  shifted.insert(good.find("Frame Time: 0.01\n") + 17, "0 ");               // in the first
  EXPECT_THAT(RefusalOfBvh(shifted),
              HasSubstr(fmt::format("clip.bvh:{}: frame 1 of 3 ends in the middle", first_frame)));
}

// --- Rates

TEST(MocapRate, FrameTimesThatNoSystemHasAreRefusedWithTheirCause) {
  const std::string good = TestBvh(TestSkeleton()).Text({TestFrame{}, TestFrame{}});
  const auto refusal = [&](const std::string& time) {
    return RefusalOfBvh(Replaced(good, "Frame Time: 0.01", "Frame Time: " + time));
  };
  const auto line = std::to_string(std::count(good.begin(), good.end(), '\n') - 2);
  EXPECT_THAT(refusal("33.333"), AllOf(HasSubstr("clip.bvh:" + line + ": Frame Time: expected"),
                                       HasSubstr("milliseconds? 33.333 ms is 30 frames/s")));
  EXPECT_THAT(refusal("120"),
              HasSubstr("frames per second? 120 frames/s is a frame time of 0.0083"));
  EXPECT_THAT(refusal("16666.7"), HasSubstr("microseconds?"));
  EXPECT_THAT(refusal("1.5"), HasSubstr("milliseconds? 1.5 ms is 666.7 frames/s"));
  EXPECT_THAT(refusal("0.000001"), HasSubstr("1e+06 frames/s, which no capture system has"));
  EXPECT_THAT(refusal("0"), HasSubstr("the rate was not known"));
  EXPECT_THAT(refusal("-0.01"), HasSubstr("expected above 0"));
  EXPECT_EQ(refusal("0.008333"), "accepted");
  EXPECT_THAT(FromBvh(Replaced(good, "Frame Time: 0.01", "Frame Time: 0.5"))->warnings(),
              ElementsAre(HasSubstr("0.5 s is 2 frames/s")));
}

TEST(MocapRate, OfAnAmcIsASetting) {
  std::string frames;
  for (int i = 1; i <= 61; ++i) frames += AmcFrame(i, {});
  AmcSettings settings;
  settings.fps = 60.0;
  EXPECT_DOUBLE_EQ(FromAmc(Amc(frames), kTestAsf, TestSkeleton(), settings)->duration_s(), 1.0);
  const std::string says = ":FULLY-SPECIFIED\n:DEGREES\n:SAMPLES-PER-SECOND 60\n" + frames;
  EXPECT_DOUBLE_EQ(FromAmc(says, kTestAsf, TestSkeleton(), settings)->duration_s(), 1.0);
  EXPECT_THAT(RefusalOf([&] { FromAmc(says); }),
              HasSubstr("clip.amc:3: the file has 60 frames/s, but the motion's amc_fps is 120"));
}

// --- ASF and AMC

TEST(MocapAcclaim, HeaderWordsMayBeInAnyCase) {
  const std::string frames =
      AmcFrame(1, {{"head", "0.3 0 0"}}) + AmcFrame(2, {{"lfemur", "0.5 0 0.2"}});
  const auto radians = FromAmc(":FULLY-SPECIFIED\n:RADIANS\n" + frames);
  EXPECT_EQ(Difference(*radians, *FromAmc(":Fully-Specified\n:radians\n" + frames)), 0.0);
  EXPECT_GT(Difference(*radians, *FromAmc(":FULLY-SPECIFIED\n:DEGREES\n" + frames)), 0.1);
  std::string asf = kTestAsf;
  for (const char* word : {":units", ":root", ":bonedata", ":hierarchy", "direction", "dof"}) {
    std::string upper = word;
    for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    asf = ReplacedAll(asf, word, upper);
  }
  EXPECT_EQ(Difference(*radians, *FromAmc(":radians\n" + frames, asf)), 0.0);
}

TEST(MocapAcclaim, UnknownWordsAreRefusedWithTheNearest) {
  const std::string frame = AmcFrame(1, {});
  EXPECT_THAT(
      RefusalOf([&] { FromAmc(":FULLY-SPECIFIED\n:RADIAN\n" + frame); }),
      AllOf(HasSubstr("clip.amc:2: unknown header word :RADIAN"), HasSubstr("is :radians meant?")));
  const auto asf_refusal = [&](const std::string& before, const std::string& after) {
    return RefusalOf([&] { FromAmc(Amc(frame), Replaced(kTestAsf, before, after)); });
  };
  EXPECT_THAT(asf_refusal(":units", ":unit"),
              AllOf(HasSubstr("clip.asf:4: unknown key of the file :unit (is :units meant?)")));
  EXPECT_THAT(asf_refusal("axis 0 0 20", "axes 0 0 20"),
              HasSubstr("clip.asf:28: unknown key of a bone axes (is axis meant?)"));
  EXPECT_THAT(asf_refusal("    axis 0 0 20 XYZ\n", ""),
              HasSubstr("clip.asf:24: bone lfemur has no axis"));
  EXPECT_THAT(asf_refusal("length 8\n", "length 8\n    length 9\n"),
              HasSubstr("clip.asf:28: a bone has a second length"));
}

TEST(MocapAcclaim, UnitsInDoubtAreTold) {
  const std::string frames = AmcFrame(1, {}) + AmcFrame(2, {{"head", "0.3 1.2 0"}});
  EXPECT_THAT(FromAmc(Amc(frames))->warnings(),
              ElementsAre(AllOf(HasSubstr("clip.amc:1: no angle is larger than 1.20 degrees"),
                                HasSubstr("radians"))));
  EXPECT_THAT(FromAmc(":RADIANS\n" + AmcFrame(1, {{"head", "0 40 0"}}))->warnings(),
              ElementsAre(HasSubstr("the largest angle is 40 radians: are they degrees?")));
  EXPECT_THAT(
      FromAmc(Amc(AmcFrame(1, {{"head", "0 40 0"}})), Replaced(kTestAsf, "  angle deg\n", ""))
          ->warnings(),
      ElementsAre(HasSubstr("degrees are assumed")));
}

TEST(MocapAcclaim, FrameNumbersMustFollowEachOther) {
  const auto frame = [](int number, double angle) {
    return AmcFrame(number, {{"head", fmt::format("0 {} 0", angle)}});
  };
  const std::string gap = Amc(frame(1, 0) + frame(2, 10) + frame(5, 40) + frame(6, 50));
  const int lines_of_frame = 18;
  EXPECT_THAT(
      RefusalOf([&] { FromAmc(gap); }),
      AllOf(HasSubstr(fmt::format("clip.amc:{}: the frame numbers jump from 2 to 5: 2 frames "
                                  "are missing",
                                  4 + 2 * lines_of_frame)),
            HasSubstr("amc_gaps")));
  EXPECT_THAT(RefusalOf([&] { FromAmc(Amc(frame(2, 0) + frame(2, 10))); }),
              HasSubstr("clip.amc:22: frame number 2 after 2; expected 3"));
  AmcSettings fill;
  fill.gaps = FrameGaps::kInterpolate;
  const auto filled = FromAmc(gap, kTestAsf, TestSkeleton(), fill);
  const auto whole = FromAmc(
      Amc(frame(1, 0) + frame(2, 10) + frame(3, 20) + frame(4, 30) + frame(5, 40) + frame(6, 50)));
  EXPECT_LT(Difference(*filled, *whole), 1e-9);
  EXPECT_THAT(filled->warnings(),
              ElementsAre(HasSubstr("2 of 6 frames are interpolated over 1 gaps")));
  EXPECT_THAT(RefusalOf([&] {
                FromAmc(Amc(frame(1, 0) + frame(2000000000, 1)), kTestAsf, TestSkeleton(), fill);
              }),
              HasSubstr("expected at most 1200"));
}

// --- The self-check

TEST(MocapCheck, LimbsOfUnequalSidesAreToldOrRefused) {
  const auto with_left_shin = [](double share) {
    Skeleton uneven = TestSkeleton();
    const Vector3d shin =
        share * (uneven.joints[Index(kLeftFoot)] - uneven.joints[Index(kLeftShin)]);
    const Vector3d moved = uneven.joints[Index(kLeftShin)] + shin - uneven.joints[Index(kLeftFoot)];
    uneven.joints[Index(kLeftFoot)] += moved;
    uneven.tips[Index(kLeftFoot)] += moved;
    return TestBvh(uneven).Text(WriggleAfterTPose());
  };
  EXPECT_THAT(FromBvh(with_left_shin(0.8))->warnings(), ElementsAre(HasSubstr("the left shin is")));
  EXPECT_THAT(RefusalOfBvh(with_left_shin(0.4)), AllOf(HasSubstr("clip.bvh: the left shin is"),
                                                       HasSubstr("expected two equal sides")));
  EXPECT_THAT(RefusalOfBvh(with_left_shin(0.01)), HasSubstr("expected at least 0.1"));
}

TEST(MocapCheck, ExchangedSidesAreTold) {
  TestBvh exchanged(TestSkeleton());
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    exchanged.names[bone] =
        TestBvh(TestSkeleton()).names[static_cast<std::size_t>(Bones()[bone].mirror)];
  }
  std::vector<TestFrame> frames(20);
  for (TestFrame& frame : frames) {
    frame.angles_deg = {{"LeftLeg", {60, 0, 0}}, {"RightLeg", {60, 0, 0}}};
  }
  EXPECT_THAT(FromBvh(exchanged.Text(frames))->warnings(),
              ElementsAre(HasSubstr("40 of 40 bent knees bend to the front")));
  EXPECT_THAT(FromBvh(TestBvh(TestSkeleton()).Text(frames))->warnings(), IsEmpty());
}

TEST(MocapCheck, HeadBelowTheFeetAndJumpsAreTold) {
  std::vector<TestFrame> frames(10);
  for (std::size_t i = 0; i < 6; ++i) frames[i].angles_deg["Hips"] = {180, 0, 0};
  frames[9].root.z() = 0.5;
  EXPECT_THAT(
      FromBvh(TestBvh(TestSkeleton()).Text(frames))->warnings(),
      testing::UnorderedElementsAre(HasSubstr("the head is above the feet in 4 of 10 frames"),
                                    HasSubstr("the hips move faster than 15 m/s")));
}

}  // namespace
}  // namespace vitruvia
