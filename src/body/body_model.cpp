#include "body/body_model.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "config/stored_data.h"
#include "core/error.h"
#include "core/files.h"
#include "geometry/mesh_io.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kMeshFile = "mesh.ply";
constexpr const char* kSubjectFile = "subject.json";
constexpr const char* kWeightsFile = "weights.bin";

constexpr int kSubjectVersion = 1;

// One influence as weights.bin holds it.
constexpr std::size_t kInfluenceBytes = 8;
constexpr std::size_t kWeightOffset = 4;  // after the bone and 3 bytes of padding
constexpr std::size_t kVertexBytes = kMaxInfluences * kInfluenceBytes;
static_assert(std::endian::native == std::endian::little, "weights.bin is copied as it lies");

// subject.json. It has no format key: its content is part of the hashes of stored sequences.
struct BoneFile {
  std::string name;
  std::array<double, 3> joint{}, tip{};

  void Describe(Fields& f) {
    f.Text("name", name, {.meaning = "name of the bone"});
    f.Numbers("joint", joint, {.meaning = "proximal end of the bone, subject frame", .unit = "m"});
    f.Numbers("tip", tip, {.meaning = "distal end of the bone, subject frame", .unit = "m"});
  }
};

struct SubjectFile {
  int version = kSubjectVersion;
  std::string name;
  BodyAttributes attributes;
  std::vector<BoneFile> bones;

  void Describe(Fields& f) {
    f.Integer("version", version,
              {
                  .meaning = "version of this format",
                  .min = kSubjectVersion,
                  .max = kSubjectVersion,
              });
    f.Text("name", name, {.meaning = "name of the body"});
    f.Number("height_m", attributes.height_m,
             {.meaning = "height of the person", .unit = "m", .min = 0.0, .max = 3.0});
    f.Number("weight_kg", attributes.weight_kg,
             {.meaning = "weight of the person", .unit = "kg", .min = 0.0, .max = 500.0});
    f.Choice("sex", attributes.sex, {{"female", Sex::kFemale}, {"male", Sex::kMale}},
             {.meaning = "sex of the person"});
    f.List("bones", bones, {.meaning = "skeleton in the rest pose"});
  }
};

Skeleton ToSkeleton(const std::vector<BoneFile>& bones, const std::string& where) {
  if (bones.size() != kBoneCount) {
    throw DataError(fmt::format("{}: {} bones, expected {}", where, bones.size(), kBoneCount));
  }
  Skeleton skeleton;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    if (bones[b].name != Bones()[b].name) {
      throw DataError(fmt::format("{}: bone {} is '{}', expected '{}'", where, b, bones[b].name,
                                  Bones()[b].name));
    }
    skeleton.joints[b] = Vector3<double>(bones[b].joint.data());
    skeleton.tips[b] = Vector3<double>(bones[b].tip.data());
  }
  return skeleton;
}

std::vector<BoneFile> ToBoneFiles(const Skeleton& skeleton) {
  std::vector<BoneFile> bones(kBoneCount);
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const Vector3<double>&joint = skeleton.joints[b], &tip = skeleton.tips[b];
    bones[b] = {std::string(Bones()[b].name),
                {joint.x(), joint.y(), joint.z()},
                {tip.x(), tip.y(), tip.z()}};
  }
  return bones;
}

std::string SkeletonProblem(const Skeleton& skeleton) {
  for (int b = 0; b < kBoneCount; ++b) {
    if (!skeleton.joints[b].allFinite()) {
      return fmt::format("joint '{}' is not finite", Bones()[b].joint);
    }
    if (!skeleton.tips[b].allFinite()) {
      return fmt::format("the tip of bone '{}' is not finite", Bones()[b].name);
    }
  }
  return "";
}

std::string AttributesProblem(const BodyAttributes& attributes) {
  if (!(attributes.height_m > 0.0) || !std::isfinite(attributes.height_m)) {
    return fmt::format("height of {} m, expected more than 0", attributes.height_m);
  }
  if (!(attributes.weight_kg > 0.0) || !std::isfinite(attributes.weight_kg)) {
    return fmt::format("weight of {} kg, expected more than 0", attributes.weight_kg);
  }
  return "";
}

std::string SurfaceProblem(const TriangleMesh& mesh) {
  const std::string problem = InspectMesh(mesh).problem;
  if (!problem.empty()) return "mesh: " + problem;
  const double volume_m3 = EnclosedVolume(mesh);
  if (!(volume_m3 > 0.0)) {
    return fmt::format("mesh: encloses {} m³: its triangles face inwards", volume_m3);
  }
  return "";
}

}  // namespace

SkinWeights ReadWeights(const fs::path& file, std::size_t vertex_count) {
  const std::string bytes = ReadWholeFile(file);
  if (bytes.size() != vertex_count * kVertexBytes) {
    throw DataError(fmt::format("{}: {} bytes, expected {} for {} vertices", file.string(),
                                bytes.size(), vertex_count * kVertexBytes, vertex_count));
  }
  SkinWeights weights;
  weights.bones.resize(vertex_count);
  weights.weights.resize(vertex_count);
  const char* at = bytes.data();
  for (std::size_t v = 0; v < vertex_count; ++v) {
    for (int k = 0; k < kMaxInfluences; ++k, at += kInfluenceBytes) {
      weights.bones[v][k] = static_cast<std::uint8_t>(*at);
      std::memcpy(&weights.weights[v][k], at + kWeightOffset, sizeof(float));
    }
  }
  return weights;
}

void WriteWeights(const fs::path& file, const SkinWeights& weights) {
  std::string bytes(weights.size() * kVertexBytes, '\0');
  char* at = bytes.data();
  for (std::size_t v = 0; v < weights.size(); ++v) {
    for (int k = 0; k < kMaxInfluences; ++k, at += kInfluenceBytes) {
      *at = static_cast<char>(weights.bones[v][k]);
      std::memcpy(at + kWeightOffset, &weights.weights[v][k], sizeof(float));
    }
  }
  WriteWholeFile(file, bytes);
}

void CheckBodyModel(const BodyModel& body, const std::string& where) {
  for (const std::string& problem :
       {SurfaceProblem(body.rest),
        WeightsProblem(body.weights, body.rest.vertices.size(), kBoneCount),
        SkeletonProblem(body.skeleton), AttributesProblem(body.attributes)}) {
    if (!problem.empty()) throw DataError(fmt::format("{}: {}", where, problem));
  }
}

BodyModel ReadBodyModel(const fs::path& folder) {
  const SubjectFile subject = ReadStoredObject<SubjectFile>(folder / kSubjectFile);
  BodyModel body;
  body.name = subject.name;
  body.attributes = subject.attributes;
  body.skeleton = ToSkeleton(subject.bones, (folder / kSubjectFile).string());
  body.rest = ReadMesh(folder / kMeshFile);
  body.weights = ReadWeights(folder / kWeightsFile, body.rest.vertices.size());
  CheckBodyModel(body, folder.string());
  return body;
}

void WriteBodyModel(const fs::path& folder, const BodyModel& body) {
  CheckBodyModel(body, body.name);
  StagedFolder staged(folder, kWeightsFile);
  const SubjectFile subject{kSubjectVersion, body.name, body.attributes,
                            ToBoneFiles(body.skeleton)};
  WriteWholeFile(staged.path() / kSubjectFile, StoredJson(subject).dump(2) + "\n");
  WriteMesh(staged.path() / kMeshFile, body.rest);
  WriteWeights(staged.path() / kWeightsFile, body.weights);
  staged.Commit();
}

}  // namespace vitruvia
