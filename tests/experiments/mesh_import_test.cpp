// A sequence taken apart into mesh files and imported again: the same sequence.
#include "importers/mesh_import.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "experiments/command_line.h"
#include "geometry/mesh_io.h"
#include "math/rigid.h"
#include "sequence/sequence.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kImportedFrames = 4;

class MeshImport : public testing::Test {
 protected:
  MeshImport() {
    Json scene = ReadJsonFile(files_ / "scene.json");
    scene["frames"] = kImportedFrames;
    files_.Write("scene.json", scene);
    EXPECT_EQ(
        CallVitruvia({"synth", files_.File("scene.json"), "-o", files_.File("original")}).code, 0);
    original_.emplace(files_ / "original");
    fs::create_directory(files_ / "meshes");
    config_ = {{"meshes", "meshes"},
               {"subject", "original/subject"},
               {"rest", "rest.ply"},
               {"frame", "camera"},
               {"view", {{"camera", scene.at("view").at("camera")}}},
               {"fps", scene.at("fps")}};
    WriteMesh(files_ / "rest.ply", original_->true_rest_mesh());
  }

  // One file for each frame, its vertices as `change` makes them of the true ones.
  void WriteFrames(const std::string& extension,
                   const std::function<Vector3f(const Vector3f&)>& change) const {
    for (int i = 0; i < kImportedFrames; ++i) {
      TriangleMesh mesh{original_->ReadTrueVertices(i), original_->true_rest_mesh().triangles};
      for (Vector3f& v : mesh.vertices) v = change(v);
      WriteMesh(files_ / fmt::format("meshes/{:03}{}", i, extension), mesh);
    }
  }

  CallResult Import() const {
    files_.Write("import.json", config_);
    return CallVitruvia(
        {"import", "meshes", files_.File("import.json"), "-o", files_.File("imported")});
  }

  void ExpectImported(double within_m) const {
    const CallResult call = Import();
    ASSERT_EQ(call.code, 0) << call.error;
    VerifySequence(files_ / "imported");
    const SequenceReader imported(files_ / "imported");
    ASSERT_EQ(imported.info().frames, kImportedFrames);
    EXPECT_EQ(imported.info().joints, original_->info().joints);
    for (int i = 0; i < kImportedFrames; ++i) ExpectFrame(imported, i, within_m);
  }

  void ExpectFrame(const SequenceReader& imported, int i, double within_m) const {
    const std::vector<Vector3f> vertices = imported.ReadTrueVertices(i);
    const std::vector<Vector3f> expected = original_->ReadTrueVertices(i);
    ASSERT_EQ(vertices.size(), expected.size());
    for (std::size_t v = 0; v < vertices.size(); ++v)
      ASSERT_NEAR((vertices[v] - expected[v]).norm(), 0.0, within_m);
    const JointTruth& joints = imported.true_joints(i);
    for (std::size_t j = 0; j < joints.positions.size(); ++j) {
      EXPECT_NEAR((joints.positions[j] - original_->true_joints(i).positions[j]).norm(), 0.0, 0.01)
          << imported.info().joints[j];
    }
    EXPECT_EQ(joints.visible, original_->true_joints(i).visible);
    ExpectDepth(imported.ReadDepth(i), original_->ReadDepth(i));
  }

  // Two renderers: they may differ on a silhouette, and by the last millimetre elsewhere.
  static void ExpectDepth(const DepthImage& imported, const DepthImage& original) {
    int seen = 0, differ = 0;
    for (std::size_t p = 0; p < original.pixels().size(); ++p) {
      if (original.pixels()[p] == 0.0f) continue;
      ++seen;
      differ += std::abs(imported.pixels()[p] - original.pixels()[p]) > 0.0021f ? 1 : 0;
    }
    EXPECT_GT(seen, 1000);
    EXPECT_LT(differ, seen / 50);
  }

  SmallExperiment files_;
  std::optional<SequenceReader> original_;
  Json config_;
};

TEST_F(MeshImport, ObjFilesOfTheCameraFrameGiveTheSameSequence) {
  WriteFrames(".obj", [](const Vector3f& v) { return v; });
  ExpectImported(1e-5);
}

