#include "body/body_model.h"

#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_body.h"

namespace vitruvia {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class BodyFolder : public testing::Test {
 protected:
  BodyFolder() { WriteBodyModel(folder_, body_); }

  void Damage(const std::string& file, const std::string& content) {
    WriteWholeFile(folder_ / file, content);
  }
  std::string Content(const std::string& file) const { return ReadWholeFile(folder_ / file); }
  void Replace(const std::string& file, const std::string& what, const std::string& by) {
    std::string content = Content(file);
    const std::size_t at = content.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    Damage(file, content.replace(at, what.size(), by));
  }
  void ExpectRefused(const std::string& where, const std::string& reason) const {
    EXPECT_THAT([&] { ReadBodyModel(folder_); },
                ThrowsMessage<DataError>(AllOf(HasSubstr(where), HasSubstr(reason))));
  }

  TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_ / "body";
  BodyModel body_ = TinyBody();
};

TEST_F(BodyFolder, GivesBackExactlyWhatWasWritten) {
  const BodyModel read = ReadBodyModel(folder_);
  EXPECT_EQ(read.name, body_.name);
  EXPECT_EQ(read.rest.vertices, body_.rest.vertices);
  EXPECT_EQ(read.rest.triangles, body_.rest.triangles);
  EXPECT_EQ(read.weights.bones, body_.weights.bones);
  EXPECT_EQ(read.weights.weights, body_.weights.weights);
  EXPECT_EQ(read.skeleton.joints, body_.skeleton.joints);
  EXPECT_EQ(read.skeleton.tips, body_.skeleton.tips);
  EXPECT_EQ(read.attributes.height_m, body_.attributes.height_m);
  EXPECT_EQ(read.attributes.weight_kg, body_.attributes.weight_kg);
  EXPECT_EQ(read.attributes.sex, body_.attributes.sex);
}

TEST_F(BodyFolder, HoldsThreeFilesAndIsReplacedAsAWhole) {
  BodyModel other = TinyBody(2);
  other.name = "other";
  WriteBodyModel(folder_, other);
  EXPECT_EQ(ReadBodyModel(folder_).name, "other");
  EXPECT_EQ(ReadBodyModel(folder_).rest.vertices.size(), other.rest.vertices.size());
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    names.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre("mesh.ply", "subject.json", "weights.bin"));
}

TEST_F(BodyFolder, HasWeightsAsDocumented) {
  const std::string bytes = Content("weights.bin");
  ASSERT_EQ(bytes.size(), body_.rest.vertices.size() * 32);
  EXPECT_EQ(static_cast<std::uint8_t>(bytes[32 * 3 + 8]), body_.weights.bones[3][1]);
  float weight = 0.0f;
  std::memcpy(&weight, &bytes[32 * 3 + 8 + 4], 4);
  EXPECT_EQ(weight, body_.weights.weights[3][1]);
}

TEST_F(BodyFolder, RefusesMissingFiles) {
  for (const std::string file : {"mesh.ply", "subject.json", "weights.bin"}) {
    const std::string content = Content(file);
    std::filesystem::remove(folder_ / file);
    ExpectRefused(file, "");
    Damage(file, content);
  }
  EXPECT_THAT([&] { ReadBodyModel(temporary_ / "nobody"); },
              ThrowsMessage<DataError>(HasSubstr("nobody")));
}

TEST_F(BodyFolder, RefusesWeightsOfAnotherLength) {
  const std::string bytes = Content("weights.bin");
  Damage("weights.bin", bytes.substr(0, bytes.size() - 32));
  ExpectRefused("weights.bin", fmt::format("{} bytes, expected {} for {} vertices",
                                           bytes.size() - 32, bytes.size(), bytes.size() / 32));
  Damage("weights.bin", bytes + "x");
  ExpectRefused("weights.bin", fmt::format("{} bytes", bytes.size() + 1));
  Damage("weights.bin", "");
  ExpectRefused("weights.bin", "0 bytes");
}

