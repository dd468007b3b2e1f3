#include "subjects/rig.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "math/angles.h"
#include "math/statistics.h"
#include "subjects/rig_pictures.h"
#include "support/small_space.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;

const ShapeSpace& SmallSpace() {
  static const ShapeSpace space = LearnSmallSpace(16, 4);
  return space;
}

RigSettings QuickSettings() {
  RigSettings settings;
  settings.registration.components = 4;
  settings.registration.search.headings = 2;
  settings.registration.clothing = Clothing::kNone;
  settings.registration.search.coarse_vertices = 300;
  settings.registration.search.fine_vertices = 1000;
  settings.registration.surface_points = 5000;
  settings.weights.alternations = 4;
  return settings;
}

// A mannequin whose arms and knees move from frame to frame, skinned by dual quaternions: linear
// blend skinning cannot follow it exactly.
std::vector<TriangleMesh> Moving(int frames) {
  const BodyModel body = PlacedBody(SmallSpace(), Eigen::VectorXd::Zero(4), Sex::kMale);
  std::vector<TriangleMesh> meshes;
  for (int f = 0; f < frames; ++f) {
    const double raised = 10.0 * f;
    AnatomicalPose angles;
    angles.sides_deg[kLeft] = {10,     20 + raised, 0, 20 + raised, 0, 0, 0,
                               raised, 4,           0, raised,      0, 0};
    angles.sides_deg[kRight] = {10, 30, 0, 10 + 0.5 * raised, 0, 0, 0, 0, 4, 0, 0.5 * raised, 0, 0};
    JointPose pose = JointPose::Rest(body.skeleton);
    SetRotations(angles, pose);
    TriangleMesh mesh{{}, body.rest.triangles};
    SkinDualQuaternion(body.rest.vertices, body.weights, ForwardKinematics(body.skeleton, pose),
                       mesh.vertices);
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

TEST(Rig, OneMeshIsPutIntoTheTPoseAndBack) {
  Registrar registrar(SmallSpace(), {}, QuickSettings().registration);
  RegistrationLog log;
  const Rig rig = RigMeshes(Moving(1), registrar, QuickSettings(), log);
  EXPECT_NO_THROW(CheckBodyModel(rig.subject, "subject"));
  ASSERT_TRUE(rig.cost.has_value());
  EXPECT_LT(rig.cost->reposing_max_m, 1e-4);  // inverse skinning is exact
  EXPECT_LT(std::abs(rig.cost->volume_change), 0.05);
  EXPECT_LT(rig.cost->folded_triangles, 20);
  // The T-pose of the mannequin itself, as wide as the body that was registered.
  EXPECT_NEAR(BoundingBox(rig.subject.rest.vertices).sizes().x(),
              BoundingBox(rig.model.rest.vertices).sizes().x(), 0.06);
  EXPECT_NEAR(BoundingBox(rig.subject.rest.vertices).min().y(), 0.0, 1e-5);
}

TEST(Rig, FramesTeachWeightsThatFollowThem) {
  Registrar registrar(SmallSpace(), {}, QuickSettings().registration);
  const std::vector<TriangleMesh> frames = Moving(6);
  RegistrationLog log;
  const Rig rig = RigMeshes(frames, registrar, QuickSettings(), log);
  ASSERT_EQ(rig.rmse_m.size(), frames.size());
  EXPECT_LT(Mean(rig.rmse_m), 0.003);
  EXPECT_EQ(rig.registrations[1].start, "the frame before");
  const std::vector<SurfaceStrip> strips = RigStrips(rig, frames, 2);
  ASSERT_EQ(strips.size(), 3u);
  EXPECT_EQ(strips[0].label, "T-pose");
  EXPECT_EQ(strips[2].label, "frame 3");
}

TEST(Rig, GoesOnWhereItWasInterrupted) {
  const TemporaryFolder folder;
  const std::vector<TriangleMesh> frames = Moving(3);
  RigSettings settings = QuickSettings();
  settings.surface = RigSurface::kModel;
  Registrar registrar(SmallSpace(), {}, settings.registration);
  RegistrationLog whole;
  const Rig expected = RigMeshes(frames, registrar, settings, whole);
  {
    RegistrationLog interrupted(folder / "log", "key");
    RigMeshes({frames[0], frames[1]}, registrar, settings, interrupted);
    std::ofstream(folder / "log", std::ios::app) << "{\"rotation\": [1.0, 0.";  // cut off
  }
  RegistrationLog log(folder / "log", "key");
  ASSERT_EQ(log.registrations().size(), 2u);
  const Rig resumed = RigMeshes(frames, registrar, settings, log);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const BodyState& state = resumed.registrations[f].state;
    EXPECT_EQ(state.rotation, expected.registrations[f].state.rotation);
    EXPECT_EQ(state.angles_deg, expected.registrations[f].state.angles_deg);
    EXPECT_EQ(state.theta, expected.registrations[f].state.theta);
  }
  EXPECT_TRUE(RegistrationLog(folder / "log", "another key").registrations().empty());
}

TEST(Rig, LeavesNothingWhereTheFirstMeshIsRefused) {
  const TemporaryFolder folder;
  std::vector<TriangleMesh> frames = Moving(1);
  frames[0].triangles.resize(frames[0].triangles.size() - 500);  // a hole
  const RigSettings settings = QuickSettings();
  Registrar registrar(SmallSpace(), {}, settings.registration);
  RegistrationLog log(folder / "log", "key");
  EXPECT_THAT([&] { RigMeshes(frames, registrar, settings, log); },
              testing::ThrowsMessage<DataError>(
                  testing::AllOf(HasSubstr("frame 0"), HasSubstr("one closed surface"),
                                 HasSubstr("\"surface\": \"model\""))));
  EXPECT_FALSE(std::filesystem::exists(folder / "log"));
}

TEST(Rig, MeshesOfAnyKindTakeTheModelsSurface) {
  std::vector<TriangleMesh> frames = Moving(2);
  frames[1].triangles.resize(frames[1].triangles.size() - 500);  // a hole
  RigSettings settings = QuickSettings();
  Registrar registrar(SmallSpace(), {}, settings.registration);
  RegistrationLog log;
  EXPECT_THAT([&] { RigMeshes(frames, registrar, settings, log); },
              testing::ThrowsMessage<DataError>(HasSubstr("frame 1: expected")));
  settings.surface = RigSurface::kModel;
  const Rig rig = RigMeshes(frames, registrar, settings, log);
  EXPECT_FALSE(rig.cost.has_value());
  EXPECT_LT(rig.registrations[1].distance.target_to_body_m, 0.01);
  EXPECT_NO_THROW(CheckBodyModel(rig.subject, "subject"));
}

}  // namespace
}  // namespace vitruvia
