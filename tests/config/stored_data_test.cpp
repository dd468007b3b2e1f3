#include "config/stored_data.h"

#include <cmath>

#include <gmock/gmock.h>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Term {
  std::string name;
  double value = 0.0;
};

struct Note {
  std::string text;
  double weight = kAbsent;

  void Describe(Fields& f) {
    f.Text("text", text, {.meaning = "text of the note"});
    f.Number("weight", weight, {.meaning = "weight of the note", .optional = true});
  }
};

// Every kind of field that only stored data have.
struct Sample {
  static constexpr StoredFormat kFormat{"test-sample", 2, 0, "make the sample again"};

  double number = 1.5;
  double ratio = kAbsent;
  std::vector<double> series;
  std::vector<bool> flags;
  std::vector<Term> terms;
  std::vector<std::array<double, 3>> points;
  std::map<std::string, double> errors;
  std::map<std::string, std::vector<double>> curves;
  std::map<std::string, std::string> reasons;
  std::vector<Note> notes;

  void Describe(Fields& f) {
    f.Number("number", number, {.meaning = "a number"});
    f.Number("ratio", ratio, {.meaning = "a ratio", .optional = true, .infinite = true});
    f.NumberList("series", series,
                 {.meaning = "one number for each frame", .null_items = true, .infinite = true});
    f.Flags("flags", flags, {.meaning = "flags"});
    f.NamedNumbers("terms", terms, {.meaning = "terms"});
    f.Points("points", points, {.meaning = "points", .null_items = true});
    f.Map("errors", errors, {.meaning = "error of each name"});
    f.Map("curves", curves, {.meaning = "curve of each name"});
    f.Map("reasons", reasons, {.meaning = "reason of each name"});
    f.List("notes", notes, {.meaning = "notes", .optional = true});
  }
  static void Upgrade(Json& file, int version) {
    if (version == 0 && file.contains("old_number")) {
      file["number"] = file["old_number"];
      file.erase("old_number");
    }
  }
};

Sample Full() {
  return {-0.1,
          -kInfinity,
          {1.0, kAbsent, kInfinity},
          {true, false},
          {{"fit", 2.0 / 3.0}, {"axis", 5e-324}},
          {{0.1, 0.2, 1.0 / 3.0}, {kAbsent, kAbsent, kAbsent}},
          {{"head", 0.25}},
          {{"all", {0.0, 1.0}}},
          {{"b", "lost"}},
          {{"first", 2.0}, {"second", kAbsent}}};
}

