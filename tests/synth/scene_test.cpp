#include "synth/scene/scene.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/json_settings.h"
#include "core/error.h"
#include "core/files.h"
#include "geometry/depth_png.h"
#include "geometry/point_cloud.h"
#include "geometry/surface_map.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "sequence/joint_visibility.h"
#include "sequence/sequence.h"
#include "support/temporary_folder.h"
#include "support/tiny_body.h"
#include "synth/render/depth_renderer.h"
#include "synth/scene/preview.h"
#include "synth/scene/recording.h"
#include "synth/scene/stage.h"
#include "verification/verification.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

// Stands, then raises the left forearm by 90 degrees within a second, while walking `stride_m` to
// its left.
class RaiseLeftForearm final : public Motion {
 public:
  explicit RaiseLeftForearm(const Skeleton& skeleton, double stride_m = 0.0)
      : skeleton_(skeleton), stride_m_(stride_m) {}
  MotionSample At(double time_s) const override {
    MotionSample sample{JointPose::Rest(skeleton_), true, 0.0};
    const double share = std::min(time_s, 1.0);
    sample.pose.local_rotations[static_cast<int>(BoneId::kLeftForearm)] =
        ExpSo3<double>({0.0, 0.0, 0.5 * M_PI * share});
    sample.pose.pelvis_position.x() += stride_m_ * share;
    return sample;
  }
  double duration_s() const override { return 1.0; }

 private:
  Skeleton skeleton_;
  double stride_m_;
};

SceneSettings SmallScene() {
  SceneSettings scene;
  scene.frames = 4;
  scene.fps = 3.0;  // one second from the first frame to the last
  scene.view.position_m = {0.0, 1.0, 2.8};
  scene.view.look_at_m = {0.0, 1.0, 0.0};
  return scene;
}

void Record(const SceneSettings& scene, const fs::path& folder, double stride_m = 0.0) {
  const BodyModel truth = TinyBody(3), subject = TinyBody(2);
  RecordSequence(scene, truth, subject, RaiseLeftForearm(truth.skeleton, stride_m), folder);
}

TEST(Recording, SceneThatOutlastsItsMotionIsTold) {
  const TemporaryFolder folder;
  SceneSettings scene = SmallScene();
  scene.motion.file = "raise.json";
  scene.frames = 8;  // the motion ends in the fourth
  Record(scene, folder / "long");
  EXPECT_THAT(ReadJsonFile(folder / "long" / "sequence.json").dump(),
              AllOf(HasSubstr("raise.json: the motion ends after 1.00 s"),
                    HasSubstr("take 2.67 s: the last 4 frames hold the last pose")));
  scene.frames = 4;
  Record(scene, folder / "right");
  EXPECT_THAT(ReadJsonFile(folder / "right" / "sequence.json").dump(),
              testing::Not(HasSubstr("the motion ends")));
}

TEST(View, LooksUprightFromItsPlaceAtItsPoint) {
  ViewSettings view;
  view.position_m = {1.0, 1.5, 2.0};
  view.look_at_m = {0.0, 0.5, 0.0};
  const Rigidd camera_from_subject = CameraFromSubject(view);
  const Matrix3<double>& r = camera_from_subject.rotation;
  EXPECT_LT((r * r.transpose() - Matrix3<double>::Identity()).norm(), 1e-12);
  EXPECT_NEAR(r.determinant(), 1.0, 1e-12);
  EXPECT_LT((camera_from_subject * Vector3d(1.0, 1.5, 2.0)).norm(), 1e-12);
  EXPECT_LT((camera_from_subject * Vector3d(0.0, 0.5, 0.0) - Vector3d(0, 0, std::sqrt(6.0))).norm(),
            1e-12);
  const Vector3d up = r * Vector3d::UnitY();
  EXPECT_NEAR(up.x(), 0.0, 1e-12);  // no roll
  EXPECT_LT(up.y(), 0.0);           // camera y runs down

  // From the front, the subject's left is on the image's right.
  view.position_m = {0.0, 1.0, 3.0};
  view.look_at_m = {0.0, 1.0, 0.0};
  const Vector3d left_hand = CameraFromSubject(view) * Vector3d(0.8, 1.4, 0.1);
  EXPECT_LT((left_hand - Vector3d(0.8, -0.4, 2.9)).norm(), 1e-12);
}

