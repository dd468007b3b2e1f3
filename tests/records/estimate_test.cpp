#include "records/estimate.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

class EstimateTest : public testing::Test {
 protected:
  EstimateTest() { fs::remove_all(folder_); }
  ~EstimateTest() override { fs::remove_all(folder_); }

  void WriteTwoFrames() {
    EstimateWriter writer(folder_, mesh_);
    writer.Append(Result(0.1f, Outcome::kConverged), 12.5);
    writer.Append(Result(0.7f, Outcome::kLost), 1.0 / 3.0);
    writer.Finish(48.5);
  }
  TrackResult Result(float shift_m, Outcome outcome) const {
    TrackResult result;
    result.outcome = outcome;
    result.message = outcome == Outcome::kLost ? "3 of 4 vertices unsupported" : "";
    for (const Vector3f& v : mesh_.vertices) {
      result.vertices.push_back(v + Vector3f::Constant(shift_m));
    }
    result.joints = {{0.1, 0.2, 1.0 / 3.0}};
    result.iterations = 4;
    result.step_ms = {{"render", 0.5}, {"assemble", 0.1}};
    result.energies = {{"data", 2.0 / 3.0}};
    result.condition = outcome == Outcome::kLost ? std::numeric_limits<double>::infinity() : 17.0;
    return result;
  }