class StoredData : public testing::Test {
 protected:
  Sample Read(const Json& json) const {
    WriteWholeFile(file_, json.dump());
    return ReadStored<Sample>(file_);
  }
  std::string Refusal(const Json& json) const {
    try {
      Read(json);
    } catch (const DataError& error) {
      return error.what();
    }
    return "not refused";
  }
  Json Whole() const {
    WriteStored(file_, Full());
    return ReadJsonFile(file_);
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "sample.json";
};

TEST_F(StoredData, WritesAbsentAndInfiniteNumbersByThePolicy) {
  const Json json = Whole();
  EXPECT_EQ(json.at("ratio"), "-Infinity");
  EXPECT_EQ(json.at("series"), Json::parse(R"([1.0, null, "Infinity"])"));
  EXPECT_EQ(json.at("points")[1], nullptr);
  EXPECT_EQ(json.at("notes")[0].at("weight"), 2.0);
  EXPECT_FALSE(json.at("notes")[1].contains("weight"));
  EXPECT_FALSE(StoredJson(Sample()).contains("ratio"));
  EXPECT_FALSE(StoredJson(Sample()).contains("notes"));
  EXPECT_TRUE(StoredJson(Sample()).contains("series"));  // empty, but not optional
}

TEST_F(StoredData, HeaderComesFirstAndKeysInTheOrderOfTheDescription) {
  Whole();
  const auto json = nlohmann::ordered_json::parse(ReadWholeFile(file_));
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  EXPECT_EQ(keys,
            (std::vector<std::string>{"format", "version", "number", "ratio", "series", "flags",
                                      "terms", "points", "errors", "curves", "reasons", "notes"}));
}

TEST_F(StoredData, ReadsTheSameBits) {
  const Sample read = Read(Whole()), full = Full();
  EXPECT_EQ(StoredJson(read), StoredJson(full));
  EXPECT_EQ(read.ratio, -kInfinity);
  EXPECT_TRUE(std::isnan(read.series[1]));
  EXPECT_EQ(read.series[2], kInfinity);
  EXPECT_EQ(read.terms[0].name, "fit");  // in the order of the list, not of the alphabet
  EXPECT_EQ(read.terms[1].value, 5e-324);
  EXPECT_EQ(read.points[0], full.points[0]);
  EXPECT_TRUE(std::isnan(read.points[1][2]));
  EXPECT_TRUE(std::isnan(read.notes[1].weight));
}

TEST_F(StoredData, RefusesToWriteNumbersThatThePolicyDoesNotAllow) {
  const auto refusal = [](Sample sample) {
    try {
      StoredJson(std::move(sample));
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("not refused");
  };
  Sample sample = Full();
  sample.number = kAbsent;
  EXPECT_EQ(refusal(sample), "number = nan: only finite numbers can be stored");
  sample = Full();
  sample.errors["head"] = kInfinity;
  EXPECT_EQ(refusal(sample), "errors.head = inf: only finite numbers can be stored");
  sample = Full();
  sample.notes[1].weight = kInfinity;
  EXPECT_EQ(refusal(sample), "notes[1].weight = inf: only finite numbers can be stored");
  sample = Full();
  sample.terms[1].value = kAbsent;
  EXPECT_EQ(refusal(sample), "terms.axis = nan: only finite numbers can be stored");
}

TEST_F(StoredData, EveryKeyThatIsNotOptionalMustBeThere) {
  const Json whole = Whole();
  for (const auto& item : whole.items()) {
    Json damaged = whole;
    damaged.erase(item.key());
    if (item.key() == "ratio" || item.key() == "notes") {
      EXPECT_EQ(Refusal(damaged), "not refused");
    } else {
      EXPECT_THAT(Refusal(damaged),
                  testing::StartsWith(file_.string() + ": " + item.key() + ": missing; expected"));
    }
  }
}

TEST_F(StoredData, NamesFileAndPlaceOfWhatIsWrong) {
  const Json whole = Whole();
  const auto refusal = [&](const char* pointer, const Json& value) {
    Json damaged = whole;
    damaged[Json::json_pointer(pointer)] = value;
    const std::string text = Refusal(damaged);
    EXPECT_TRUE(text.starts_with(file_.string() + ": ")) << text;
    return text.substr(std::min(text.size(), file_.string().size() + 2));
  };
  EXPECT_EQ(refusal("/number", "Infinity"), "number: expected a number, got \"Infinity\"");
  EXPECT_EQ(refusal("/number", nullptr), "number: expected a number, got null");
  EXPECT_EQ(refusal("/series/1", true), "series[1]: expected a number, got true");
  EXPECT_EQ(refusal("/flags/1", 1), "flags[1]: expected true or false, got 1");
  EXPECT_EQ(refusal("/terms/0", "fit"), "terms[0]: expected a name and a number, got \"fit\"");
  EXPECT_EQ(refusal("/points/0", {1, 2}), "points[0]: expected three numbers, got [1,2]");
  EXPECT_EQ(refusal("/errors/head", "big"), "errors.head: expected a number, got \"big\"");
  EXPECT_EQ(refusal("/curves/all/0", "big"), "curves.all[0]: expected a number, got \"big\"");
  EXPECT_EQ(refusal("/reasons/b", 3), "reasons.b: expected a text, got 3");
  EXPECT_EQ(
      refusal("/notes/1/weigth", 3),
      "notes[1].weigth: unknown key (value 3); did you mean \"weight\"? valid keys here: text, "
      "weight");
  WriteWholeFile(file_, R"({"a": 1, "b": {"c": 1, "c": 2}})");
  EXPECT_THAT([&] { ReadStored<Sample>(file_); },
              testing::ThrowsMessage<DataError>(file_.string() +
                                                ": the key \"c\" stands twice in one object"));
}

TEST_F(StoredData, OtherFormatsAndVersionsAreRefusedInOneSentence) {
  const auto refusal = [&](const char* key, const Json& value) {
    Json damaged = Whole();
    damaged[key] = value;
    return Refusal(damaged).substr(file_.string().size() + 2);
  };
  EXPECT_EQ(refusal("format", "test-other"),
            "format: expected \"test-sample\", got \"test-other\"");
  EXPECT_EQ(refusal("version", 3),
            "version 3: a newer version of vitruvia wrote the file; this one reads 2");
  EXPECT_EQ(refusal("version", -1),
            "version -1: an older version of vitruvia wrote the file; this one reads 2; make the "
            "sample again");
  EXPECT_EQ(refusal("version", "two"), "version: expected 2, got \"two\"");
}

TEST_F(StoredData, FileWithoutHeaderIsUpgradedOrRefused) {
  Json old = StoredJson(Full());
  old["old_number"] = 7.0;
  old.erase("number");
  EXPECT_EQ(Read(old).number, 7.0);
  old.erase("flags");
  EXPECT_EQ(Refusal(old), file_.string() +
                              ": flags: missing; expected: flags (version 0 of the format, which "
                              "an older version of vitruvia wrote, is read only where it is "
                              "complete; make the sample again)");
}

TEST(StoredSchema, StatesHeaderOptionalKeysAndInfinity) {
  const Json schema = StoredSchema<Sample>();
  const Json& properties = schema.at("properties");
  EXPECT_EQ(properties.at("format").at("const"), "test-sample");
  EXPECT_EQ(properties.at("version").at("const"), 2);
  const Json& required = schema.at("required");
  const auto is_required = [&](const char* key) {
    return std::find(required.begin(), required.end(), key) != required.end();
  };
  EXPECT_TRUE(is_required("format") && is_required("number") && is_required("series"));
  EXPECT_FALSE(is_required("ratio") || is_required("notes"));
  EXPECT_EQ(properties.at("errors").at("additionalProperties").at("type"), "number");
  EXPECT_EQ(properties.at("ratio").at("anyOf")[1].at("enum")[0], "Infinity");
}

}  // namespace
}  // namespace vitruvia
