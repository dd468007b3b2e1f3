#include "experiments/studies/weight_examples.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "core/error.h"
#include "core/files.h"
#include "geometry/mesh_io.h"
#include "math/rigid.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kWeightsFile = "weights.bin";
constexpr std::size_t kFewestPoses = 2;  // weights and transforms cannot be told apart in one
constexpr int kMostBones = 256;          // of weights.bin

// The meshes of a folder in ascending order of their names, the rest mesh left out.
std::vector<fs::path> MeshFiles(const fs::path& folder, const fs::path& rest) {
  if (!fs::is_directory(folder)) throw DataError(folder.string() + ": no such folder");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    if (file.filename().string().starts_with(".")) continue;
    if (!IsMeshFile(file)) {
      throw DataError(
          fmt::format("{}: expected only PLY, OBJ and OFF files in this folder", file.string()));
    }
    std::error_code ignored;
    if (!rest.empty() && fs::equivalent(file, rest, ignored)) continue;
    files.push_back(file);
  }
  if (files.size() < kFewestPoses) {
    throw DataError(fmt::format("{}: {} meshes beside the rest mesh, expected {} or more",
                                folder.string(), files.size(), kFewestPoses));
  }
  std::sort(files.begin(), files.end());
  return files;
}

void CheckTopology(const TriangleMesh& mesh, const fs::path& file, const TriangleMesh& rest) {
  if (mesh.vertices.size() != rest.vertices.size() ||
      mesh.triangles.size() != rest.triangles.size()) {
    throw DataError(fmt::format("{}: {} vertices and {} triangles, the rest mesh has {} and {}",
                                file.string(), mesh.vertices.size(), mesh.triangles.size(),
                                rest.vertices.size(), rest.triangles.size()));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangles[t] == rest.triangles[t]) continue;
    throw DataError(fmt::format("{}: triangle {} is {}, in the rest mesh {}", file.string(), t,
                                fmt::join(mesh.triangles[t], " "),
                                fmt::join(rest.triangles[t], " ")));
  }
}

skinning::Labels ReadLabels(const fs::path& file, std::size_t vertex_count) {
  std::istringstream words(ReadWholeFile(file));
  skinning::Labels labels;
  for (std::string word; words >> word;) {
    int label = -1;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), label);
    if (error != std::errc() || end != word.data() + word.size() || label < 0 ||
        label >= kMostBones) {
      throw DataError(fmt::format("{}: label {}: expected a bone's number from 0 to {}, got \"{}\"",
                                  file.string(), labels.size(), kMostBones - 1, word));
    }
    labels.push_back(static_cast<std::uint8_t>(label));
  }
  if (labels.size() != vertex_count) {
    throw DataError(fmt::format("{}: {} labels, the rest mesh has {} vertices", file.string(),
                                labels.size(), vertex_count));
  }
  return labels;
}

void ReadStart(const WeightExampleFiles& files, WeightExamples& examples) {
  if (!files.rig.empty()) {
    examples.labels = skinning::HeaviestBones(examples.rig->weights);
    examples.bone_count = kBoneCount;
  } else if (!files.labels.empty()) {
    examples.labels = ReadLabels(files.labels, examples.rest.vertices.size());
    examples.bone_count = 1 + *std::max_element(examples.labels.begin(), examples.labels.end());
  } else {
    examples.bone_count = files.bones;
  }
}

Json ToJson(const BoneTransforms& bones) {
  Json list = Json::array();
  for (const Rigidd& bone : bones) {
    const Matrix3<double> by_rows = bone.rotation.transpose();
    list.push_back({{"rotation", std::vector<double>(by_rows.data(), by_rows.data() + 9)},
                    {"translation_m",
                     std::vector<double>(bone.translation.data(), bone.translation.data() + 3)}});
  }
  return list;
}

Json LearningRecord(const WeightExamples& examples, const skinning::Settings& settings,
                    const skinning::Decomposition& result) {
  Json alternations = Json::array(), poses = Json::array();
  for (const skinning::Alternation& alternation : result.alternations) {
    alternations.push_back({{"rmse_m", alternation.rmse_m}, {"time_ms", alternation.time_ms}});
  }
  for (std::size_t p = 0; p < result.poses.size(); ++p) {
    poses.push_back({{"mesh", examples.names[p]}, {"posed_from_rest", ToJson(result.poses[p])}});
  }
  return {{"settings", WriteSettings(settings)},
          {"bones", examples.bone_count},
          {"start_rmse_m", result.start_rmse_m},
          {"rmse_m", result.rmse_m},
          {"ending", skinning::Name(result.ending)},
          {"alternations", alternations},
          {"poses", poses}};
}

std::string LabelsText(const skinning::Labels& labels) {
  return fmt::format("{}\n", fmt::join(labels, "\n"));
}

}  // namespace

WeightExamples ReadWeightExamples(const WeightExampleFiles& files) {
  const int starts = !files.rig.empty() + !files.labels.empty() + (files.bones != 0);
  if (starts != 1) {
    throw ConfigError(
        "learn weights: expected one of --rig, --labels and --bones to say what to start from");
  }
  if (files.rig.empty() && files.rest.empty()) {
    throw ConfigError("learn weights: expected --rest, since there is no --rig with a rest mesh");
  }
  WeightExamples examples;
  if (!files.rig.empty()) {
    examples.rig = ReadBodyModel(files.rig);
    examples.rest = examples.rig->rest;
  }
  if (!files.rest.empty()) {
    examples.rest = ReadMesh(files.rest);
    if (examples.rig) CheckTopology(examples.rest, files.rest, examples.rig->rest);
  }
  for (const fs::path& file : MeshFiles(files.meshes, files.rest)) {
    TriangleMesh mesh = ReadMesh(file);
    CheckTopology(mesh, file, examples.rest);
    examples.names.push_back(file.filename().string());
    examples.poses.push_back(std::move(mesh.vertices));
  }
  ReadStart(files, examples);
  return examples;
}

void WriteLearntWeights(const fs::path& folder, const WeightExamples& examples,
                        const skinning::Settings& settings, const skinning::Decomposition& result) {
  StagedFolder staged(folder, kWeightsFile);
  if (examples.rig) {
    BodyModel body = *examples.rig;
    body.rest = examples.rest;
    body.weights = result.weights;
    WriteBodyModel(staged.path(), body);
  } else {
    WriteWeights(staged.path() / kWeightsFile, result.weights);
    WriteWholeFile(staged.path() / "labels.txt", LabelsText(examples.labels));
    WriteMesh(staged.path() / "rest.ply", examples.rest);
  }
  WriteWholeFile(staged.path() / "learning.json",
                 LearningRecord(examples, settings, result).dump(1) + "\n");
  staged.Commit();
}

}  // namespace vitruvia