TEST(Pose, StandsOnTheFloorWhereItIsToBeGrounded) {
  const BodyModel body = TinyBody();
  const Rigidd same;
  const auto lowest = [](const TruePose& posed) {
    float y = 1e9f;
    for (const Vector3f& p : posed.vertices) y = std::min(y, p.y());
    return y;
  };
  for (const Skinning skinning : {Skinning::kLinear, Skinning::kDualQuaternion}) {
    MotionSample sample{JointPose::Rest(body.skeleton), true, 0.25};
    sample.pose.pelvis_position.y() += 7.0;
    const TruePose lifted = Pose(body, sample, skinning, same);
    EXPECT_NEAR(lowest(lifted), 0.25f, 1e-5);
    for (int b = 0; b < kBoneCount; ++b) {
      EXPECT_LT((lifted.joints[b] - body.skeleton.joints[b] - Vector3d(0, 0.25, 0)).norm(), 1e-5);
    }
    sample.grounded = false;
    EXPECT_NEAR(lowest(Pose(body, sample, skinning, same)), 7.0f, 1e-5);
  }
}

TEST(Pose, MovesSurfaceAndJointsIntoTheCameraFrame) {
  const BodyModel body = TinyBody();
  const Rigidd camera_from_subject = CameraFromSubject(ViewSettings{});
  const MotionSample sample{JointPose::Rest(body.skeleton), true, 0.0};
  const TruePose posed = Pose(body, sample, Skinning::kLinear, camera_from_subject);
  for (std::size_t i = 0; i < posed.vertices.size(); ++i) {
    const Vector3d expected = camera_from_subject * body.rest.vertices[i].cast<double>().eval();
    ASSERT_LT((posed.vertices[i].cast<double>() - expected).norm(), 1e-6);
  }
  for (int b = 0; b < kBoneCount; ++b) {
    const Vector3d& rest = body.skeleton.joints[b];
    ASSERT_LT((posed.joints[b] - camera_from_subject * rest).norm(), 1e-7);
    ASSERT_LT((posed.camera_from_rest[b] * rest - posed.joints[b]).norm(), 1e-12);
  }
}

TEST(SeesJoint, InTheImageAndNotBehindOtherThings) {
  const PinholeCamera camera;
  DepthImage depth(camera.width, camera.height, 2.0f);
  depth(10, 20) = 0.0f;
  const auto sees = [&](double u, double v, double z) {
    return SeesJoint(camera.Unproject(u, v, z), 0.15, depth, camera);
  };
  EXPECT_TRUE(sees(100, 100, 2.14));
  EXPECT_FALSE(sees(100, 100, 2.16));
  EXPECT_TRUE(sees(100, 100, 1.9));
  EXPECT_TRUE(sees(10, 20, 5.0));  // nothing in front of it
  EXPECT_TRUE(sees(319.4, 239.4, 2.1));
  EXPECT_FALSE(sees(319.6, 100, 2.1));
  EXPECT_FALSE(sees(100, -0.6, 2.1));
  EXPECT_FALSE(sees(100, 100, -2.1));
  EXPECT_FALSE(SeesJoint({1e30, 0.0, 1e-30}, 0.15, depth, camera));
}

TEST(VisibleJoints, LieDeeperInTheTrunkThanInLimbs) {
  const PinholeCamera camera;
  const DepthImage depth(camera.width, camera.height, 2.0f);
  const std::vector<bool> visible = VisibleJoints(
      std::vector<Vector3d>(kBoneCount, camera.Unproject(100.0, 100.0, 2.2)), depth, camera);
  for (int b = 0; b < kBoneCount; ++b) EXPECT_EQ(visible[b], b <= 2) << Bones()[b].name;
}

