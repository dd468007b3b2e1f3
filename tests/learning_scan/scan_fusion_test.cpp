#include "learning/scan/scan_fusion.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "learning_scan/analytic_views.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;

ScanFusionSettings SmallSettings(int threads = 2) {
  ScanFusionSettings settings;
  settings.volume = SmallVolume(0.4, 0.01, 0.03);
  settings.smoothing.sigma_px = 1.0;
  settings.alignment.iterations = {8, 4};
  settings.surface.min_weight = 0.5;
  settings.threads = threads;
  return settings;
}

// Frame `i` of a camera that goes round the cluster in 40 frames, up and down on the way.
Rigidd CameraAt(int i) {
  const double angle = 2.0 * M_PI * i / 40.0;
  return CameraLookingAt(
      {0.8 * std::sin(angle), 0.15 + 0.2 * std::sin(2.0 * angle), 0.8 * std::cos(angle)},
      {0, 0, 0});
}

ScanFusion Scanned(int frames, int threads, std::vector<FusedFrame>& fused) {
  ScanFusion fusion(SmallSettings(threads), SmallCamera(), Inverse(CameraAt(0)));
  for (int i = 0; i < frames; ++i) {
    fused.push_back(fusion.FuseFrame(ViewOf(Cluster(), SmallCamera(), CameraAt(i))));
  }
  return fusion;
}

TEST(ScanFusion, FollowsACameraRoundAnObject) {
  std::vector<FusedFrame> fused;
  ScanFusionSettings settings = SmallSettings();
  settings.loss.max_step_m = 0.3;
  settings.loss.max_step_deg = 20.0;
  ScanFusion fusion(settings, SmallCamera(), Inverse(CameraAt(0)));
  for (int i = 0; i < 40; ++i) {
    const FusedFrame frame = fusion.FuseFrame(ViewOf(Cluster(), SmallCamera(), CameraAt(i)));
    ASSERT_EQ(frame.outcome, FrameOutcome::kFused) << i << ": " << frame.message;
    const Rigidd error = CameraAt(i) * frame.subject_from_camera;
    EXPECT_LT(error.translation.norm(), 0.02) << i;
    EXPECT_LT(LogSo3<double>(error.rotation).norm(), 1.5 * kRadiansPerDegree) << i;
  }
  const ScanSurface surface = fusion.Surface();
  double sum = 0.0;
  for (const Vector3f& p : surface.mesh.vertices) {
    double nearest = 1.0;
    for (const Ball& ball : Cluster()) {
      nearest =
          std::min(nearest, std::abs((p.cast<double>() - ball.center).norm() - ball.radius_m));
    }
    sum += nearest;
  }
  EXPECT_LT(sum / static_cast<double>(surface.mesh.vertices.size()), 0.003);
}

TEST(ScanFusion, SaysThatACameraJumped) {
  ScanFusion fusion(SmallSettings(), SmallCamera(), Inverse(CameraAt(0)));
  EXPECT_EQ(fusion.FuseFrame(ViewOf(Cluster(), SmallCamera(), CameraAt(0))).outcome,
            FrameOutcome::kFused);
  const FusedFrame lost = fusion.FuseFrame(ViewOf(Cluster(), SmallCamera(), CameraAt(12)));
  EXPECT_EQ(lost.outcome, FrameOutcome::kLost);
  EXPECT_THAT(lost.message, HasSubstr("expected at"));
  EXPECT_EQ(lost.subject_from_camera.translation, Inverse(CameraAt(0)).translation);
}

TEST(ScanFusion, SaysThatAViewTellsNothing) {
  // A single ball: turning it about its own middle changes nothing.
  const std::vector<Ball> ball = {{{0, 0, 0}, 0.2}};
  ScanFusion fusion(SmallSettings(), SmallCamera(), Inverse(CameraAt(0)));
  fusion.FuseFrame(ViewOf(ball, SmallCamera(), CameraAt(0)));
  const FusedFrame lost = fusion.FuseFrame(ViewOf(ball, SmallCamera(), CameraAt(0)));
  EXPECT_EQ(lost.outcome, FrameOutcome::kLost);
  EXPECT_THAT(lost.message, HasSubstr("condition number"));
}

TEST(ScanFusion, SaysThatAFrameIsEmpty) {
  ScanFusion fusion(SmallSettings(), SmallCamera(), Rigidd{});
  const FusedFrame empty = fusion.FuseFrame(DepthImage(160, 120));
  EXPECT_EQ(empty.outcome, FrameOutcome::kEmpty);
  EXPECT_EQ(empty.message, "it has no depth");
  EXPECT_TRUE(fusion.Surface().mesh.vertices.empty());
}

TEST(ScanFusion, RefusesFramesOfAnotherSize) {
  ScanFusion fusion(SmallSettings(), SmallCamera(), Rigidd{});
  EXPECT_THROW(fusion.FuseFrame(DepthImage(10, 10)), std::invalid_argument);
}

TEST(ScanFusion, SameForAnyNumberOfThreads) {
  std::vector<FusedFrame> alone, together;
  const ScanSurface one = Scanned(3, 1, alone).Surface();
  const ScanSurface two = Scanned(3, 3, together).Surface();
  EXPECT_EQ(one.mesh.vertices, two.mesh.vertices);
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
  EXPECT_EQ(alone.back().subject_from_camera.translation,
            together.back().subject_from_camera.translation);
  EXPECT_EQ(alone.back().rms_m, together.back().rms_m);
}

}  // namespace
}  // namespace vitruvia
