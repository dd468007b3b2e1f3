#include "config/json_settings.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace vitruvia {
namespace {

enum class Colour { kRed, kBlue };

struct Wheel {
  double radius_m = 0.3;
  void Describe(Fields& f) {
    f.Number("radius", radius_m,
             {.meaning = "outer radius",
              .unit = "m",
              .min = 0.0,
              .max = 2.0,
              .origin = Origin::kGuessed});
  }
};

struct Car {
  int doors = 4;
  bool open = false;
  std::string name;
  Colour colour = Colour::kRed;
  Wheel spare;
  std::vector<Wheel> wheels;
  std::array<double, 2> position{};
  void Describe(Fields& f) {
    f.Integer("doors", doors, {.meaning = "number of doors", .min = 0, .max = 6});
    f.Flag("open", open, {.meaning = "roof off"});
    f.Text("name", name, {.meaning = "name"});
    f.Choice("colour", colour, {{"red", Colour::kRed}, {"blue", Colour::kBlue}},
             {.meaning = "paint"});
    f.Section("spare", spare, {.meaning = "spare wheel"});
    f.List("wheels", wheels, {.meaning = "wheels"});
    f.Numbers("position", position, {.meaning = "where", .unit = "m"});
  }
  std::string Problem() const { return doors == 5 ? "five doors are not made" : ""; }
};

Car Read(const char* text) { return ReadSettings<Car>(Json::parse(text), {"car.json", ""}); }

std::string MessageOf(const char* text) {
  try {
    Read(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ReadSettings, KeepsDefaultsAndReadsWhatIsThere) {
  const Car car = Read(
      R"({"doors": 2, "colour": "blue", "wheels": [{"radius": 0.4}, {}], "position": [1, 2]})");
  EXPECT_EQ(car.doors, 2);
  EXPECT_EQ(car.colour, Colour::kBlue);
  ASSERT_EQ(car.wheels.size(), 2u);
  EXPECT_EQ(car.wheels[0].radius_m, 0.4);
  EXPECT_EQ(car.wheels[1].radius_m, 0.3);
  EXPECT_EQ(car.position[1], 2.0);
  EXPECT_FALSE(car.open);
}

TEST(ReadSettings, NamesFilePathValueExpectationAndNearestKey) {
  EXPECT_EQ(MessageOf(R"({"dors": 2})"),
            "car.json: dors: unknown key (value 2); did you mean \"doors\"? valid keys here: "
            "colour, doors, "
            "name, open, position, spare, wheels");
  EXPECT_EQ(MessageOf(R"({"spare": {"radius": 3}})"),
            "car.json: spare.radius: expected a number in 0 … 2 m, got 3");
  EXPECT_EQ(MessageOf(R"({"wheels": [{}, {"radius": "big"}]})"),
            "car.json: wheels[1].radius: expected a number in 0 … 2 m, got \"big\"");
  EXPECT_EQ(
      MessageOf(R"({"colour": "bleu"})"),
      "car.json: colour: expected one of \"red\", \"blue\"; did you mean \"blue\"?, got \"bleu\"");
  EXPECT_EQ(MessageOf(R"({"doors": 2.5})"),
            "car.json: doors: expected a whole number in 0 … 6, got 2.5");
  EXPECT_EQ(MessageOf(R"({"position": [1]})"),
            "car.json: position: expected a list of 2 numbers, got [1]");
  EXPECT_EQ(MessageOf(R"({"doors": 5})"), "car.json: five doors are not made");
  EXPECT_EQ(MessageOf("[]"), "car.json: expected an object, got []");
}

TEST(ReadSettings, TakesAWholeNumberThatIsWrittenWithAFraction) {
  EXPECT_EQ(Read(R"({"doors": 2.0})").doors, 2);
  EXPECT_EQ(Read(R"({"doors": 2e0})").doors, 2);
  EXPECT_EQ(MessageOf(R"({"doors": 7.0})"),
            "car.json: doors: expected a whole number in 0 … 6, got 7.0");
  EXPECT_EQ(MessageOf(R"({"doors": 1e300})"),
            "car.json: doors: expected a whole number in 0 … 6, got 1e+300");
}

TEST(WriteSettings, IsReadBackAsWritten) {
  const Car car = Read(R"({"doors": 2, "colour": "blue", "wheels": [{"radius": 0.4}, {}]})");
  const Json json = WriteSettings(car);
  EXPECT_EQ(WriteSettings(ReadSettings<Car>(json, {"again", ""})), json);
  EXPECT_EQ(json.at("wheels").at(1).at("radius"), 0.3);
}

TEST(Describe, ListsEveryFieldWithUnitRangeAndOrigin) {
  const auto lines = Describe<Car>("car");
  const auto found = std::find_if(lines.begin(), lines.end(), [](const auto& line) {
    return line.key == "car.wheels[].radius";
  });
  ASSERT_NE(found, lines.end());
  EXPECT_EQ(found->unit, "m");
  EXPECT_EQ(found->range, "0 … 2");
  EXPECT_EQ(found->default_value, "0.3");
  EXPECT_EQ(found->origin, "guessed");
}

}  // namespace
}  // namespace vitruvia
