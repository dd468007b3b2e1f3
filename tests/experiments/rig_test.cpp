// `vitruvia rig` and `vitruvia subject`, from files to a subject.
#include <gtest/gtest.h>

#include "body/anatomical_pose.h"
#include "body/body_model.h"
#include "core/files.h"
#include "experiments/command_line.h"
#include "geometry/mesh_io.h"
#include "learning/shape/shape_space.h"
#include "math/rigid.h"
#include "synth/population/make_database.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;

// A shape space of mannequins and one of them with raised forearms, as a user's files.
class RigCommand : public testing::Test {
 protected:
  RigCommand() {
    DatabaseSettings settings;
    settings.population.subjects = 10;
    settings.mesh.subdivisions = 2;
    settings.subjects_with_poses = 0;
    const BodyDatabase database = MakeDatabase(settings);
    WriteShapeSpace(folder_ / "space",
                    LearnShapeSpace(database, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {.components = 4}));
    WriteMesh(folder_ / "person.ply", WithRaisedForearms(database));
    WriteWholeFile(folder_ / "quick.json",
                   R"({"registration": {"components": 4, "headings": 2, "coarse_vertices": 300,
                       "fine_vertices": 800, "surface_points": 4000, "clothing": "none"}})");
  }

  static TriangleMesh WithRaisedForearms(const BodyDatabase& database) {
    const DatabaseSubject& person = database.subjects[1];
    AnatomicalPose angles;
    for (auto& side : angles.sides_deg) side = {10, 15, 0, 80, 0, 0, 0, 0, 5, 0, 0, 0, 0};
    JointPose pose = JointPose::Rest(person.skeleton);
    SetRotations(angles, pose);
    TriangleMesh mesh = database.reference.rest;
    SkinLinear(person.vertices, database.reference.weights,
               ForwardKinematics(person.skeleton, pose), mesh.vertices);
    return mesh;
  }

  std::string File(const std::string& name) const { return (folder_ / name).string(); }

  TemporaryFolder folder_;
};

TEST_F(RigCommand, MakesASubjectOfAMeshInAnyPose) {
  const CallResult call = CallVitruvia({"rig", File("person.ply"), "--space", File("space"),
                                        "--settings", File("quick.json"), "-o", File("subject")});
  ASSERT_EQ(call.code, 0) << call.error;
  EXPECT_NE(call.out.find("RMSE over all vertices"), std::string::npos);
  const BodyModel subject = ReadBodyModel(folder_ / "subject");
  EXPECT_GT(BoundingBox(subject.rest.vertices).sizes().x(), 1.4f);  // the arms are spread
  EXPECT_TRUE(fs::exists(folder_ / "subject/rig.png"));
  EXPECT_TRUE(fs::exists(folder_ / "subject/rig.json"));
}

TEST_F(RigCommand, RefusesWhatIsNoPersonAndLeavesNothing) {
  TriangleMesh person = ReadMesh(folder_ / "person.ply");
  for (Vector3f& v : person.vertices) v *= 1000.0f;
  WriteMesh(folder_ / "in_mm.ply", person);
  ExpectRefusal({"rig", File("in_mm.ply"), "--space", File("space"), "--settings",
                 File("quick.json"), "-o", File("subject")},
                ExitCode::kBadData, {"no person", "in metres?"});
  EXPECT_FALSE(fs::exists(folder_ / "subject"));
}

TEST_F(RigCommand, MakesASubjectOfAHeight) {
  const CallResult call =
      CallVitruvia({"subject", "--space", File("space"), "--height", "1.0", "-o", File("child")});
  ASSERT_EQ(call.code, 0) << call.error;
  EXPECT_NEAR(ReadBodyModel(folder_ / "child").attributes.height_m, 1.0, 1e-3);
  ExpectRefusal({"subject", "--space", File("space"), "-o", File("nobody")},
                ExitCode::kBadConfiguration, {"expected --height"});
}

TEST_F(RigCommand, MakesASubjectOfFramesWithTheGivenHeight) {
  ASSERT_EQ(
      CallVitruvia({"synth", (kConfigs / "scenes/small.json").string(), "-o", File("scene")}).code,
      0);
  const auto settings = [&](double least_explained) {
    WriteWholeFile(folder_ / "seen.json", Json({{"frames", 2},
                                                {"registration",
                                                 {{"components", 4},
                                                  {"headings", 4},
                                                  {"coarse_vertices", 300},
                                                  {"fine_vertices", 800},
                                                  {"least_explained", least_explained}}}})
                                              .dump());
  };
  const std::vector<std::string> command{"subject",         "--space",  File("space"), "--sequence",
                                         File("scene"),     "--height", "1.81",        "--settings",
                                         File("seen.json"), "-o",       File("seen")};
  settings(1.0);
  ExpectRefusal(command, ExitCode::kBadData, {"scene: frame 0: no person"});
  EXPECT_FALSE(fs::exists(folder_ / "seen"));
  settings(0.8);
  const CallResult call = CallVitruvia(command);
  ASSERT_EQ(call.code, 0) << call.error;
  EXPECT_NEAR(ReadBodyModel(folder_ / "seen").attributes.height_m, 1.81, 0.003);
  EXPECT_TRUE(fs::exists(folder_ / "seen/registration.png"));
}

}  // namespace
}  // namespace vitruvia