  fs::path folder_ =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  TriangleMesh mesh_{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                     {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
};

TEST_F(EstimateTest, RoundTrips) {
  WriteTwoFrames();
  const EstimateReader reader(folder_);
  ASSERT_EQ(reader.frames().size(), 2u);
  EXPECT_EQ(reader.tracker_memory_mb(), 48.5);
  EXPECT_EQ(reader.rest_mesh().vertices, mesh_.vertices);
  EXPECT_EQ(reader.rest_mesh().triangles, mesh_.triangles);
  const FrameEstimate& first = reader.frames()[0];
  EXPECT_EQ(first.outcome, Outcome::kConverged);
  EXPECT_EQ(first.frame_ms, 12.5);
  EXPECT_EQ(first.iterations, 4);
  EXPECT_EQ(first.condition, 17.0);
  EXPECT_EQ(first.step_ms[0].name, "render");  // in the order of the method, not of the alphabet
  EXPECT_EQ(first.step_ms[1].name, "assemble");
  EXPECT_EQ(first.energies[0].value, 2.0 / 3.0);
  EXPECT_EQ(first.joints[0], Vector3<double>(0.1, 0.2, 1.0 / 3.0));
  const FrameEstimate& second = reader.frames()[1];
  EXPECT_EQ(second.outcome, Outcome::kLost);
  EXPECT_EQ(second.message, "3 of 4 vertices unsupported");
  EXPECT_EQ(second.frame_ms, 1.0 / 3.0);
  EXPECT_EQ(second.condition, std::numeric_limits<double>::infinity());
  EXPECT_EQ(reader.ReadVertices(1), Result(0.7f, Outcome::kLost).vertices);
  EXPECT_THROW(reader.ReadVertices(2), std::invalid_argument);
}

TEST_F(EstimateTest, UnfinishedOneLeavesNothingBehind) {
  {
    EstimateWriter writer(folder_, mesh_);
    writer.Append(Result(0.0f, Outcome::kConverged), 1.0);
  }
  EXPECT_FALSE(fs::exists(folder_));
  for (const auto& entry : fs::directory_iterator(folder_.parent_path())) {
    EXPECT_THAT(entry.path().string(), testing::Not(HasSubstr(folder_.filename().string())));
  }
}

TEST_F(EstimateTest, RefusesResultsThatCannotBeStored) {
  EstimateWriter writer(folder_, mesh_);
  TrackResult result = Result(0.0f, Outcome::kConverged);
  result.vertices.pop_back();
  EXPECT_THAT([&] { writer.Append(result, 1.0); },
              testing::ThrowsMessage<std::invalid_argument>("frame 0: expected 4 vertices, got 3"));
  result = Result(0.0f, Outcome::kConverged);
  result.vertices[2].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT([&] { writer.Append(result, 1.0); },
              testing::ThrowsMessage<std::invalid_argument>("frame 0: vertex 2 is not finite"));
  result = Result(0.0f, Outcome::kConverged);
  result.energies[0].value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { writer.Append(result, 1.0); }, testing::ThrowsMessage<std::invalid_argument>(
                                                       HasSubstr("frame 0: energies.data = nan")));
}

TEST_F(EstimateTest, DamagedOnesAreRefusedWithTheReason) {
  const auto message = [&] {
    try {
      EstimateReader reader(folder_);
    } catch (const DataError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(message(), HasSubstr("estimate.json: cannot be opened"));

  WriteTwoFrames();
  fs::resize_file(folder_ / "vertices.bin", 95);
  EXPECT_EQ(message(), (folder_ / "vertices.bin").string() +
                           ": expected 96 bytes (2 frames × 4 vertices × 12), got 95");

  WriteTwoFrames();
  const fs::path index = folder_ / "estimate.json";
  const auto whole = nlohmann::json::parse(ReadWholeFile(index));
  auto damaged = whole;
  damaged["frames"][1].erase("joints");
  WriteWholeFile(index, damaged.dump());
  EXPECT_EQ(message(), index.string() +
                           ": frames[1].joints: missing; expected: proximal end of "
                           "each bone, camera frame");
  damaged = whole;
  damaged["frames"][0]["outcome"] = "fine";
  WriteWholeFile(index, damaged.dump());
  EXPECT_THAT(message(), HasSubstr(index.string() + ": frames[0].outcome: expected one of "));
  damaged = whole;
  damaged["frames"][0]["condition"] = nullptr;  // an absent number has no key
  damaged["frames"][1]["iteration"] = 3;
  WriteWholeFile(index, damaged.dump());
  EXPECT_THAT(message(), HasSubstr("frames[1].iteration: unknown key (value 3); did you mean "
                                   "\"iterations\"?"));
  damaged = whole;
  damaged["frames"][0]["energies"][0] = {"data", nullptr};
  WriteWholeFile(index, damaged.dump());
  EXPECT_THAT(message(), HasSubstr("frames[0].energies[0]: expected a name and a number"));
  damaged = whole;
  damaged["vertex_count"] = 5;
  WriteWholeFile(index, damaged.dump());
  EXPECT_THAT(message(), HasSubstr("vertex_count: expected the 4 vertices of mesh.ply, got 5"));
}

TEST_F(EstimateTest, InfiniteAndAbsentNumbersAreStoredByThePolicy) {
  WriteTwoFrames();
  const auto frames = nlohmann::json::parse(ReadWholeFile(folder_ / "estimate.json")).at("frames");
  EXPECT_EQ(frames[0].at("condition"), 17.0);
  EXPECT_EQ(frames[1].at("condition"), "Infinity");
  EXPECT_FALSE(frames[0].contains("energy_rise"));  // nobody watched the energy
  EXPECT_TRUE(std::isnan(EstimateReader(folder_).frames()[0].energy_rise));
}

// As version 1 wrote it: null for infinity, −1 for what was not computed.
TEST_F(EstimateTest, VersionOneIsReadCompletelyOrRefused) {
  WriteTwoFrames();
  const fs::path index = folder_ / "estimate.json";
  auto old = nlohmann::json::parse(ReadWholeFile(index));
  old["version"] = 1;
  old["frames"][0]["energy_rise"] = -1.0;
  old["frames"][1]["condition"] = nullptr;
  old["frames"][1]["energy_rise"] = 0.25;
  WriteWholeFile(index, old.dump());
  const EstimateReader reader(folder_);
  EXPECT_TRUE(std::isnan(reader.frames()[0].energy_rise));
  EXPECT_EQ(reader.frames()[0].condition, 17.0);
  EXPECT_EQ(reader.frames()[1].condition, std::numeric_limits<double>::infinity());
  EXPECT_EQ(reader.frames()[1].energy_rise, 0.25);
  old["frames"][1].erase("rotation_drift");
  WriteWholeFile(index, old.dump());
  EXPECT_THAT(
      [&] { EstimateReader again(folder_); },
      testing::ThrowsMessage<DataError>(testing::AllOf(
          HasSubstr("frames[1].rotation_drift: missing"),
          HasSubstr("an older version of vitruvia wrote"), HasSubstr("run the experiment again"))));
  old["version"] = 3;
  WriteWholeFile(index, old.dump());
  EXPECT_THAT([&] { EstimateReader again(folder_); },
              testing::ThrowsMessage<DataError>(
                  index.string() +
                  ": version 3: a newer version of vitruvia wrote the file; this one reads 2"));
}

TEST_F(EstimateTest, NotANumberInTheVerticesIsFoundWhenTheyAreRead) {
  WriteTwoFrames();
  {
    std::fstream stream(folder_ / "vertices.bin", std::ios::in | std::ios::out | std::ios::binary);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    stream.seekp(48 + 12);  // frame 1, vertex 1
    stream.write(reinterpret_cast<const char*>(&nan), sizeof nan);
  }
  const EstimateReader reader(folder_);
  EXPECT_THAT([&] { reader.ReadVertices(1); },
              testing::ThrowsMessage<DataError>(HasSubstr("frame 1: vertex 1 is not finite")));
}

}  // namespace
}  // namespace vitruvia