TEST(RecordSequence, WritesWhatTheBodyDoes) {
  const TemporaryFolder temporary;
  const fs::path folder = temporary / "walk";
  const SceneSettings scene = SmallScene();
  Record(scene, folder);
  VerifySequence(folder);
  const SequenceReader reader(folder);
  ASSERT_EQ(reader.info().frames, 4);
  EXPECT_EQ(reader.info().fps, 3.0);
  EXPECT_EQ(reader.subject().rest.vertices.size(), TinyBody(2).rest.vertices.size());
  ASSERT_EQ(reader.info().joints.size(), std::size_t{kBoneCount});
  EXPECT_EQ(reader.info().joints[5], Bones()[5].joint);

  const BodyModel truth = TinyBody(3);
  const RaiseLeftForearm motion(truth.skeleton);
  DepthRenderer renderer(scene.view.camera);
  for (int i = 0; i < 4; ++i) {
    const TruePose posed =
        Pose(truth, motion.At(i / 3.0), Skinning::kLinear, CameraFromSubject(scene.view));
    EXPECT_EQ(reader.ReadTrueVertices(i), posed.vertices);
    EXPECT_EQ(reader.true_joints(i).positions, posed.joints);
    const DepthImage stored = reader.ReadDepth(i);
    const DepthImage rendered = renderer.Render(posed.vertices, truth.rest.triangles);
    for (std::size_t p = 0; p < stored.pixels().size(); ++p) {
      ASSERT_NEAR(stored.pixels()[p], rendered.pixels()[p], 0.0005 + 1e-5);
    }
  }
}

TEST(RecordSequence, ShowsTheLeftHandOnTheRightAndAbove) {
  const TemporaryFolder temporary;
  Record(SmallScene(), temporary / "walk");
  const SequenceReader reader(temporary / "walk");
  const int wrist = static_cast<int>(BoneId::kLeftHand), elbow = wrist - 1;
  const JointTruth& joints = reader.true_joints(3);
  const Eigen::Vector2d wrist_px = reader.info().camera.Project(joints.positions[wrist]);
  const Eigen::Vector2d elbow_px = reader.info().camera.Project(joints.positions[elbow]);
  EXPECT_GT(elbow_px.x(), 170.0);
  EXPECT_NEAR(wrist_px.x(), elbow_px.x(), 1.0);
  EXPECT_LT(wrist_px.y(), elbow_px.y() - 20.0);
  EXPECT_GT(reader.ReadDepth(3)(static_cast<int>(wrist_px.x()), static_cast<int>(wrist_px.y())),
            2.5f);
  EXPECT_EQ(joints.visible, std::vector<bool>(kBoneCount, true));
}

TEST(RecordSequence, HidesJointsBehindTheBody) {
  const TemporaryFolder temporary;
  SceneSettings scene = SmallScene();
  scene.frames = 1;
  scene.view.position_m = {-2.8, 1.4, 0.0};  // from the subject's right, along the arms
  scene.view.look_at_m = {0.0, 1.4, 0.0};
  scene.view.camera.fx = scene.view.camera.fy = 200.0;
  Record(scene, temporary / "side");
  const JointTruth joints = SequenceReader(temporary / "side").true_joints(0);
  const auto visible = [&](BoneId bone) { return joints.visible[static_cast<int>(bone)]; };
  EXPECT_FALSE(visible(BoneId::kRightUpperArm));  // behind the length of the right arm
  EXPECT_FALSE(visible(BoneId::kLeftHand));
  EXPECT_TRUE(visible(BoneId::kRightShin));
  EXPECT_FALSE(visible(BoneId::kLeftShin));
}

TEST(RecordSequence, SameSettingsGiveTheSameBytes) {
  const TemporaryFolder temporary;
  SceneSettings scene = SmallScene();
  scene.sensor = {.model = SensorModel::kGaussian, .sigma_m = 0.003, .dropout = 0.02};
  Record(scene, temporary / "a");
  Record(scene, temporary / "b");
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(temporary / "a")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const fs::path name = entry.path().lexically_relative(temporary / "a");
    EXPECT_EQ(ReadWholeFile(entry.path()), ReadWholeFile(temporary / "b" / name)) << name;
  }
  EXPECT_EQ(files, 1 + 4 + 3 + 3);

  // Another seed is other noise on the same truth, and each frame has noise of its own.
  scene.seed = 2;
  Record(scene, temporary / "c");
  const SequenceReader a(temporary / "a"), c(temporary / "c");
  EXPECT_NE(a.hash(), c.hash());
  EXPECT_NE(a.ReadDepth(0).pixels(), c.ReadDepth(0).pixels());
  EXPECT_NE(a.ReadDepth(0).pixels(), a.ReadDepth(1).pixels());
  EXPECT_EQ(a.ReadTrueVertices(3), c.ReadTrueVertices(3));
}

