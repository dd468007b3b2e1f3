// Motion capture files that are well formed and say something that cannot be so of a person: sides,
// units, names and places. Each is told with its likely cause, taken right or refused.
#include <numbers>

#include <gmock/gmock.h>

#include "mocap_support.h"

namespace vitruvia {
namespace {

using Vector3d = Vector3<double>;
using enum BoneId;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> WarningsOf(const std::string& text) { return FromBvh(text)->warnings(); }

std::vector<TestFrame> WithRootsTimes(double factor, std::vector<TestFrame> frames) {
  const Vector3d start = TestSkeleton().joints[0];
  for (TestFrame& frame : frames) frame.root = factor * (start + frame.root) - start;
  return frames;
}

// --- Left and right

TestBvh WithSidesExchanged() {
  TestBvh bvh(TestSkeleton());
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    bvh.names[bone] = TestBvh(TestSkeleton()).names[static_cast<std::size_t>(Bones()[bone].mirror)];
  }
  return bvh;
}

Vector3d Mirrored(const Vector3d& v) { return {-v.x(), v.y(), v.z()}; }

TEST(MocapSides, FeetThatPointToTheBackTellOfExchangedNames) {
  const auto told =
      ElementsAre(AllOf(HasSubstr("clip.bvh: both feet point to the back in the rest pose"),
                        HasSubstr("are left and right exchanged, or is the file mirrored?")));
  EXPECT_THAT(WarningsOf(WithSidesExchanged().Text({TestFrame{}, TestFrame{}})), told);
  TestBvh z_up = WithSidesExchanged();
  z_up.to_file = [](const Vector3d& v) { return Vector3d(v.x(), -v.z(), v.y()); };
  EXPECT_THAT(WarningsOf(z_up.Text({TestFrame{}})), told);
}

TEST(MocapSides, MirroredFileIsToldUnlessItsNamesAreMirroredToo) {
  TestBvh mirrored(TestSkeleton());
  mirrored.to_file = Mirrored;
  EXPECT_THAT(WarningsOf(mirrored.Text({TestFrame{}})),
              ElementsAre(HasSubstr("both feet point to the back")));
  TestBvh both = WithSidesExchanged();
  both.to_file = Mirrored;
  EXPECT_THAT(WarningsOf(both.Text({TestFrame{}})), IsEmpty());
}

TEST(MocapSides, KneesAndFeetAreToldTogether) {
  std::vector<TestFrame> frames(5);
  for (TestFrame& frame : frames) {
    frame.angles_deg = {{"LeftLeg", {60, 0, 0}}, {"RightLeg", {60, 0, 0}}};
  }
  EXPECT_THAT(WarningsOf(WithSidesExchanged().Text(frames)),
              ElementsAre(HasSubstr("10 of 10 bent knees bend to the front, and both feet point to "
                                    "the back in the rest pose")));
  EXPECT_THAT(WarningsOf(TestBvh(TestSkeleton()).Text(frames)), IsEmpty());
}

TEST(MocapSides, FeetWithoutToesSayNothing) {
  Skeleton without_toes = TestSkeleton();
  for (const BoneId foot : {kLeftFoot, kRightFoot}) {
    without_toes.tips[Index(foot)] = without_toes.joints[Index(foot)];
  }
  TestBvh exchanged(without_toes);
  exchanged.names = WithSidesExchanged().names;
  EXPECT_THAT(WarningsOf(exchanged.Text({TestFrame{}})), IsEmpty());
}

// --- Units

TEST(MocapUnits, AnglesOfABvhInRadiansAreTold) {
  std::vector<TestFrame> frames = WriggleAfterTPose();
  ASSERT_THAT(WarningsOf(TestBvh(TestSkeleton()).Text(frames)), IsEmpty());
  for (TestFrame& frame : frames) {
    frame.angles_deg = {{"LeftArm", {0, 0, -std::numbers::pi / 2}}, {"LeftLeg", {0.5, 0, 0}}};
  }
  const std::string text = TestBvh(TestSkeleton()).Text(frames);
  const auto line = 2 + std::count(text.begin(), text.begin() + text.find("Frame Time"), '\n');
  EXPECT_THAT(WarningsOf(text), ElementsAre(HasSubstr(fmt::format(
                                    "clip.bvh:{}: no angle is larger than 1.57 degrees: are they "
                                    "radians?",
                                    line))));
}

TEST(MocapUnits, RootPositionsInAnotherUnitThanTheOffsetsAreTold) {
  const TestBvh bvh(TestSkeleton());
  const std::vector<std::tuple<double, std::string, std::string>> kinds{
      {1.0 / 100.0, "positions in metres and the OFFSETs or lengths in centimetres", "100 times"},
      {1.0 / 10.0, "positions in centimetres and the OFFSETs or lengths in millimetres",
       "10 times"},
      {1.0 / 1000.0, "positions in metres and the OFFSETs or lengths in millimetres", "1000 times"},
      {1.0 / 2.54, "positions in inches and the OFFSETs or lengths in centimetres", "2.54 times"},
      {2.54, "positions in centimetres and the OFFSETs or lengths in inches", "2.54 times"},
      {10.0, "positions in millimetres and the OFFSETs or lengths in centimetres", "10 times"}};
  for (const auto& [factor, units, times] : kinds) {
    // Slow enough for a person in either unit.
    std::vector<TestFrame> frames = Wriggle();
    for (TestFrame& frame : frames) frame.root *= 0.1;
    EXPECT_THAT(WarningsOf(bvh.Text(WithRootsTimes(factor, frames))),
                ElementsAre(AllOf(HasSubstr("clip.bvh: the root is"), HasSubstr(units),
                                  HasSubstr("The path is then " + times +
                                            (factor < 1.0 ? " too short" : " too long")))))
        << factor;
  }
}

// Many files have the floor elsewhere than at 0, or the hips at 0 in the first frame.
TEST(MocapUnits, AnotherFloorThanAtZeroIsNoOtherUnit) {
  for (const double height : {-0.95, -0.3, 0.3, 0.6}) {
    std::vector<TestFrame> frames = Wriggle();
    for (TestFrame& frame : frames) frame.root.y() += height;
    EXPECT_THAT(WarningsOf(TestBvh(TestSkeleton()).Text(frames)), IsEmpty()) << height;
  }
}

// --- Places

TEST(MocapPlaces, RootThatStaysWhileTheStandingFootMovesIsTold) {
  std::vector<TestFrame> frames(21);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double swing = 30.0 * std::sin(0.3 * static_cast<double>(i));
    frames[i].angles_deg = {{"LeftUpLeg", {swing, 0, 0}}, {"RightUpLeg", {-swing, 0, 0}}};
  }
  EXPECT_THAT(WarningsOf(TestBvh(TestSkeleton()).Text(frames)),
              ElementsAre(AllOf(HasSubstr("clip.bvh: the root stays at one place in all 21 frames"),
                                HasSubstr("lost, or taken out"))));
  // As it should be: somebody who moves the arms and one leg.
  for (TestFrame& frame : frames) {
    frame.angles_deg["LeftArm"] = {0, 0, -frame.angles_deg["LeftUpLeg"].x()};
    frame.angles_deg["LeftUpLeg"].x() = -50.0;
    frame.angles_deg["RightUpLeg"].x() = 0.0;
  }
  EXPECT_THAT(WarningsOf(TestBvh(TestSkeleton()).Text(frames)), IsEmpty());
}