TEST_F(BodyFolder, RefusesWrongWeights) {
  std::string bytes = Content("weights.bin");
  bytes[2 * 32] = 17;
  Damage("weights.bin", bytes);
  ExpectRefused("body", "vertex 2: bone 17, but there are 17 bones");
  bytes[2 * 32] = 0;
  const float half = 0.5f, nothing = 0.0f;
  std::memcpy(&bytes[4 * 32 + 4], &half, 4);
  for (int k = 1; k < 4; ++k) std::memcpy(&bytes[4 * 32 + 8 * k + 4], &nothing, 4);
  Damage("weights.bin", bytes);
  ExpectRefused("body", "vertex 4: weights sum to 0.5, expected 1");
  std::memcpy(&bytes[4 * 32 + 4], &kNan, 4);
  Damage("weights.bin", bytes);
  ExpectRefused("body", "vertex 4: weight nan, expected 0 or more");
}

TEST_F(BodyFolder, RefusesWrongSubjects) {
  const std::string good = Content("subject.json");
  const auto expect = [&](const std::string& what, const std::string& by,
                          const std::string& reason) {
    Replace("subject.json", what, by);
    ExpectRefused("subject.json", reason);
    Damage("subject.json", good);
  };
  expect("\"height_m\"", "\"heigth_m\"", "height_m");
  expect("\"male\"", "\"mail\"", "female");
  expect("\"left_forearm\"", "\"tail\"", "bone 6 is 'tail', expected 'left_forearm'");
  expect("\"version\": 1", "\"version\": 2", "version");
  expect("70.0", "\"heavy\"", "weight_kg: expected a number");
  Damage("subject.json", good.substr(0, good.size() / 2));
  ExpectRefused("subject.json", "");
  Damage("subject.json", "[]");
  ExpectRefused("subject.json", "");
}

TEST(CheckBodyModel, AcceptsAGoodBody) { CheckBodyModel(TinyBody(2), "tiny"); }

TEST(CheckBodyModel, NamesWhatIsWrong) {
  const auto expect = [](const std::function<void(BodyModel&)>& spoil, const std::string& reason) {
    BodyModel body = TinyBody();
    spoil(body);
    EXPECT_THAT([&] { CheckBodyModel(body, "the/place"); },
                ThrowsMessage<DataError>(AllOf(HasSubstr("the/place: "), HasSubstr(reason))));
  };
  expect([](BodyModel& b) { b.rest.triangles.pop_back(); }, "mesh: open edge");
  expect([](BodyModel& b) { b.rest.vertices[4].x() = kNan; }, "mesh: vertex 4 is not finite");
  expect(
      [](BodyModel& b) {
        for (Triangle& t : b.rest.triangles) std::swap(t[0], t[1]);
      },
      "its triangles face inwards");
  expect(
      [](BodyModel& b) {
        b.weights.bones.pop_back();
        b.weights.weights.pop_back();
      },
      "weights for");
  expect([](BodyModel& b) { b.weights.bones[1][0] = 99; }, "vertex 1: bone 99");
  expect([](BodyModel& b) { b.skeleton.joints[6].y() = kNan; }, "joint 'left_elbow' is not finite");
  expect([](BodyModel& b) { b.skeleton.tips[4].z() = kNan; }, "the tip of bone 'head'");
  expect([](BodyModel& b) { b.attributes.height_m = 0.0; }, "height of 0 m");
  expect([](BodyModel& b) { b.attributes.weight_kg = -3.0; }, "weight of -3 kg");
}

TEST(WriteBodyModel, WritesNothingOfABadBody) {
  TemporaryFolder temporary;
  BodyModel body = TinyBody();
  body.weights.weights[0][0] = 0.1f;
  EXPECT_THROW(WriteBodyModel(temporary / "body", body), DataError);
  EXPECT_TRUE(std::filesystem::is_empty(temporary.path()));
}

}  // namespace
}  // namespace vitruvia
