#include "learning/shape/body_database.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <set>
#include <span>

#include "config/stored_data.h"
#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kDatabaseFile = "database.json";
constexpr const char* kVerticesFile = "vertices.bin";
constexpr const char* kReferenceFolder = "reference";
constexpr const char* kPosesFolder = "poses";

static_assert(std::endian::native == std::endian::little, "vertices are copied as they lie");
static_assert(sizeof(Vector3f) == 3 * sizeof(float));

std::span<double> Flat(std::array<Vector3d, kBoneCount>& points) {
  static_assert(sizeof(points) == 3 * kBoneCount * sizeof(double));
  return {points.front().data(), 3 * kBoneCount};
}

struct SubjectEntry {
  std::string name;
  BodyAttributes attributes;
  Skeleton skeleton;

  void Describe(Fields& f) {
    f.Text("name", name, {.meaning = "name of the subject"});
    f.Number("height_m", attributes.height_m,
             {.meaning = "height of the person", .unit = "m", .min = 0.0, .max = 3.0});
    f.Number("weight_kg", attributes.weight_kg,
             {.meaning = "weight of the person", .unit = "kg", .min = 0.0, .max = 500.0});
    f.Choice("sex", attributes.sex, {{"female", Sex::kFemale}, {"male", Sex::kMale}},
             {.meaning = "sex of the person"});
    f.Numbers("joints_m", Flat(skeleton.joints),
              {.meaning = "proximal ends of the bones, x y z each, subject frame", .unit = "m"});
    f.Numbers("tips_m", Flat(skeleton.tips),
              {.meaning = "distal ends of the bones, x y z each, subject frame", .unit = "m"});
  }
};

struct DatabaseHeader {
  static constexpr StoredFormat kFormat{"vitruvia-database", 1, 1, "make the database again"};

  std::vector<SubjectEntry> subjects;
  Json provenance = Json::object();

  void Describe(Fields& f) {
    f.List("subjects", subjects, {.meaning = "the people, in the order of vertices.bin"});
    f.FreeJson("provenance", provenance,
               {.meaning = "how the database was made", .optional = true});
  }
};

// A file of whole frames of `vertex_count` vertices.
std::vector<std::vector<Vector3f>> ReadVertexFrames(const fs::path& file,
                                                    std::size_t vertex_count) {
  const std::string bytes = ReadWholeFile(file);
  const std::size_t frame_bytes = vertex_count * sizeof(Vector3f);
  if (bytes.empty() || bytes.size() % frame_bytes != 0) {
    throw DataError(fmt::format("{}: {} bytes, expected a multiple of {} for {} vertices",
                                file.string(), bytes.size(), frame_bytes, vertex_count));
  }
  std::vector<std::vector<Vector3f>> frames(bytes.size() / frame_bytes);
  const char* at = bytes.data();
  for (auto& frame : frames) {
    frame.resize(vertex_count);
    std::memcpy(frame.front().data(), at, frame_bytes);
    at += frame_bytes;
  }
  return frames;
}

void Append(const std::vector<Vector3f>& vertices, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(vertices.data()), vertices.size() * sizeof(Vector3f));
}

bool AllFinite(const std::vector<Vector3f>& vertices) {
  return std::all_of(vertices.begin(), vertices.end(),
                     [](const Vector3f& v) { return v.allFinite(); });
}

}  // namespace

std::size_t MostAverage(const std::vector<DatabaseSubject>& subjects) {
  Require(!subjects.empty(), "MostAverage: no subjects");
  const std::size_t vertex_count = subjects.front().vertices.size();
  std::vector<Vector3d> mean(vertex_count, Vector3d::Zero());
  for (const DatabaseSubject& subject : subjects) {
    for (std::size_t v = 0; v < vertex_count; ++v) {
      mean[v] += subject.vertices[v].cast<double>() / static_cast<double>(subjects.size());
    }
  }
  std::vector<double> distance(subjects.size(), 0.0);
  for (std::size_t s = 0; s < subjects.size(); ++s) {
    for (std::size_t v = 0; v < vertex_count; ++v) {
      distance[s] += (subjects[s].vertices[v].cast<double>() - mean[v]).squaredNorm();
    }
  }
  return static_cast<std::size_t>(std::min_element(distance.begin(), distance.end()) -
                                  distance.begin());
}