TEST(RecordSequence, SaysHowTheTruthDiffersAndWhenTheBodyLeaves) {
  const TemporaryFolder temporary;
  SceneSettings scene = SmallScene();
  scene.truth.skinning = Skinning::kDualQuaternion;
  scene.truth.refinement.weight_diffusion = 3;
  testing::internal::CaptureStderr();
  Record(scene, temporary / "walk", 1.6);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("warning: the body leaves the image in 2 of 4 frames, first in frame 2"));
  const Json provenance = SequenceReader(temporary / "walk").info().provenance;
  EXPECT_THAT(provenance["warnings"][0].get<std::string>(), HasSubstr("first in frame 2"));
  EXPECT_THAT(provenance["truth_differs_from_template"].dump(),
              AllOf(HasSubstr("dual quaternions"), HasSubstr("vertices, the template"),
                    HasSubstr("diffused over 3 steps in the truth, 0 in the template")));
  EXPECT_EQ(provenance["scene"], WriteSettings(scene));
  EXPECT_TRUE(provenance["build"].contains("commit"));
  // The forearm that dual quaternions turn about the elbow keeps its girth, the template's shrinks.
  const double misfit_m = provenance["template_moved_by_true_bones"]["l2_max_m"];
  EXPECT_GT(misfit_m, 0.005);
  EXPECT_LT(misfit_m, 0.05);

  Record(SmallScene(), temporary / "stay");
  EXPECT_FALSE(SequenceReader(temporary / "stay").info().provenance.contains("warnings"));
}

TEST(RecordSequence, FindsNoMisfitWhereTemplateAndTruthAreOne) {
  const TemporaryFolder temporary;
  const BodyModel body = TinyBody(2);
  RecordSequence(SmallScene(), body, body, RaiseLeftForearm(body.skeleton), temporary / "walk");
  const Json misfit =
      SequenceReader(temporary / "walk").info().provenance["template_moved_by_true_bones"];
  EXPECT_LT(misfit["l2_max_m"].get<double>(), 2e-6);  // rounding of single precision
}

TEST(RecordSequence, RefusesABodyTooNearToTheCameraAndLeavesNothing) {
  const TemporaryFolder temporary;
  SceneSettings scene = SmallScene();
  scene.view.position_m = {2.0, 1.0, 0.1};
  scene.view.look_at_m = {0.0, 1.0, 0.0};
  try {
    Record(scene, temporary / "walk", 1.4);
    FAIL() << "not refused";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("view.position_m"), HasSubstr("in frame 3")));
  }
  EXPECT_TRUE(fs::is_empty(temporary.path()));
}

// --- Scene files ---------------------------------------------------------------------------------

