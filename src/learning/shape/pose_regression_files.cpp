// The pose regression on disk (see pose_regression.h).
#include <bit>
#include <cmath>
#include <cstring>

#include "config/stored_data.h"
#include "core/error.h"
#include "core/files.h"
#include "learning/shape/pose_regression.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kTrianglesFile = "triangles.bin";
static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");

// A triangle's record: bone and joints, place, terms column by column.
struct Record {
  std::int32_t bone;
  std::array<std::int32_t, kRegressionJoints> joints;
  std::array<float, 3> place;
  std::array<std::array<float, 9>, kRegressors> terms;
};
static_assert(sizeof(Record) == 4 * (1 + kRegressionJoints + 3 + 9 * kRegressors));

struct RegressionHeader {
  static constexpr StoredFormat kFormat{"vitruvia-pose-regression", 1, 1,
                                        "learn the regression again"};

  int triangles = 0;
  nlohmann::json learnt_from = nlohmann::json::object();

  void Describe(Fields& f) {
    f.Integer("triangles", triangles,
              {.meaning = "triangles in triangles.bin", .min = 1, .max = 100000000});
    f.FreeJson("learnt_from", learnt_from, {.meaning = "settings that it was learnt with"});
  }
};

Record ToRecord(const TrianglePoseModel& model) {
  Record record{};
  record.bone = model.bone;
  std::copy(model.joints.begin(), model.joints.end(), record.joints.begin());
  std::copy_n(model.place.data(), 3, record.place.begin());
  for (int r = 0; r < kRegressors; ++r)
    std::copy_n(model.terms[r].data(), 9, record.terms[r].begin());
  return record;
}

bool IsSound(const Record& record) {
  if (record.bone < 0 || record.bone >= kBoneCount) return false;
  for (const std::int32_t joint : record.joints) {
    if (joint < -1 || joint >= kBoneCount) return false;
  }
  for (const auto& term : record.terms) {
    for (const float x : term) {
      if (!std::isfinite(x)) return false;
    }
  }
  for (const float x : record.place) {
    if (!std::isfinite(x)) return false;
  }
  return true;
}

TrianglePoseModel FromRecord(const Record& record) {
  TrianglePoseModel model;
  model.bone = record.bone;
  std::copy(record.joints.begin(), record.joints.end(), model.joints.begin());
  std::copy_n(record.place.begin(), 3, model.place.data());
  for (int r = 0; r < kRegressors; ++r)
    std::copy_n(record.terms[r].begin(), 9, model.terms[r].data());
  return model;
}

}  // namespace

void WritePoseRegression(const fs::path& folder, const PoseRegression& regression,
                         const nlohmann::json& learnt_from) {
  std::vector<Record> records;
  for (const TrianglePoseModel& model : regression.triangles) records.push_back(ToRecord(model));
  StagedFolder staged(folder, kPoseRegressionFile);
  WriteStored(staged.path() / kPoseRegressionFile,
              RegressionHeader{static_cast<int>(records.size()), learnt_from}, 1);
  WriteWholeFile(staged.path() / kTrianglesFile,
                 {reinterpret_cast<const char*>(records.data()), records.size() * sizeof(Record)});
  staged.Commit();
}

nlohmann::json ReadRegressionOrigin(const fs::path& folder) {
  return ReadStored<RegressionHeader>(folder / kPoseRegressionFile).learnt_from;
}

PoseRegression ReadPoseRegression(const fs::path& folder) {
  const auto header = ReadStored<RegressionHeader>(folder / kPoseRegressionFile);
  const fs::path file = folder / kTrianglesFile;
  const std::string bytes = ReadWholeFile(file);
  const std::size_t expected = static_cast<std::size_t>(header.triangles) * sizeof(Record);
  if (bytes.size() != expected) {
    throw DataError(fmt::format("{}: {} bytes, expected {} for {} triangles", file.string(),
                                bytes.size(), expected, header.triangles));
  }
  std::vector<Record> records(static_cast<std::size_t>(header.triangles));
  std::memcpy(records.data(), bytes.data(), bytes.size());
  PoseRegression regression;
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (!IsSound(records[k])) {
      throw DataError(fmt::format("{}: triangle {}: expected a bone, joints and finite numbers",
                                  file.string(), k));
    }
    regression.triangles.push_back(FromRecord(records[k]));
  }
  return regression;
}

}  // namespace vitruvia
