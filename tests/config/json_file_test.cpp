// JSON files as a user writes them: what is wrong with them, paths in them, and overrides.
#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/did_you_mean.h"
#include "config/json_settings.h"
#include "core/error.h"
#include "core/files.h"
#include "tests/support/temporary_folder.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class JsonFile : public testing::Test {
 protected:
  std::string ErrorOf(const std::string& content) {
    WriteWholeFile(file_, content);
    return ErrorOfFile(file_);
  }
  static std::string ErrorOfFile(const fs::path& file) {
    try {
      ReadJsonFile(file);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "no error";
  }

  const TemporaryFolder folder_;
  const fs::path file_ = folder_ / "config.json";
};

TEST_F(JsonFile, IsReadWhole) {
  WriteWholeFile(file_, R"({"a": [1, 2.5, "ü"], "b": {"a": null}})");
  EXPECT_EQ(ReadJsonFile(file_), Json::parse(R"({"a": [1, 2.5, "ü"], "b": {"a": null}})"));
}

TEST_F(JsonFile, NamesAFileThatCannotBeOpened) {
  EXPECT_EQ(ErrorOfFile(file_), file_.string() + ": cannot be opened; expected a JSON file");
  EXPECT_EQ(ErrorOfFile(folder_.path()),
            folder_.path().string() + ": cannot be opened; expected a JSON file");
}

TEST_F(JsonFile, SaysWhereTheSyntaxIsWrong) {
  EXPECT_THAT(
      ErrorOf("{\n  \"a\": 1,\n  \"b\" 2\n}\n"),
      AllOf(StartsWith(file_.string() + ": not valid JSON: "), HasSubstr("at line 3, column ")));
  EXPECT_THAT(ErrorOf(""), HasSubstr("at line 1, column 1"));
  EXPECT_THAT(ErrorOf("{} {}"), HasSubstr("not valid JSON"));
  EXPECT_THAT(ErrorOf("{\"a\": NaN}"), HasSubstr("not valid JSON"));
  EXPECT_THAT(ErrorOf("{\"a\": 1e999}"), HasSubstr("not valid JSON"));
  EXPECT_THAT(ErrorOf("{\"a\": \"\xff\"}"), HasSubstr("not valid JSON"));
}

TEST_F(JsonFile, RejectsAKeyThatStandsTwiceInOneObject) {
  EXPECT_EQ(ErrorOf(R"({"a": 1, "b": {"c": 1}, "a": 2})"),
            file_.string() + ": the key \"a\" stands twice in one object");
  EXPECT_EQ(ErrorOf(R"([{"x": {"c": 1, "d": 2, "c": 1}}])"),
            file_.string() + ": the key \"c\" stands twice in one object");
  EXPECT_EQ(ErrorOf(R"({"a": {"a": 1}, "b": [{"a": 1}, {"a": 2}]})"), "no error");
}

// The examples of RFC 7386, appendix A.
TEST(Merged, FollowsTheExamplesOfRfc7386) {
  constexpr const char* kExamples[][3] = {
      {R"({"a":"b"})", R"({"a":"c"})", R"({"a":"c"})"},
      {R"({"a":"b"})", R"({"b":"c"})", R"({"a":"b","b":"c"})"},
      {R"({"a":"b"})", R"({"a":null})", R"({})"},
      {R"({"a":"b","b":"c"})", R"({"a":null})", R"({"b":"c"})"},
      {R"({"a":["b"]})", R"({"a":"c"})", R"({"a":"c"})"},
      {R"({"a":"c"})", R"({"a":["b"]})", R"({"a":["b"]})"},
      {R"({"a":{"b":"c"}})", R"({"a":{"b":"d","c":null}})", R"({"a":{"b":"d"}})"},
      {R"({"a":[{"b":"c"}]})", R"({"a":[1]})", R"({"a":[1]})"},
      {R"(["a","b"])", R"(["c","d"])", R"(["c","d"])"},
      {R"({"a":"b"})", R"(["c"])", R"(["c"])"},
      {R"({"a":"foo"})", "null", "null"},
      {R"({"a":"foo"})", R"("bar")", R"("bar")"},
      {R"({"e":null})", R"({"a":1})", R"({"e":null,"a":1})"},
      {R"([1,2])", R"({"a":"b","c":null})", R"({"a":"b"})"},
      {R"({})", R"({"a":{"bb":{"ccc":null}}})", R"({"a":{"bb":{}}})"}};
  for (const auto& [base, overrides, merged] : kExamples) {
    EXPECT_EQ(Merged(Json::parse(base), Json::parse(overrides)), Json::parse(merged))
        << base << " with " << overrides;
  }
}