TEST_F(MeshImport, PlyFilesOfTheSubjectFrameInMillimetresGiveTheSameSequence) {
  const auto scene = ReadSettingsFile<SceneSettings>(files_ / "scene.json");
  const Rigidf subject_from_camera = Inverse(CameraFromSubject(scene.view)).Cast<float>();
  WriteFrames(".ply",
              [&](const Vector3f& v) -> Vector3f { return 1000.0f * (subject_from_camera * v); });
  TriangleMesh rest = original_->true_rest_mesh();
  for (Vector3f& v : rest.vertices) v *= 1000.0f;
  WriteMesh(files_ / "rest.ply", rest);
  config_["frame"] = "subject";
  config_["unit_m"] = 0.001;
  config_["view"] = WriteSettings(scene.view);
  ExpectImported(1e-5);
}

TEST_F(MeshImport, DamagedAndForeignMeshesAreNamedAndNothingIsWritten) {
  const auto refused = [this](ExitCode code, const std::string& words) {
    const CallResult call = Import();
    EXPECT_EQ(call.code, static_cast<int>(code));
    EXPECT_THAT(call.error, HasSubstr(words));
    EXPECT_FALSE(fs::exists(files_ / "imported"));
  };
  refused(ExitCode::kBadData, "expected a folder of .obj, .ply or .off files, found none");
  WriteFrames(".obj", [](const Vector3f& v) { return v; });
  config_["unit_m"] = -1;
  refused(ExitCode::kBadConfiguration, "import.json: unit_m: expected a number in");
  config_["unit_m"] = 1;
  config_["frame"] = "world";
  refused(ExitCode::kBadConfiguration, "import.json: frame: expected one of");
  config_["frame"] = "subject";
  refused(ExitCode::kBadData, "000.obj: a vertex is");
  config_["frame"] = "camera";
  TriangleMesh other{original_->ReadTrueVertices(2), original_->true_rest_mesh().triangles};
  std::swap(other.triangles[0], other.triangles[1]);
  WriteMesh(files_ / "meshes/002.obj", other);
  refused(ExitCode::kBadData, "(other triangles)");
  WriteWholeFile(files_ / "meshes/002.obj", "v 1 2\nf 1 2 3\n");
  refused(ExitCode::kBadData, "002.obj");
  ExpectRefusal({"import"}, ExitCode::kBadConfiguration, {"subcommand"});
}

// Frames 8, 9, 10 and 11 with extensions in any case, beside the rest mesh and a hidden file.
TEST_F(MeshImport, FramesAreInTheOrderOfTheirNumbersAndTheRestMeshIsNone) {
  WriteFrames(".obj", [](const Vector3f& v) { return v; });
  const char* const kNames[] = {"f_8.obj", "f_9.OBJ", "f_10.obj", "f_11.Obj"};
  for (int i = 0; i < kImportedFrames; ++i)
    fs::rename(files_ / fmt::format("meshes/{:03}.obj", i),
               files_ / (std::string("meshes/") + kNames[i]));
  fs::rename(files_ / "rest.ply", files_ / "meshes/rest.ply");
  WriteWholeFile(files_ / "meshes/._f_8.obj", "not a mesh");
  config_["rest"] = "meshes/rest.ply";
  ExpectImported(1e-5);
  EXPECT_FALSE(SequenceReader(files_ / "imported").info().provenance.contains("warnings"));
}

TEST_F(MeshImport, OtherMeshesAmongTheFramesAreRefusedAndGapsAreTold) {
  WriteFrames(".obj", [](const Vector3f& v) { return v; });
  fs::copy_file(files_ / "meshes/000.obj", files_ / "meshes/template.obj");
  EXPECT_THAT(Import().error, HasSubstr("cannot tell which files are frames: expected names that "
                                        "differ only in their numbers, got 4 like 000.obj, 1 like "
                                        "template.obj"));
  fs::rename(files_ / "meshes/template.obj", files_ / "meshes/1.obj");
  EXPECT_THAT(Import().error, HasSubstr("has the same number as"));
  fs::rename(files_ / "meshes/1.obj", files_ / "meshes/007.obj");
  const CallResult call = Import();
  EXPECT_EQ(call.code, 0) << call.error;
  EXPECT_THAT(call.error, HasSubstr("the first from 003.obj to 007.obj (3 frames are missing)"));
  const Json provenance = SequenceReader(files_ / "imported").info().provenance;
  EXPECT_THAT(provenance.at("warnings").dump(), HasSubstr("3 frames are missing"));
}