std::string ProblemOf(const char* overrides) {
  const Json scene =
      Merged(Json::parse(R"({"motion": {"file": "walk.json"}})"), Json::parse(overrides));
  try {
    ReadSettings<SceneSettings>(scene, {"scene.json", ""});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(SceneSettings, AreChecked) {
  EXPECT_EQ(ProblemOf("{}"), "");
  EXPECT_THAT(ProblemOf(R"({"motion": null})"), HasSubstr("motion: missing"));
  EXPECT_THAT(ProblemOf(R"({"frames": 0})"), HasSubstr("frames"));
  EXPECT_THAT(ProblemOf(R"({"view": {"position_m": [0, 1, 0.2]}})"),
              HasSubstr("stands inside the body"));
  EXPECT_THAT(ProblemOf(R"({"view": {"position_m": [0, 0.95, 0]}})"), HasSubstr("the same point"));
  EXPECT_THAT(ProblemOf(R"({"view": {"position_m": [0, 3, 0], "look_at_m": [0, 0, 0]}})"),
              HasSubstr("straight up or down"));
  EXPECT_THAT(ProblemOf(R"({"view": {"position_m": [0, 1]}})"), HasSubstr("a list of 3 numbers"));
  EXPECT_THAT(ProblemOf(R"({"truth": {"skinning": "dual"}})"), HasSubstr("dual_quaternion"));
  EXPECT_THAT(ProblemOf(R"({"truth": {"subdivision": 2}})"),
              HasSubstr("did you mean \"subdivisions\""));
}

// Every scene that the project ships is read, and its body stays whole in view throughout.
TEST(ShippedScenes, KeepTheWholeBodyInView) {
  const fs::path folder = fs::path(VITRUVIA_SOURCE_DIR) / "configs/scenes";
  for (const char* name : {"fig11.json", "fig11_hard.json", "small.json"}) {
    const SceneSettings scene = ReadSettingsFile<SceneSettings>(folder / name);
    const auto width = static_cast<float>(scene.view.camera.width);
    const auto height = static_cast<float>(scene.view.camera.height);
    const ControlBody control = MakeControlBody(scene.body);
    const BodyModel body = Refine(control, {});
    const std::unique_ptr<Motion> motion = LoadMotion(scene.motion, body.skeleton);
    for (int i = 0; i < scene.frames; ++i) {
      const TruePose posed = Pose(body, motion->At(i / scene.fps), scene.truth.skinning,
                                  CameraFromSubject(scene.view));
      for (const Vector3f& p : posed.vertices) {
        const Eigen::Vector2f pixel = scene.view.camera.Project(p);
        ASSERT_TRUE(pixel.x() > 0 && pixel.x() < width - 1 && pixel.y() > 0 &&
                    pixel.y() < height - 1)
            << name << ", frame " << i;
      }
    }
  }
}

// The first frames of every scene that needs no data from elsewhere.
TEST(ShippedScenes, PassTheVerificationWithoutAWarning) {
  const TemporaryFolder temporary;
  int verified = 0;
  const fs::path folder = fs::path(VITRUVIA_SOURCE_DIR) / "configs/scenes";
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string text = entry.is_regular_file() ? ReadWholeFile(entry.path()) : "$";
    if (text.find("makehuman") != std::string::npos || text.find('$') != std::string::npos)
      continue;
    SceneSettings scene = ReadSettingsFile<SceneSettings>(entry.path());
    scene.frames = 3;
    const fs::path made = temporary / entry.path().stem().string();
    SynthesizeSequence(scene, made);
    for (const Finding& finding : FindInconsistencies(SequenceReader(made), FrameSelection::kAll))
      ADD_FAILURE() << entry.path() << ": " << finding.text;
    ++verified;
  }
  EXPECT_GE(verified, 10);
}

TEST(ShippedScenes, AreMadeEndToEnd) {
  const TemporaryFolder temporary;
  SceneSettings scene =
      ReadSettingsFile<SceneSettings>(fs::path(VITRUVIA_SOURCE_DIR) / "configs/scenes/fig11.json");
  scene.frames = 2;
  SynthesizeSequence(scene, temporary / "fig11");
  VerifySequence(temporary / "fig11");
  const SequenceReader reader(temporary / "fig11");
  // What the camera sees of a man 1.75 m tall: in the T-pose he is as wide as tall, within a tenth.
  const DepthImage depth = reader.ReadDepth(0);
  int left = 320, right = 0, top = 240, bottom = 0;
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      if (depth(u, v) == 0.0f) continue;
      left = std::min(left, u);
      right = std::max(right, u);
      top = std::min(top, v);
      bottom = std::max(bottom, v);
    }
  }
  const double height_px = 1.75 / 2.75 * 285;
  EXPECT_NEAR(bottom - top, height_px, 0.05 * height_px);
  EXPECT_NEAR(right - left, height_px, 0.1 * height_px);
  EXPECT_NEAR(0.5 * (left + right), 159.5, 1.0);
}

