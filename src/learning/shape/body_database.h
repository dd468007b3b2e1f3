// A body database: many people's surfaces in one topology, with each person's attributes and
// skeleton.
//
// On disk, a folder:
//   database.json   format, version, subjects (name, height, weight, sex, joints, tips), provenance
//   vertices.bin    float32 [subjects][vertices][3], T-pose, subject frame, metres, little-endian
//   reference/      a body (body/body_model.h) of the database's topology, with the rig's weights
//   poses/NAME.bin  optional, float32 [poses][vertices][3]: subject NAME in other poses
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "body/body_model.h"

namespace vitruvia {

struct DatabaseSubject {
  std::string name;
  BodyAttributes attributes;
  Skeleton skeleton;
  std::vector<Vector3f> vertices;  // V, T-pose, subject frame, metres
};

// One person in many poses: [pose][vertex], metres.
struct PoseExamples {
  std::string subject;
  std::vector<std::vector<Vector3f>> poses;
};

struct BodyDatabase {
  BodyModel reference;  // the subject nearest to the mean, with the rig's weights
  std::vector<DatabaseSubject> subjects;
  std::vector<PoseExamples> examples;
  nlohmann::json provenance = nlohmann::json::object();  // how it was made; free form
};

// The subject whose vertices are nearest to the mean of all (by squared distance).
std::size_t MostAverage(const std::vector<DatabaseSubject>& subjects);

// DataError naming the subject: fewer than two subjects, another number of vertices than the
// reference, vertices that are not finite, a duplicate name.
void CheckBodyDatabase(const BodyDatabase& database, const std::string& where);

void WriteBodyDatabase(const std::filesystem::path& folder, const BodyDatabase& database);
// Without its pose examples, which are large.
BodyDatabase ReadBodyDatabase(const std::filesystem::path& folder);
// DataError naming the subjects that have examples if this one has none.
PoseExamples ReadPoseExamples(const std::filesystem::path& folder, const std::string& subject);
// Names of the subjects that have examples, sorted.
std::vector<std::string> SubjectsWithExamples(const std::filesystem::path& folder);

}  // namespace vitruvia