TEST_F(MeshImport, ARestMeshThatIsNotTheSubjectIsRefusedBeforeTheFirstFrame) {
  WriteFrames(".obj", [](const Vector3f& v) { return v; });
  TriangleMesh moved = original_->true_rest_mesh();
  for (Vector3f& v : moved.vertices) v.x() += 1.0f;
  WriteMesh(files_ / "rest.ply", moved);
  EXPECT_THAT(Import().error, HasSubstr("rest.ply: the rest mesh is not where the subject is"));
  for (Vector3f& v : moved.vertices) v = 1000.0f * (v - Vector3f::UnitX());
  WriteMesh(files_ / "rest.ply", moved);
  const CallResult call = Import();
  EXPECT_EQ(call.code, static_cast<int>(ExitCode::kBadData));
  EXPECT_THAT(call.error, HasSubstr("rest.ply: the rest mesh is 1000 times too large"));
  EXPECT_FALSE(fs::exists(files_ / "imported"));
}

TEST_F(MeshImport, ABodyOutOfTheImageIsTold) {
  WriteFrames(".obj", [](const Vector3f& v) -> Vector3f { return v + Vector3f(0.0f, 1.0f, 0.0f); });
  const CallResult call = Import();
  EXPECT_EQ(call.code, 0) << call.error;
  EXPECT_THAT(call.error, HasSubstr("the body leaves the image in 4 of 4 frames"));
  const Json provenance = SequenceReader(files_ / "imported").info().provenance;
  EXPECT_THAT(provenance.at("warnings").dump(), HasSubstr("the body leaves the image"));
}

TEST_F(MeshImport, DepthThatDoesNotFitIsRefused) {
  WriteFrames(".obj", [](const Vector3f& v) { return v; });
  config_["sensor"] = {{"depth_unit_m", 1e-5}};
  const CallResult call = Import();
  EXPECT_EQ(call.code, static_cast<int>(ExitCode::kBadData));
  EXPECT_THAT(call.error, HasSubstr("imported: depth of frame 0: "));
  EXPECT_THAT(call.error, HasSubstr("do not fit 16 bits"));
  EXPECT_FALSE(fs::exists(files_ / "imported"));
}

// Without a rest pose nothing corresponds: each frame keeps its own triangles.
TEST_F(MeshImport, MeshesWithoutARestPoseAreSurfacesOfTheirOwn) {
  WriteFrames(".ply", [](const Vector3f& v) { return v; });
  TriangleMesh other{original_->ReadTrueVertices(2), original_->true_rest_mesh().triangles};
  std::reverse(other.triangles.begin(), other.triangles.end());
  other.triangles.pop_back();
  WriteMesh(files_ / "meshes/002.ply", other);
  config_.erase("rest");
  config_.erase("subject");
  const CallResult call = Import();
  ASSERT_EQ(call.code, 0) << call.error;
  VerifySequence(files_ / "imported");
  const SequenceReader imported(files_ / "imported");
  EXPECT_FALSE(imported.info().surface);
  EXPECT_TRUE(imported.info().own_surfaces);
  EXPECT_TRUE(imported.info().joints.empty());
  EXPECT_EQ(imported.ReadTrueSurface(2).triangles, other.triangles);
  ExpectDepth(imported.ReadDepth(1), original_->ReadDepth(1));
  config_["rest"] = "rest.ply";
  files_.Write("import.json", config_);
  ExpectRefusal({"import", "meshes", files_.File("import.json"), "-o", files_.File("never")},
                ExitCode::kBadConfiguration, {"rest", "`subject` names none"});
}

TEST_F(MeshImport, SurfacesOfTheirOwnThatFaceInwardsAreRefused) {
  WriteFrames(".ply", [](const Vector3f& v) { return v; });
  TriangleMesh inward{original_->ReadTrueVertices(2), original_->true_rest_mesh().triangles};
  for (Triangle& triangle : inward.triangles) std::swap(triangle[0], triangle[1]);
  WriteMesh(files_ / "meshes/002.ply", inward);
  config_.erase("rest");
  config_.erase("subject");
  const CallResult call = Import();
  EXPECT_EQ(call.code, static_cast<int>(ExitCode::kBadData));
  EXPECT_THAT(call.error, HasSubstr("002.ply: the triangles face inwards"));
  EXPECT_FALSE(fs::exists(files_ / "imported"));
}

}  // namespace
}  // namespace vitruvia