SceneSettings RoomScene() {
  SceneSettings scene = SmallScene();
  scene.frames = 2;
  scene.room.floor = true;
  scene.room.wall_behind_m = 1.5;
  scene.room.wall_height_m = 5.0;  // up to the upper edge of the image
  scene.room.furniture = {{{-1.0, -1.0}, {0.4, 0.5, 0.4}, 0.0, 0.0}};
  scene.room.empty_frames = 1;
  return scene;
}

// The level camera at 1 m sees the floor at height·f / (v − cy), the wall at its distance.
TEST(Room, FloorAndWallAreWhereTheyAreSaidToBe) {
  const TemporaryFolder folder;
  const SceneSettings scene = RoomScene();
  Record(scene, folder / "room");
  const PinholeCamera& camera = scene.view.camera;
  const DepthImage empty =
      ReadDepthPng(folder / "room/empty_room/000000.png", 0.001, camera.width, camera.height);
  const double wall_m = 2.8 + 1.5;
  for (int v = 0; v < camera.height; v += 7) {
    const double below = (v - camera.cy) / camera.fy;
    const double expected = below > 0.0 ? std::min(wall_m, 1.0 / below) : wall_m;
    EXPECT_NEAR(empty(200, v), expected, 0.002) << v;
  }
}

TEST(Room, TrueMaskIsWhereTheSceneWithoutRoomHasItsBody) {
  const TemporaryFolder folder;
  SceneSettings scene = RoomScene();
  Record(scene, folder / "room");
  scene.room = RoomSettings();
  Record(scene, folder / "bare");
  const SequenceReader room(folder / "room"), bare(folder / "bare");
  EXPECT_FALSE(bare.has_masks());
  EXPECT_FALSE(fs::exists(folder / "bare/empty_room"));
  for (int i = 0; i < 2; ++i) {
    const DepthImage body = bare.ReadDepth(i), masked = room.ReadDepth(i);
    const DepthImage whole = room.ReadDepthWithRoom(i);
    int hidden = 0;  // soles that touch the floor
    for (std::size_t k = 0; k < body.pixels().size(); ++k) {
      ASSERT_GT(whole.pixels()[k], 0.0f);
      if (masked.pixels()[k] != body.pixels()[k]) ++hidden;
    }
    EXPECT_LT(hidden, 20) << "frame " << i;
    EXPECT_EQ(room.true_joints(i).visible, bare.true_joints(i).visible);
  }
}

TEST(Room, FurnitureInFrontHidesTheBody) {
  const TemporaryFolder folder;
  SceneSettings scene = RoomScene();
  scene.room.furniture = {{{0.0, 1.0}, {4.0, 1.0, 0.1}, 0.0, 0.0}};  // a wall up to the hips
  Record(scene, folder / "room");
  const SequenceReader room(folder / "room");
  const MaskImage mask = room.ReadMask(0);
  for (int v = 120; v < mask.height(); ++v) {
    for (int u = 0; u < mask.width(); ++u) ASSERT_EQ(mask(u, v), 0) << u << " " << v;
  }
  EXPECT_FALSE(room.true_joints(0).visible[static_cast<std::size_t>(FindJoint("left_ankle"))]);
}

// What another camera measures lies, taken to the first camera's frame, on the true surface.
TEST(OtherViews, PointsLieOnTheTrueSurface) {
  const TemporaryFolder folder;
  SceneSettings scene = SmallScene();
  scene.frames = 2;
  ViewSettings side;
  side.position_m = {2.5, 1.3, -0.5};
  side.look_at_m = {0.0, 1.0, 0.0};
  scene.views = {{"side", side}};
  Record(scene, folder / "seen_twice");
  const SequenceReader sequence(folder / "seen_twice");
  ASSERT_EQ(sequence.info().views.size(), 1u);
  const OtherView& view = sequence.info().views[0];
  const Rigidf camera_from_view = Inverse(view.view_from_camera).Cast<float>();
  for (int i = 0; i < 2; ++i) {
    PointCloud cloud;
    CloudFromDepth(sequence.ReadViewDepth(0, i), view.camera, 5, 100.0f, cloud);
    ASSERT_GT(cloud.points.size(), 50u);
    for (Vector3f& point : cloud.points) point = camera_from_view * point;
    const TriangleMesh truth{sequence.ReadTrueVertices(i), sequence.true_rest_mesh().triangles};
    const std::vector<SurfacePoint> nearest = ClosestSurfacePoints(cloud.points, truth);
    for (std::size_t k = 0; k < nearest.size(); ++k) {
      const Vector3f on = Evaluate(nearest[k], truth.vertices.data(), truth.triangles);
      ASSERT_LT((cloud.points[k] - on).norm(), 0.002f);
    }
  }
}

