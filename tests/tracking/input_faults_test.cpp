// Each fault damages what it says and nothing else.
#include "tracking/input_faults.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "config/json_settings.h"
#include "core/error.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {

constexpr double kUnit_m = 0.001;

// Depths 1, 2, … m; the first two pixels are not measured.
DepthFrame Counting(int index) {
  DepthFrame frame{index, 0.0, DepthImage(5, 4)};
  for (std::size_t i = 2; i < frame.depth.pixels().size(); ++i) {
    frame.depth.pixels()[i] = static_cast<float>(i);
  }
  return frame;
}

DepthFaultSettings Fault(DepthFault kind, int first_frame = 0) {
  DepthFaultSettings settings;
  settings.kind = kind;
  settings.first_frame = first_frame;
  return settings;
}

DepthFrame Damaged(const DepthFaultSettings& settings, int index = 3, int seed = 1) {
  DepthFrame frame = Counting(index);
  DamageFrame(settings, {kUnit_m, seed, {}}, frame);
  return frame;
}

TEST(DepthFaults, FillTheFramesThatTheyAreAboutAndNoOthers) {
  DepthFaultSettings zero = Fault(DepthFault::kZero, 3);
  zero.frames = 2;
  for (const int whole : {0, 2, 5}) {
    EXPECT_EQ(Damaged(zero, whole).depth.pixels(), Counting(whole).depth.pixels()) << whole;
  }
  for (const int damaged : {3, 4}) {
    EXPECT_EQ(Damaged(zero, damaged).depth.pixels(), DepthImage(5, 4).pixels()) << damaged;
  }
}

TEST(DepthFaults, HoldWhatTheyAreNamedAfter) {
  const auto pixel = [](DepthFault kind) { return Damaged(Fault(kind, 3)).depth(4, 3); };
  EXPECT_EQ(pixel(DepthFault::kNone), 19.0f);
  EXPECT_EQ(pixel(DepthFault::kMaximum), 65.535f);
  EXPECT_TRUE(std::isnan(pixel(DepthFault::kNotANumber)));
  EXPECT_EQ(pixel(DepthFault::kInfinite), std::numeric_limits<float>::infinity());
  EXPECT_EQ(pixel(DepthFault::kNegative), -19.0f);
}

TEST(DepthFaults, SpareMeasuredPixelsInTheMiddle) {
  DepthFaultSettings settings = Fault(DepthFault::kZero, 3);
  settings.pixels_spared = 2;
  const DepthFrame frame = Damaged(settings);
  for (int v = 0; v < 4; ++v) {
    for (int u = 0; u < 5; ++u) {
      const bool spared = u == 2 && (v == 1 || v == 2);
      EXPECT_EQ(frame.depth(u, v), spared ? Counting(3).depth(u, v) : 0.0f) << u << " " << v;
    }
  }
}

TEST(DepthFaults, HitTheirShareOfThePixelsTheSameOnesForOneSeed) {
  DepthFrame big{0, 0.0, DepthImage(100, 100, 2.0f)};
  DepthFrame again = big, other = big;
  DepthFaultSettings settings = Fault(DepthFault::kZero);
  settings.share = 0.1;
  DamageFrame(settings, {kUnit_m, 1, {}}, big);
  DamageFrame(settings, {kUnit_m, 1, {}}, again);
  DamageFrame(settings, {kUnit_m, 2, {}}, other);
  const auto lost = std::count(big.depth.pixels().begin(), big.depth.pixels().end(), 0.0f);
  EXPECT_NEAR(static_cast<double>(lost), 1000.0, 100.0);
  EXPECT_EQ(big.depth.pixels(), again.depth.pixels());
  EXPECT_NE(big.depth.pixels(), other.depth.pixels());
}

TEST(DepthFaults, StayInTheirRectangle) {
  DepthFaultSettings settings = Fault(DepthFault::kZero, 3);
  settings.place = FaultPlace::kRegion;
  settings.region_px = {1.0, 2.0, 3.0, 2.0};
  const DepthFrame frame = Damaged(settings);
  for (int v = 0; v < 4; ++v) {
    for (int u = 0; u < 5; ++u) {
      const bool is_in = v == 2 && u >= 1 && u <= 3;
      EXPECT_EQ(frame.depth(u, v), is_in ? 0.0f : Counting(3).depth(u, v)) << u << " " << v;
    }
  }
}