void CheckBodyDatabase(const BodyDatabase& database, const std::string& where) {
  const auto fail = [&](const std::string& what) { throw DataError(where + ": " + what); };
  CheckBodyModel(database.reference, where + ": reference");
  if (database.subjects.size() < 2) {
    fail(fmt::format("{} subjects, expected at least 2: shapes cannot be told from one person",
                     database.subjects.size()));
  }
  const std::size_t vertex_count = database.reference.rest.vertices.size();
  std::set<std::string> names;
  for (const DatabaseSubject& subject : database.subjects) {
    if (!names.insert(subject.name).second)
      fail(fmt::format("the subject \"{}\" stands twice", subject.name));
    if (subject.vertices.size() != vertex_count) {
      fail(fmt::format("subject \"{}\" has {} vertices, the reference {}: one topology is needed",
                       subject.name, subject.vertices.size(), vertex_count));
    }
    if (!AllFinite(subject.vertices))
      fail(fmt::format("subject \"{}\" has vertices that are not finite", subject.name));
  }
}

void WriteBodyDatabase(const fs::path& folder, const BodyDatabase& database) {
  CheckBodyDatabase(database, folder.string());
  StagedFolder staged(folder, kDatabaseFile);
  DatabaseHeader header;
  header.provenance = database.provenance;
  std::string vertices;
  for (const DatabaseSubject& subject : database.subjects) {
    header.subjects.push_back({subject.name, subject.attributes, subject.skeleton});
    Append(subject.vertices, vertices);
  }
  WriteStored(staged.path() / kDatabaseFile, header, -1);
  WriteWholeFile(staged.path() / kVerticesFile, vertices);
  WriteBodyModel(staged.path() / kReferenceFolder, database.reference);
  if (!database.examples.empty()) MakeFolder(staged.path() / kPosesFolder);
  for (const PoseExamples& examples : database.examples) {
    std::string bytes;
    for (const std::vector<Vector3f>& pose : examples.poses) Append(pose, bytes);
    WriteWholeFile(staged.path() / kPosesFolder / (examples.subject + ".bin"), bytes);
  }
  staged.Commit();
}

BodyDatabase ReadBodyDatabase(const fs::path& folder) {
  const DatabaseHeader header = ReadStored<DatabaseHeader>(folder / kDatabaseFile);
  BodyDatabase database;
  database.provenance = header.provenance;
  database.reference = ReadBodyModel(folder / kReferenceFolder);
  auto vertices = ReadVertexFrames(folder / kVerticesFile, database.reference.rest.vertices.size());
  if (vertices.size() != header.subjects.size()) {
    throw DataError(fmt::format("{}: {} bodies, but {} names {} subjects",
                                (folder / kVerticesFile).string(), vertices.size(), kDatabaseFile,
                                header.subjects.size()));
  }
  for (std::size_t s = 0; s < vertices.size(); ++s) {
    const SubjectEntry& entry = header.subjects[s];
    database.subjects.push_back(
        {entry.name, entry.attributes, entry.skeleton, std::move(vertices[s])});
  }
  CheckBodyDatabase(database, folder.string());
  return database;
}

std::vector<std::string> SubjectsWithExamples(const fs::path& folder) {
  std::vector<std::string> names;
  if (!fs::is_directory(folder / kPosesFolder)) return names;
  for (const auto& entry : fs::directory_iterator(folder / kPosesFolder)) {
    if (entry.path().extension() == ".bin") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

PoseExamples ReadPoseExamples(const fs::path& folder, const std::string& subject) {
  const std::vector<std::string> names = SubjectsWithExamples(folder);
  if (!std::binary_search(names.begin(), names.end(), subject)) {
    throw DataError(fmt::format("{}: no pose examples of \"{}\"; there are some of: {}",
                                folder.string(), subject, fmt::join(names, ", ")));
  }
  const std::size_t vertex_count = ReadBodyModel(folder / kReferenceFolder).rest.vertices.size();
  return {subject, ReadVertexFrames(folder / kPosesFolder / (subject + ".bin"), vertex_count)};
}

}  // namespace vitruvia
