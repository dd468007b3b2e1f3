#include "learning/shape/body_database.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "small_database.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;

std::string ProblemOf(const BodyDatabase& database) {
  try {
    CheckBodyDatabase(database, "db");
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

TEST(BodyDatabase, FoundAgainOnDisk) {
  const TemporaryFolder folder;
  const BodyDatabase& database = SmallDatabase();
  WriteBodyDatabase(folder.path() / "db", database);
  const BodyDatabase read = ReadBodyDatabase(folder.path() / "db");
  ASSERT_EQ(read.subjects.size(), 40u);
  EXPECT_EQ(read.subjects[17].vertices, database.subjects[17].vertices);
  EXPECT_EQ(read.subjects[17].attributes.weight_kg, database.subjects[17].attributes.weight_kg);
  EXPECT_EQ(read.subjects[17].skeleton.tips[4], database.subjects[17].skeleton.tips[4]);
  EXPECT_EQ(SubjectsWithExamples(folder.path() / "db"), std::vector<std::string>{"s000"});
  EXPECT_EQ(ReadPoseExamples(folder.path() / "db", "s000").poses, database.examples[0].poses);
  EXPECT_THROW(ReadPoseExamples(folder.path() / "db", "s001"), DataError);
  std::filesystem::resize_file(folder.path() / "db" / "vertices.bin", 1000);
  EXPECT_THROW(ReadBodyDatabase(folder.path() / "db"), DataError);
}

TEST(BodyDatabase, RefusesOneSubjectAndMixedTopologies) {
  BodyDatabase one = SmallDatabase();
  one.subjects.resize(1);
  EXPECT_THAT(ProblemOf(one), HasSubstr("1 subjects, expected at least 2"));
  BodyDatabase mixed = SmallDatabase();
  mixed.subjects[3].vertices.pop_back();
  EXPECT_THAT(ProblemOf(mixed), HasSubstr("one topology is needed"));
  BodyDatabase twice = SmallDatabase();
  twice.subjects[3].name = twice.subjects[2].name;
  EXPECT_THAT(ProblemOf(twice), HasSubstr("stands twice"));
}

}  // namespace
}  // namespace vitruvia