TEST(Occluder, IsThereFromItsTimeToItsTimeAndFollowsItsPath) {
  OccluderSettings post;
  post.radius_m = 0.1;
  post.motion = OccluderMotion::kPath;
  post.path = {{1.0, {0.0, 1.0}}, {2.0, {1.0, 1.0}}, {4.0, {1.0, 3.0}}};
  const auto at = [&](double time_s) { return PositionAt(post, time_s); };
  EXPECT_EQ(at(0.0), (std::array{0.0, 1.0}));
  EXPECT_EQ(at(1.25), (std::array{0.25, 1.0}));
  EXPECT_EQ(at(3.0), (std::array{1.0, 2.0}));
  EXPECT_EQ(at(9.0), (std::array{1.0, 3.0}));
  post.presence = {1.0, 2.0};
  EXPECT_FALSE(post.presence.Holds(0.99));
  EXPECT_TRUE(post.presence.Holds(1.0));
  EXPECT_FALSE(post.presence.Holds(2.0));
}

// A second person stands where it is put and hides the subject.
TEST(Occluder, APersonIsTheBodyAtAnotherMomentOfItsMotion) {
  const TemporaryFolder folder;
  SceneSettings scene = SmallScene();
  scene.frames = 2;
  Record(scene, folder / "alone");
  scene.occluder.shape = OccluderShape::kPerson;
  scene.occluder.later_s = 0.0;
  scene.occluder.start_m = {0.0, 0.5};
  scene.occluder.velocity_m_s = {0.0, 0.0};
  Record(scene, folder / "behind");
  const SequenceReader alone(folder / "alone"), behind(folder / "behind");
  const auto middle = [](const SequenceReader& sequence) {
    const DepthImage depth = sequence.ReadDepth(0);
    return depth(depth.width() / 2, depth.height() / 2);
  };
  EXPECT_NEAR(middle(alone) - middle(behind), 0.5, 0.02);
  EXPECT_FALSE(behind.true_joints(0).visible[static_cast<std::size_t>(FindJoint("neck"))]);
}