TEST(MocapPlaces, HipsThatGoWhereNobodyGetsAreRefused) {
  std::vector<TestFrame> frames(4);
  frames[1].root.x() = 1e6;
  EXPECT_THAT(RefusalOfBvh(TestBvh(TestSkeleton()).Text(frames)),
              AllOf(HasSubstr("clip.bvh: in frame 2 of 4 the hips are 1e+06 m away"),
                    HasSubstr("expected at most 1000 m"), HasSubstr("damaged")));
  // 2 m in a hundredth of a second: in one of three pairs of frames, and in two.
  frames[1].root.x() = 0.0;
  frames[3].root.x() = 2.0;
  EXPECT_THAT(WarningsOf(TestBvh(TestSkeleton()).Text(frames)),
              ElementsAre(HasSubstr("the hips move faster than 15 m/s 1 times, 200 m/s after frame "
                                    "3 of 4")));
  frames[2].root.x() = -2.0;
  EXPECT_THAT(RefusalOfBvh(TestBvh(TestSkeleton()).Text(frames)),
              AllOf(HasSubstr("clip.bvh: the hips move faster than 100 m/s between 2 of 3 pairs"),
                    HasSubstr("expected a person")));
}

TEST(MocapPlaces, RefusedPathSaysTheUnitThatExplainsIt) {
  std::vector<TestFrame> frames = Wriggle();
  frames.resize(20);  // 0.6 m
  EXPECT_THAT(RefusalOfBvh(TestBvh(TestSkeleton()).Text(WithRootsTimes(1000.0, frames))),
              AllOf(HasSubstr("faster than 100 m/s"), HasSubstr("positions in millimetres"),
                    HasSubstr("in metres")));
}

// --- Names

constexpr std::array<BoneId, 4> kLimbBegins{kLeftUpperArm, kRightUpperArm, kLeftThigh, kRightThigh};

