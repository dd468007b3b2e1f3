// Errors and their circumstances made by hand: what a diagnosis says of them is known.
#include "diagnosis/diagnosis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/zbuffer.h"
#include "support/temporary_folder.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {
using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kFrames = 12;
constexpr int kWrist = static_cast<int>(BoneId::kLeftHand);
constexpr double kRoundOff = 1e-6;  // of positions stored as float

// A figure that stands still in the T-pose, 2.8 m before the camera.
class StillFigure : public testing::Test {
 protected:
  StillFigure() : body_(TinyBody(3)) {
    for (const Vector3d& joint : body_.skeleton.joints)
      joints_.emplace_back(joint.x(), 1.0 - joint.y(), 2.8 - joint.z());
    for (const Vector3f& v : body_.rest.vertices)
      vertices_.emplace_back(v.x(), 1.0f - v.y(), 2.8f - v.z());
    estimates_.assign(kFrames, joints_);
    visible_.assign(kFrames, std::vector<bool>(joints_.size(), true));
    outcomes_.assign(kFrames, Outcome::kConverged);
  }

  // Moves the estimated left wrist away in those frames.
  void MoveWrist(int first, int last, double by_m) {
    for (int i = first; i <= last; ++i) estimates_[i][kWrist].y() += by_m;
  }
  void HideWrist(int first, int last) {
    for (int i = first; i <= last; ++i) visible_[i][kWrist] = false;
  }

  Diagnosis Diagnosed() {
    SequenceInfo info;
    info.camera = {160, 120, 142.5, 142.5, 79.5, 59.5};
    info.frames = kFrames;
    for (const BoneInfo& bone : Bones()) info.joints.emplace_back(bone.joint);
    SequenceWriter sequence(folder_ / "sequence", info, body_, body_.rest);
    EstimateWriter estimate(folder_ / "estimate", body_.rest);
    ZBuffer zbuffer(info.camera);
    for (int i = 0; i < kFrames; ++i) {
      sequence.Append(zbuffer.Render(vertices_, body_.rest.triangles), vertices_,
                      {joints_, visible_[i]});
      TrackResult result;
      result.outcome = outcomes_[i];
      result.vertices = vertices_;
      result.joints = estimates_[i];
      estimate.Append(result, 1.0);
    }
    sequence.Finish();
    estimate.Finish();
    return Diagnose(SequenceReader(folder_ / "sequence"), EstimateReader(folder_ / "estimate"));
  }

  double Share(const Diagnosis& diagnosis, Cause cause) const {
    return diagnosis.shares[static_cast<std::size_t>(cause)];
  }

  TemporaryFolder folder_;
  BodyModel body_;
  std::vector<Vector3d> joints_;
  std::vector<Vector3f> vertices_;
  std::vector<std::vector<Vector3d>> estimates_;
  std::vector<std::vector<bool>> visible_;
  std::vector<Outcome> outcomes_;
};

TEST_F(StillFigure, HiddenJointHoldsAllOfTheError) {
  MoveWrist(4, 6, 0.1);
  HideWrist(4, 6);
  const Diagnosis diagnosis = Diagnosed();
  EXPECT_THAT(Share(diagnosis, Cause::kHidden), DoubleNear(1.0, kRoundOff));
  ASSERT_THAT(diagnosis.events, testing::Not(IsEmpty()));
  const ErrorEvent& event = diagnosis.events.front();
  EXPECT_EQ(event.first, 4);
  EXPECT_EQ(event.last, 6);
  EXPECT_EQ(event.cause, Cause::kHidden);
  EXPECT_THAT(event.share, DoubleNear(1.0, kRoundOff));
  EXPECT_EQ(event.reason, "left wrist: up to 0.10 m");
}

TEST_F(StillFigure, ErrorKeepsTheCauseThatItBeganWith) {
  MoveWrist(4, 9, 0.1);
  HideWrist(4, 6);
  EXPECT_THAT(Share(Diagnosed(), Cause::kHidden), DoubleNear(1.0, kRoundOff));
}

TEST_F(StillFigure, ErrorsAreSharedByTheirSize) {
  MoveWrist(2, 2, 0.3);
  HideWrist(2, 2);
  MoveWrist(8, 8, 0.1);
  const Diagnosis diagnosis = Diagnosed();
  EXPECT_THAT(Share(diagnosis, Cause::kHidden), DoubleNear(0.75, kRoundOff));
  EXPECT_THAT(Share(diagnosis, Cause::kUnknown), DoubleNear(0.25, kRoundOff));
  EXPECT_EQ(diagnosis.Main(), Cause::kHidden);
  ASSERT_GE(diagnosis.events.size(), 2u);
  EXPECT_EQ(diagnosis.events[1].worst, 8);
}

TEST_F(StillFigure, SmallErrorsAreNotExplained) {
  MoveWrist(3, 5, 0.02);
  HideWrist(3, 5);
  const Diagnosis diagnosis = Diagnosed();
  EXPECT_EQ(diagnosis.Main(), Cause::kSmall);
  EXPECT_THAT(Share(diagnosis, Cause::kSmall), DoubleNear(1.0, kRoundOff));
}

TEST_F(StillFigure, BodyThatIsOffFromTheFirstFrameIsAStart) {
  for (int i = 0; i < 5; ++i) {
    for (Vector3d& joint : estimates_[i]) joint.z() += 0.15;
  }
  EXPECT_THAT(Share(Diagnosed(), Cause::kStart), DoubleNear(1.0, kRoundOff));
}

TEST_F(StillFigure, SidesThatAreSwappedAreAFacing) {
  for (int i = 6; i < 9; ++i) {
    for (int bone = 0; bone < kBoneCount; ++bone)
      estimates_[i][bone] = joints_[Bones()[bone].mirror];
  }
  const Diagnosis diagnosis = Diagnosed();
  EXPECT_THAT(Share(diagnosis, Cause::kFacing), DoubleNear(1.0, kRoundOff));
  EXPECT_THAT(diagnosis.lost_frames, ElementsAre(6, 7, 8));
}

TEST_F(StillFigure, ReportedFailuresAreLost) {
  outcomes_[7] = Outcome::kLost;
  EXPECT_THAT(Diagnosed().lost_frames, ElementsAre(7));
}

TEST_F(StillFigure, TruthHasNothingToExplain) {
  const Diagnosis diagnosis = Diagnosed();
  EXPECT_EQ(diagnosis.Main(), Cause::kSmall);
  EXPECT_THAT(diagnosis.lost_frames, IsEmpty());
}

}  // namespace
}  // namespace vitruvia