// A wall 2 m away; the bone runs along the image's middle row, a little before the wall.
TEST(DepthFaults, StayNearTheirBone) {
  const PinholeCamera camera{100, 80, 100.0, 100.0, 49.5, 39.5};
  DepthFaultSettings settings = Fault(DepthFault::kZero);
  settings.place = FaultPlace::kBone;
  settings.bone = "left_forearm";
  settings.bone_radius_m = 0.2;
  FaultContext context{kUnit_m, 1, camera};
  const Vector3d from(-0.3, 0.0, 1.9), to(0.3, 0.0, 1.9);
  context.bone = {{from, to}};
  DepthFrame frame{0, 0.0, DepthImage(camera.width, camera.height, 2.0f)};
  DamageFrame(settings, context, frame);
  int damaged = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vector3d point = camera.Unproject<double>(u, v, 2.0);
      const Vector3d nearest(std::clamp(point.x(), -0.3, 0.3), 0.0, 1.9);
      const bool is_near = (point - nearest).norm() <= settings.bone_radius_m;
      EXPECT_EQ(frame.depth(u, v), is_near ? 0.0f : 2.0f) << u << " " << v;
      damaged += is_near ? 1 : 0;
    }
  }
  EXPECT_GT(damaged, 400);
  EXPECT_LT(damaged, 1000);
}

TEST(DepthFaults, ABoneReachesToThoseThatHangOnIt) {
  std::vector<Vector3d> joints;
  for (std::size_t b = 0; b < Bones().size(); ++b)
    joints.emplace_back(static_cast<double>(b), 0, 0);
  const auto forearm = static_cast<double>(FindBone("left_forearm"));
  const std::vector<BoneSegment> segments = BoneSegments("left_forearm", joints);
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_EQ(segments[0][0].x(), forearm);
  EXPECT_EQ(segments[0][1].x(), static_cast<double>(FindBone("left_hand")));
  const std::vector<BoneSegment> hand = BoneSegments("left_hand", joints);
  ASSERT_EQ(hand.size(), 1u);
  EXPECT_EQ(hand[0][0], hand[0][1]);
}

