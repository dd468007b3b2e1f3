// What a sweep stands for, and which are refused.
#include "experiments/plan/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/command_line.h"
#include "experiments/plan/run_plan.h"

namespace vitruvia {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

SweepSettings Sweep(const Json& json) {
  return ReadSettings<SweepSettings>(json, {"sweep.json", ""});
}

std::vector<std::string> Labels(const Json& json) {
  std::vector<std::string> labels;
  for (const SweepPoint& point : PointsOf(Sweep(json))) labels.push_back(point.label);
  return labels;
}

SweepAxis Axis(const Json& json) { return ReadSettings<SweepAxis>(json, {"axis.json", ""}); }

std::string Refusal(const Json& json) {
  try {
    Sweep(json);
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

Json OneAxis(const Json& axis) { return {{"axes", Json::array({axis})}}; }

TEST(Sweep, GridIsEveryCombinationTheLastAxisFastest) {
  const Json sweep = {{"axes",
                       {{{"setting", "method.settings.fit.edge_px"}, {"values", {1, 2.5}}},
                        {{"setting", "scene.sensor.model"}, {"values", {"none", "kinect_v1"}}}}}};
  EXPECT_THAT(Labels(sweep), ElementsAre(",fit.edge_px=1,scene.sensor.model=none",
                                         ",fit.edge_px=1,scene.sensor.model=kinect_v1",
                                         ",fit.edge_px=2.5,scene.sensor.model=none",
                                         ",fit.edge_px=2.5,scene.sensor.model=kinect_v1"));
  const SweepPoint last = PointsOf(Sweep(sweep)).back();
  EXPECT_EQ(last.method, Json({{"settings", {{"fit", {{"edge_px", 2.5}}}}}}));
  EXPECT_EQ(last.scene, Json({{"sensor", {{"model", "kinect_v1"}}}}));
}

TEST(Sweep, OneAtATimeBeginsWithNothingChanged) {
  const Json sweep = {{"design", "one_at_a_time"},
                      {"axes",
                       {{{"setting", "method.settings.a"}, {"values", {0, 1}}},
                        {{"setting", "method.settings.b"}, {"values", {true}}}}}};
  EXPECT_THAT(Labels(sweep), ElementsAre("", ",a=0", ",a=1", ",b=true"));
  EXPECT_EQ(PointsOf(Sweep(sweep))[3].method, Json({{"settings", {{"b", true}}}}));
}

TEST(Sweep, WithoutAxesIsOnePointThatChangesNothing) {
  const std::vector<SweepPoint> points = PointsOf(SweepSettings());
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].label, "");
  EXPECT_EQ(points[0].scene, Json::object());
  EXPECT_EQ(points[0].method, Json::object());
}

TEST(Sweep, RangesHoldBothEndsAndRoundNumbers) {
  const Json range = {{"setting", "scene.x"}, {"from", 0.1}, {"to", 0.5}, {"steps", 5}};
  EXPECT_EQ(Json(ValuesOf(Axis(range))).dump(), "[0.1,0.2,0.3,0.4,0.5]");
  Json logarithmic = range;
  logarithmic["to"] = 1000;
  logarithmic["scale"] = "log";
  EXPECT_EQ(Json(ValuesOf(Axis(logarithmic))).dump(), "[0.1,1,10,100,1000]");
}

TEST(Sweep, ValuesWithPathsKeepTheNameAFoldersName) {
  EXPECT_THAT(Labels(OneAxis({{"setting", "scene.motion.file"}, {"values", {"../a b.json"}}})),
              ElementsAre(",scene.motion.file=.._a_b.json"));
}

TEST(Sweep, WhatGoesAlongChangesWithTheValueAndHasNoPartInTheName) {
  const Json axis = {{"setting", "scene.motion.speed"},
                     {"values", {1, 2}},
                     {"along", {{"scene.frames", {240, 120}}}}};
  EXPECT_THAT(Labels(OneAxis(axis)), ElementsAre(",scene.motion.speed=1", ",scene.motion.speed=2"));
  EXPECT_EQ(PointsOf(Sweep(OneAxis(axis)))[1].scene,
            Json({{"motion", {{"speed", 2}}}, {"frames", 120}}));
  Json short_of_one = axis;
  short_of_one["along"]["scene.frames"] = {240};
  EXPECT_THAT(
      Refusal(OneAxis(short_of_one)),
      HasSubstr(
          "along: scene.frames: expected a value for each of the 2 values of the axis, got 1"));
  Json of_itself = axis;
  of_itself["along"] = {{"scene.motion.speed", {3, 4}}};
  EXPECT_THAT(Refusal(OneAxis(of_itself)),
              HasSubstr("scene.motion.speed: the axis itself sets it"));
}

TEST(Sweep, SettingsGoAlongWithARange) {
  const Json axis = {{"setting", "scene.motion.speed"},
                     {"from", 1},
                     {"to", 2},
                     {"steps", 2},
                     {"along", {{"scene.frames", {240, 120}}}}};
  EXPECT_EQ(PointsOf(Sweep(OneAxis(axis)))[1].scene,
            Json({{"motion", {{"speed", 2}}}, {"frames", 120}}));
}

TEST(Sweep, ImpossibleOnesAreRefused) {
  EXPECT_THAT(Refusal(OneAxis({{"setting", "fit.edge_px"}, {"values", {1}}})),
              HasSubstr("axes[0]: setting: expected scene.KEY"));
  EXPECT_THAT(Refusal(OneAxis({{"setting", "scene..x"}, {"values", {1}}})),
              HasSubstr("got \"scene..x\""));
  EXPECT_THAT(Refusal(OneAxis({{"setting", "scene.x"}})),
              HasSubstr("expected values, or a range: from, to and steps"));
  EXPECT_THAT(Refusal(OneAxis({{"setting", "scene.x"}, {"values", {1}}, {"steps", 3}})),
              HasSubstr("expected either values or a range, got both"));
  EXPECT_THAT(Refusal(OneAxis({{"setting", "scene.x"}, {"values", {{{"a", 1}}}}})),
              HasSubstr("expected numbers, texts, true or false, got {\"a\":1}"));
  EXPECT_THAT(Refusal(OneAxis({{"setting", "scene.x"}, {"steps", 1}})),
              HasSubstr("a range has at least its two ends, got 1"));
  EXPECT_THAT(Refusal(OneAxis({{"setting", "scene.x"}, {"to", 3}, {"steps", 2}, {"scale", "log"}})),
              HasSubstr("expected positive ends, got 0 and 3"));
  EXPECT_THAT(Refusal(OneAxis({{"setting", "scene.seed"}, {"values", {1}}})),
              HasSubstr("seeds have a list of their own"));
  const Json many = {{"setting", "scene.x"}, {"to", 1}, {"steps", 200}};
  Json more = many;
  more["setting"] = "scene.y";
  EXPECT_THAT(Refusal({{"axes", {many, more}}}),
              HasSubstr("the grid has 40000 points, expected at most 10000"));
  const Json axis = {{"setting", "scene.x"}, {"values", {1}}};
  EXPECT_THAT(Refusal({{"axes", {axis, axis}}}), HasSubstr("the setting scene.x stands twice"));
}

TEST(SweptExperiment, CrossesVariantsSeedsAndRepeats) {
  const SmallExperiment files;
  Json config = SmallExperiment::Config();
  config["variants"] = {{{"name", "a"}}, {{"name", "b"}, {"scene", {{"frames", 6}}}}};
  config["sweep"] = OneAxis({{"setting", "method.settings.axis_weight"}, {"values", {0, 2}}});
  config["seeds"] = {4, 5};
  config["repeats"] = 2;
  files.Write("swept.json", config);
  const ExperimentPlan plan = PlanExperiment(files / "swept.json");
  ASSERT_EQ(plan.runs.size(), 16u);
  EXPECT_EQ(plan.runs[0].variant, "a,axis_weight=0");
  EXPECT_EQ(plan.runs[15].variant, "b,axis_weight=2");
  EXPECT_EQ(plan.runs[15].scene_settings.frames, 6);
  EXPECT_EQ(plan.runs[15].method.settings.at("axis_weight"), 2.0);
  EXPECT_EQ(plan.runs[15].seed, 5);
  EXPECT_EQ(plan.runs[15].repeat, 2);
  EXPECT_THAT(plan.runs[15].run_id, HasSubstr("b,axis_weight=2.scene.method.s5.r2."));
  EXPECT_EQ(plan.runs[14].resolved, plan.runs[15].resolved);
}

TEST(SweptExperiment, WhatItCannotNameIsRefused) {
  const SmallExperiment files;
  const auto refused = [&files](const Json& changes, const std::vector<std::string>& words) {
    files.Write("bad.json", Merged(SmallExperiment::Config(), changes));
    ExpectRefusal({"run", files.File("bad.json"), "--dry-run"}, ExitCode::kBadConfiguration, words);
  };
  const auto swept = [](const std::string& setting, const Json& values) -> Json {
    return {{"sweep", OneAxis({{"setting", setting}, {"values", values}})}};
  };
  refused(swept("method.settings.axis_wieght", {1}),
          {"variant \"default,axis_wieght=1\"", "method.json: settings.axis_wieght: unknown key",
           "did you mean \"axis_weight\"?"});
  refused(swept("method.settings.axis_weight", {-1}),
          {"variant \"default,axis_weight=-1\"", "expected a number in 0", "got -1"});
  refused(swept("method.settings.axis_weight", {1, 1}),
          {"bad.json: the sweep makes two variants of the name default,axis_weight=1"});
  refused(swept("scene.title", {"a b", "a_b"}), {"two variants of the name"});
  refused(swept("scene.title", {std::string(200, 'x')}), {"expected at most 200"});
  Json large = swept("scene.fps", Json::array());
  large["sweep"]["axes"][0] = {{"setting", "scene.fps"}, {"from", 1}, {"to", 9}, {"steps", 900}};
  large["repeats"] = 1000;
  refused(large, {"bad.json: stands for 900000 runs, expected at most 100000"});
  refused({{"repeats", 0}}, {"repeats: expected a whole number in 1"});
  refused({{"seeds", {1, 1}}}, {"stands twice"});
}

}  // namespace
}  // namespace vitruvia