TEST(NearestWord, IsTheNearestByEditsOrNone) {
  const std::vector<std::string> words = {"iterations", "tolerance", "step", "steps"};
  EXPECT_EQ(NearestWord("iteration", words), "iterations");  // a letter less
  EXPECT_EQ(NearestWord("tolerrance", words), "tolerance");  // a letter more
  EXPECT_EQ(NearestWord("tolerence", words), "tolerance");   // another letter
  EXPECT_EQ(NearestWord("step", words), "step");
  EXPECT_EQ(NearestWord("stepss", words), "steps");
  EXPECT_EQ(NearestWord("colour", words), "");
  EXPECT_EQ(NearestWord("", words), "");
  EXPECT_EQ(NearestWord("step", {}), "");
}

struct Paths {
  fs::path file;
  std::vector<fs::path> files;
  void Describe(Fields& f) {
    f.File("file", file, {.meaning = "a file"});
    f.Files("files", files, {.meaning = "files"});
  }
};

Paths ReadPaths(const char* text) {
  return ReadSettings<Paths>(Json::parse(text), {"/etc/configs/one.json", ""});
}

TEST(Paths, HangOnTheFolderOfTheConfig) {
  EXPECT_EQ(ReadPaths(R"({"file": "a/b"})").file, "/etc/configs/a/b");
  EXPECT_EQ(ReadPaths(R"({"file": "../a"})").file, "/etc/a");
  EXPECT_EQ(ReadPaths(R"({"file": "/a/./b"})").file, "/a/b");
  EXPECT_EQ(ReadPaths("{}").file, "");
  EXPECT_EQ(ReadPaths(R"({"file": ""})").file, "");
  const Paths paths = ReadPaths(R"({"files": ["a", "/b"]})");
  ASSERT_EQ(paths.files.size(), 2u);
  EXPECT_EQ(paths.files[0], "/etc/configs/a");
  EXPECT_EQ(paths.files[1], "/b");
  const Paths beside = ReadSettings<Paths>(Json::parse(R"({"file": "a"})"), {"one.json", ""});
  EXPECT_EQ(beside.file, "a");
}

TEST(Paths, BeginWithAnEnvironmentVariableWhereTheyBeginWithADollar) {
  setenv("VITRUVIA_TEST_FOLDER", "/usr", 1);  // has to exist
  setenv("VITRUVIA_TEST_RELATIVE", "../../usr", 1);
  EXPECT_EQ(ReadPaths(R"({"file": "$VITRUVIA_TEST_FOLDER/cmu/a.amc"})").file, "/usr/cmu/a.amc");
  EXPECT_EQ(ReadPaths(R"({"file": "$VITRUVIA_TEST_FOLDER"})").file, "/usr");
  EXPECT_EQ(ReadPaths(R"({"files": ["$VITRUVIA_TEST_RELATIVE/x"]})").files[0], "/usr/x");
  EXPECT_EQ(ReadPaths(R"({"file": "a$VITRUVIA_TEST_FOLDER"})").file,
            "/etc/configs/a$VITRUVIA_TEST_FOLDER");
}

TEST(Paths, SayWhichVariableIsNotSet) {
  setenv("VITRUVIA_TEST_EMPTY", "", 1);
  unsetenv("VITRUVIA_TEST_UNSET");
  for (const std::string name : {"VITRUVIA_TEST_UNSET", "VITRUVIA_TEST_EMPTY"}) {
    const std::string text = R"({"files": ["a", "$)" + name + R"(/x"]})";
    try {
      ReadPaths(text.c_str());
      FAIL() << name << " was taken";
    } catch (const ConfigError& error) {
      EXPECT_EQ(std::string(error.what()), "/etc/configs/one.json: files[1]: $" + name +
                                               "/x needs the environment variable " + name +
                                               ", which is not set");
    }
  }
}

}  // namespace
}  // namespace vitruvia