TEST(DepthFaults, AnUnknownBoneOrARectangleTurnedOverIsRefused) {
  const auto problem = [](const Json& depth) -> std::string {
    try {
      ReadSettings<InputFaultSettings>({{"depth", depth}}, {"e.json", "faults"});
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(problem({{"kind", "zero"}, {"place", "bone"}, {"bone", "tail"}})
                .find("bone \"tail\": expected one of pelvis"),
            std::string::npos);
  EXPECT_NE(problem({{"kind", "zero"}, {"place", "region"}, {"region_px", {9, 0, 3, 5}}})
                .find("left and top first"),
            std::string::npos);
  EXPECT_EQ(problem({{"kind", "zero"}, {"place", "bone"}, {"bone", "left_hand"}}), "");
}

TEST(SubjectFaults, ABoneWithoutVerticesHandsItsWeightsToItsParent) {
  const BodyModel whole = TinyBody(2);
  BodyModel body = whole;
  DamageSubject({.bone_without_vertices = "left_hand"}, body);
  EXPECT_EQ(WeightsProblem(body.weights, body.rest.vertices.size(), kBoneCount), "");
  const Eigen::MatrixXf before = Dense(whole.weights, kBoneCount),
                        after = Dense(body.weights, kBoneCount);
  const int hand = static_cast<int>(BoneId::kLeftHand);
  const int forearm = static_cast<int>(BoneId::kLeftForearm);
  ASSERT_GT(before.col(hand).sum(), 10.0f);
  EXPECT_EQ(after.col(hand).sum(), 0.0f);
  EXPECT_TRUE(after.col(forearm).isApprox(before.col(forearm) + before.col(hand), 1e-6f));
  const int foot = static_cast<int>(BoneId::kLeftFoot);
  EXPECT_TRUE(after.col(foot).isApprox(before.col(foot), 1e-6f));
}

TEST(SubjectFaults, TrianglesAreAddedAndNoneIsLost) {
  const BodyModel whole = TinyBody(2);
  BodyModel body = whole;
  SubjectFaultSettings settings;
  settings.duplicate_triangles = 7;
  settings.degenerate_triangles = 5;
  DamageSubject(settings, body);
  const std::size_t count = whole.rest.triangles.size();
  ASSERT_EQ(body.rest.triangles.size(), count + 12);
  for (std::size_t t = 0; t < count; ++t) {
    EXPECT_EQ(body.rest.triangles[t], whole.rest.triangles[t]);
  }
  EXPECT_EQ(body.rest.triangles[count], whole.rest.triangles[0]);
  EXPECT_EQ(body.rest.triangles[count + 6], whole.rest.triangles[6 * count / 7]);
  const Triangle& degenerate = body.rest.triangles.back();
  EXPECT_EQ(degenerate[0], degenerate[1]);
  EXPECT_NE(degenerate[0], degenerate[2]);
  EXPECT_EQ(body.rest.vertices, whole.rest.vertices);
}

TEST(SubjectFaults, ARootOrAnUnknownBoneIsRefused) {
  for (const char* bone : {"pelvis", "tail"}) {
    const Json json = {{"subject", {{"bone_without_vertices", bone}}}};
    try {
      ReadSettings<InputFaultSettings>(json, {"e.json", "variants[0].faults"});
      FAIL() << bone;
    } catch (const ConfigError& error) {
      EXPECT_EQ(std::string(error.what())
                    .find("e.json: variants[0].faults.subject: "
                          "bone_without_vertices \"" +
                          std::string(bone) + "\": expected one of abdomen, chest, neck"),
                0u)
          << error.what();
    }
  }
}

TEST(SubjectFaults, ATemplateOfAnotherSizeIsScaledAsAWhole) {
  Subject subject = TinyBody();
  const Subject whole = subject;
  SubjectFaultSettings settings;
  settings.size_factor = 1.1;
  DamageSubject(settings, subject);
  EXPECT_NEAR(subject.rest.vertices[5].y(), 1.1f * whole.rest.vertices[5].y(), 1e-6f);
  EXPECT_NEAR(subject.skeleton.joints[7].x(), 1.1 * whole.skeleton.joints[7].x(), 1e-12);
  EXPECT_NEAR(subject.skeleton.tips[7].x(), 1.1 * whole.skeleton.tips[7].x(), 1e-12);
}

TEST(ViewFaults, ImagesAreRepeatedOrComeBackwards) {
  ViewFaultSettings settings;
  settings.first_frame = 10;
  settings.frames = 3;
  EXPECT_EQ(settings.ShownFrame(11), 11);
  settings.order = FrameOrder::kRepeated;
  EXPECT_EQ(settings.ShownFrame(9), 9);
  EXPECT_EQ(settings.ShownFrame(12), 10);
  EXPECT_EQ(settings.ShownFrame(13), 13);
  settings.order = FrameOrder::kBackwards;
  EXPECT_EQ(settings.ShownFrame(12), 8);
}

TEST(ViewFaults, ImagesAreMirroredAndCutOff) {
  DepthImage depth(4, 1);
  for (int u = 0; u < 4; ++u) depth(u, 0) = 1.0f + static_cast<float>(u);
  ViewFaultSettings settings;
  settings.only_px = {1, 0, 3, 0};
  settings.mirrored = true;
  settings.DamageImage(depth);
  EXPECT_EQ(depth.pixels(), (std::vector<float>{4.0f, 3.0f, 2.0f, 0.0f}));
  settings.focal_factor = 1.05;
  EXPECT_DOUBLE_EQ(settings.ToldCamera({}).fx, 1.05 * PinholeCamera().fx);
}

TEST(InputFaults, AreNoneUnlessSomethingIsDamaged) {
  EXPECT_TRUE(InputFaultSettings{}.AreNone());
  InputFaultSettings depth, subject, view;
  depth.depth.kind = DepthFault::kZero;
  subject.subject.duplicate_triangles = 1;
  view.view.mirrored = true;
  EXPECT_FALSE(view.AreNone());
  EXPECT_FALSE(depth.AreNone());
  EXPECT_FALSE(subject.AreNone());
}

}  // namespace
}  // namespace vitruvia