TEST(Occluder, APathOutOfOrderAndATimeTurnedOverAreRefused) {
  const auto problem = [](const Json& occluder) -> std::string {
    try {
      ReadSettings<OccluderSettings>(occluder, {"s.json", "occluder"});
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  const Json late = {{"time_s", 2.0}, {"position_m", {0, 1}}},
             early = {{"time_s", 1.0}, {"position_m", {0, 1}}};
  EXPECT_EQ(problem({{"radius_m", 0.1}, {"motion", "path"}, {"path", {early, late}}}), "");
  EXPECT_THAT(problem({{"radius_m", 0.1}, {"motion", "path"}, {"path", {late, early}}}),
              HasSubstr("path[1].time_s: expected more than 2"));
  EXPECT_THAT(problem({{"radius_m", 0.1}, {"motion", "path"}}),
              HasSubstr("at least one way point"));
  EXPECT_THAT(problem({{"radius_m", 0.1}, {"from_s", 3.0}, {"to_s", 1.0}}),
              HasSubstr("from_s 3 and to_s 1"));
}

TEST(Carried, MovesWithItsBone) {
  const BodyModel body = TinyBody();
  CarriedSettings box;
  box.bone = "left_forearm";
  box.size_m = {0.2, 0.4, 0.6};
  box.offset_m = {0.1, 0.0, 0.0};
  MotionSample sample{JointPose::Rest(body.skeleton), true, 0.0};
  sample.pose.local_rotations[static_cast<int>(BoneId::kLeftForearm)] =
      ExpSo3<double>({0.0, 0.0, 0.5 * M_PI});
  const TruePose posed = Pose(body, sample, Skinning::kLinear, Rigidd{});
  TriangleMesh mesh;
  AddCarried(box, 0.0, body.skeleton, posed.camera_from_rest, mesh);
  ASSERT_EQ(mesh.triangles.size(), 12u);
  Vector3d middle = Vector3d::Zero();
  Vector3d least = Vector3d::Constant(9.0), most = Vector3d::Constant(-9.0);
  for (const Vector3f& corner : mesh.vertices) {
    const Vector3d p = corner.cast<double>();
    middle += p / static_cast<double>(mesh.vertices.size());
    least = least.cwiseMin(p);
    most = most.cwiseMax(p);
  }
  // A quarter turn about z carries the offset along x to y, and the box's width to its height.
  const auto forearm = static_cast<std::size_t>(BoneId::kLeftForearm);
  EXPECT_LT((middle - posed.joints[forearm] - Vector3d(0.0, 0.1, 0.0)).norm(), 1e-5);
  EXPECT_LT((most - least - Vector3d(0.4, 0.2, 0.6)).norm(), 1e-5);
}

TEST(RecordSequence, AFirstFrameThatIsNotThePersonAloneIsTold) {
  const TemporaryFolder temporary;
  const auto warnings = [&](const SceneSettings& scene, const char* name) {
    testing::internal::CaptureStderr();
    Record(scene, temporary / name);
    return testing::internal::GetCapturedStderr();
  };
  SceneSettings scene = SmallScene();
  scene.occluder.radius_m = 0.1;
  scene.occluder.start_m = {-1.15, 0.0};  // beside the person
  scene.occluder.velocity_m_s = {0.0, 0.0};
  EXPECT_THAT(warnings(scene, "beside"),
              AllOf(HasSubstr("the first frame does not show the whole person alone"),
                    HasSubstr("a tracker takes them for the person"),
                    testing::Not(HasSubstr("are hidden"))));
  scene.occluder.presence.from_s = 0.5;
  EXPECT_THAT(warnings(scene, "later"), testing::Not(HasSubstr("warning")));
  scene.occluder.presence.from_s = 0.0;
  scene.occluder.start_m = {0.0, 0.8};  // before the person
  EXPECT_THAT(warnings(scene, "before"), HasSubstr("% of the person are hidden"));
  // A room comes with a mask of the person.
  scene.occluder.start_m = {-1.15, 0.0};
  scene.room.wall_behind_m = 2.0;
  EXPECT_THAT(warnings(scene, "room"), testing::Not(HasSubstr("warning")));
  scene = SmallScene();
  scene.carried.bone = "left_hand";
  EXPECT_THAT(warnings(scene, "carried"), HasSubstr("the whole person alone"));
}

TEST(Preview, ShowsFramesFromTheFirstToTheLastAsTheyWillBeRecorded) {
  const TemporaryFolder temporary;
  SceneSettings scene;
  scene.motion.source = MotionSource::kKeyframes;
  scene.motion.file = std::filesystem::path(VITRUVIA_SOURCE_DIR) / "configs/motions/arm_wave.json";
  scene.view.camera = {80, 60, 71.0, 71.0, 39.5, 29.5};
  scene.truth.refinement.subdivisions = 0;
  scene.frames = 7;
  const ScenePreview preview = PreviewScene(scene, 3);
  SynthesizeSequence(scene, temporary / "whole");
  const SequenceReader whole(temporary / "whole");
  ASSERT_EQ(preview.frames.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const PreviewFrame& frame = preview.frames[i];
    EXPECT_EQ(frame.frame, static_cast<int>(3 * i));
    const DepthImage stored = whole.ReadDepth(frame.frame);
    for (std::size_t p = 0; p < stored.pixels().size(); ++p) {
      ASSERT_NEAR(frame.depth.pixels()[p], stored.pixels()[p], 0.00051);  // stored in millimetres
      ASSERT_EQ(frame.body.pixels()[p] > 0, stored.pixels()[p] > 0.0f);
    }
  }
  EXPECT_TRUE(preview.warnings.empty());
  EXPECT_EQ(PreviewScene(scene, 100).frames.size(), 7u);
}

}  // namespace
}  // namespace vitruvia
