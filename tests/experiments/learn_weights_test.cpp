// `vitruvia learn weights` from files to files.
#include <fstream>

#include <gtest/gtest.h>

#include "body/body_model.h"
#include "config/json_settings.h"
#include "core/error.h"
#include "core/files.h"
#include "experiments/cli/commands.h"
#include "geometry/mesh_io.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "support/temporary_folder.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;

constexpr int kPoses = 9;

// A figure of boxes in poses that bend every joint, as a user's files.
class LearnWeights : public testing::Test {
 protected:
  LearnWeights() {
    WriteBodyModel(folder_ / "rig", body_);
    fs::create_directory(folder_ / "meshes");
    const char* const extensions[] = {"ply", "obj", "off"};
    for (int p = 0; p < kPoses; ++p) {
      JointPose pose = JointPose::Rest(body_.skeleton);
      for (int b = 0; b < kBoneCount; ++b) {
        const Vector3<double> turn(0.4 * ((p + b) % 3 - 1), 0.3 * ((p * b) % 3 - 1),
                                   0.5 * ((p + 2 * b) % 4 - 1.5));
        pose.local_rotations[b] = ExpSo3<double>(turn);
      }
      TriangleMesh mesh = body_.rest;
      SkinLinear(body_.rest.vertices, body_.weights, ForwardKinematics(body_.skeleton, pose),
                 mesh.vertices);
      WriteMesh(folder_ / fmt::format("meshes/{}.{}", p, extensions[p % 3]), mesh);
    }
  }

  std::string File(const std::string& name) const { return (folder_ / name).string(); }

  // `vitruvia learn weights meshes … -o out`; returns the exit code.
  int Learn(const std::vector<std::string>& more, const std::string& meshes = "meshes") {
    std::vector<std::string> words = {"vitruvia", "learn", "weights", File(meshes)};
    words.insert(words.end(), more.begin(), more.end());
    words.insert(words.end(), {"-o", File("out")});
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = RunCommandLine(static_cast<int>(argv.size()), argv.data());
    output_ = testing::internal::GetCapturedStdout();
    error_ = testing::internal::GetCapturedStderr();
    return code;
  }

  void ExpectRefusal(ExitCode code, const std::string& words, const std::vector<std::string>& more,
                     const std::string& meshes = "meshes") {
    EXPECT_EQ(Learn(more, meshes), static_cast<int>(code));
    EXPECT_NE(error_.find(words), std::string::npos) << error_;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }

  TemporaryFolder folder_;
  BodyModel body_ = TinyBody(2);
  std::string output_, error_;
};

TEST_F(LearnWeights, GivesABodyThatExplainsTheMeshes) {
  ASSERT_EQ(Learn({"--rig", File("rig")}), 0) << error_;
  EXPECT_NE(output_.find("alternation"), std::string::npos);
  const BodyModel learnt = ReadBodyModel(folder_ / "out");
  EXPECT_EQ(learnt.rest.triangles, body_.rest.triangles);
  EXPECT_EQ(learnt.skeleton.joints, body_.skeleton.joints);
  const Json record = ReadJsonFile(folder_ / "out" / "learning.json");
  EXPECT_LT(record["rmse_m"].get<double>(), 1e-6);
  EXPECT_EQ(record["poses"].size(), static_cast<std::size_t>(kPoses));
  EXPECT_EQ(record["poses"][1]["mesh"], "1.obj");
  EXPECT_EQ(record["poses"][0]["posed_from_rest"].size(), static_cast<std::size_t>(kBoneCount));
}

TEST_F(LearnWeights, StartsFromLabelsAsWell) {
  std::string labels;
  for (const auto& bones : body_.weights.bones) labels += std::to_string(bones[0]) + "\n";
  WriteWholeFile(folder_ / "labels.txt", labels);
  WriteMesh(folder_ / "rest.ply", body_.rest);
  ASSERT_EQ(Learn({"--rest", File("rest.ply"), "--labels", File("labels.txt")}), 0) << error_;
  EXPECT_EQ(ReadWholeFile(folder_ / "out" / "labels.txt"), labels);
  EXPECT_EQ(WeightsProblem(ReadWeights(folder_ / "out" / "weights.bin", body_.rest.vertices.size()),
                           body_.rest.vertices.size(), kBoneCount),
            "");
  EXPECT_LT(ReadJsonFile(folder_ / "out" / "learning.json")["rmse_m"].get<double>(), 1e-6);
}

TEST_F(LearnWeights, RefusesToGuessWhatToStartFrom) {
  ExpectRefusal(ExitCode::kBadConfiguration, "one of --rig, --labels and --bones", {});
  ExpectRefusal(ExitCode::kBadConfiguration, "one of --rig, --labels and --bones",
                {"--rig", File("rig"), "--bones", "3"});
  ExpectRefusal(ExitCode::kBadConfiguration, "expected --rest", {"--bones", "3"});
}

TEST_F(LearnWeights, RefusesMeshesThatDoNotBelongTogether) {
  const std::vector<std::string> rig = {"--rig", File("rig")};
  ExpectRefusal(ExitCode::kBadData, "none: no such folder", rig, "none");
  WriteWholeFile(folder_ / "meshes" / "notes.txt", "about these meshes");
  ExpectRefusal(ExitCode::kBadData, "notes.txt: expected only PLY, OBJ and OFF files", rig);
  fs::remove(folder_ / "meshes" / "notes.txt");

  TriangleMesh other = body_.rest;
  std::swap(other.triangles[4][0], other.triangles[4][1]);
  WriteMesh(folder_ / "meshes" / "other.ply", other);
  ExpectRefusal(ExitCode::kBadData, "other.ply: triangle 4 is", rig);
  WriteMesh(folder_ / "meshes" / "other.ply", TinyBody(1).rest);
  ExpectRefusal(ExitCode::kBadData,
                "other.ply: " + std::to_string(TinyBody(1).rest.vertices.size()), rig);

  fs::create_directory(folder_ / "one");
  WriteMesh(folder_ / "one" / "0.ply", body_.rest);
  ExpectRefusal(ExitCode::kBadData, "1 meshes beside the rest mesh, expected 2 or more", rig,
                "one");
}

TEST_F(LearnWeights, RefusesLabelsThatAreNone) {
  WriteMesh(folder_ / "rest.ply", body_.rest);
  const std::vector<std::string> start = {"--rest", File("rest.ply"), "--labels",
                                          File("labels.txt")};
  WriteWholeFile(folder_ / "labels.txt", "0 1 head");
  ExpectRefusal(ExitCode::kBadData, "label 2: expected a bone's number from 0 to 255, got \"head\"",
                start);
  WriteWholeFile(folder_ / "labels.txt", "0 1 2");
  ExpectRefusal(ExitCode::kBadData, "3 labels, the rest mesh has", start);
}

}  // namespace
}  // namespace vitruvia