// A collar bone that is called shoulder, and a bone of the pelvis that is called hip.
TestBvh WithCollarBones(const std::array<std::string, 4>& begins) {
  TestBvh bvh(TestSkeleton());
  const std::array<std::string, 4> before{"LeftShoulder", "RightShoulder", "LeftHip", "RightHip"};
  for (std::size_t i = 0; i < kLimbBegins.size(); ++i) {
    bvh.before[Index(kLimbBegins[i])] = before[i];
    bvh.names[Index(kLimbBegins[i])] = begins[i];
  }
  for (const auto& [bone, name] : {std::pair{kLeftForearm, "Elbow"},
                                   {kLeftHand, "Wrist"},
                                   {kLeftShin, "Knee"},
                                   {kLeftFoot, "Ankle"}}) {
    bvh.names[Index(bone)] = std::string("Left") + name;
    bvh.names[static_cast<std::size_t>(Bones()[Index(bone)].mirror)] = std::string("Right") + name;
  }
  return bvh;
}

TEST(MocapNames, JointBelowACollarBoneThatIsCalledShoulderBeginsTheArm) {
  const auto plain = FromBvh(TestBvh(TestSkeleton()).Text(WriggleAfterTPose()));
  for (const auto& [arm, thigh] : {std::pair{"Arm", "UpLeg"},
                                   {"UpperArm", "UpperLeg"},
                                   {"UpArm", "Thigh"},
                                   {"Humerus", "Femur"}}) {
    SCOPED_TRACE(arm);
    const TestBvh bvh =
        WithCollarBones({std::string("Left") + arm, std::string("Right") + arm,
                         std::string("Left") + thigh, std::string("Right") + thigh});
    const auto motion = FromBvh(bvh.Text(Renamed(WriggleAfterTPose(), bvh.names)));
    EXPECT_LT(Difference(*motion, *plain), kSame);
    EXPECT_THAT(motion->warnings(), IsEmpty());
  }
}

TEST(MocapNames, JointBelowACollarBoneThatMayBeAnotherIsRefusedWithBothNames) {
  const TestBvh one_side = WithCollarBones({"LeftArm", "RightBiceps", "LeftUpLeg", "RightUpLeg"});
  EXPECT_THAT(RefusalOfBvh(one_side.Text({TestFrame{}})),
              AllOf(HasSubstr("clip.bvh: cannot tell whether LeftShoulder or LeftArm"),
                    HasSubstr(R"({"file": "LeftArm", "ours": "left_shoulder"})")));
  const TestBvh leg = WithCollarBones({"LeftArm", "RightArm", "LeftLeg", "RightLeg"});
  const std::string text = leg.Text(Renamed(WriggleAfterTPose(), leg.names));
  EXPECT_THAT(RefusalOfBvh(text), HasSubstr("cannot tell whether LeftHip or LeftLeg"));
  MocapSettings settings;
  settings.joints = {{"LeftLeg", "left_hip"}, {"RightLeg", "right_hip"}};
  EXPECT_LT(Difference(*FromBvh(text, TestSkeleton(), settings),
                       *FromBvh(TestBvh(TestSkeleton()).Text(WriggleAfterTPose()))),
            kSame);
}

TEST(MocapNames, TwoJointsOfOneNameAreRefusedWithTheirPlacesAndARemedy) {
  TestBvh bvh(TestSkeleton());
  bvh.beyond[Index(kRightFoot)] = "LeftHand";
  const auto told =
      AllOf(HasSubstr("clip.bvh: two joints have one name, LeftHand and LeftHand (the first below "
                      "LeftForeArm, the second below RightFoot)"),
            HasSubstr("left_wrist"), HasSubstr("rename one of them in the file"));
  EXPECT_THAT(RefusalOfBvh(bvh.Text({TestFrame{}})), told);
  MocapSettings settings;
  settings.joints = {{"LeftHand", "left_wrist"}};
  EXPECT_THAT(RefusalOfBvh(bvh.Text({TestFrame{}}), settings), told);
}

TEST(MocapNames, TwoJointsWhoseNamesDifferInLettersAreToldApartByTheUser) {
  TestBvh bvh(TestSkeleton());
  bvh.beyond[Index(kRightFoot)] = "left_hand";
  EXPECT_THAT(RefusalOfBvh(bvh.Text({TestFrame{}})),
              AllOf(HasSubstr(R"(add {"file": "LeftHand", "ours": "left_wrist"})"),
                    Not(HasSubstr("rename"))));
  MocapSettings settings;
  settings.joints = {{"LeftHand", "left_wrist"}};
  EXPECT_EQ(RefusalOfBvh(bvh.Text({TestFrame{}}), settings), "accepted");
}

}  // namespace
}  // namespace vitruvia
