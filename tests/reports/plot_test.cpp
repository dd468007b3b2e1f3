#include "reports/plot.h"

#include <cmath>

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/files.h"
#include "reports/run_plots.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
using testing::HasSubstr;

TEST(NiceTicks, AreRoundAndFew) {
  for (const double end : {1e-4, 0.0317, 0.9, 1.0, 7.3, 25.0, 299.0, 12345.0}) {
    const Ticks ticks = NiceTicks(end, 5);
    const double mantissa = ticks.step / std::pow(10.0, std::floor(std::log10(ticks.step) + 1e-9));
    EXPECT_THAT(mantissa,
                testing::AnyOf(testing::DoubleNear(1.0, 1e-9), testing::DoubleNear(2.0, 1e-9),
                               testing::DoubleNear(5.0, 1e-9)));
    EXPECT_LE(end / ticks.step, 5.0 + 1e-9);
    EXPECT_GT(end / ticks.step, 1.9);
    // Printed ticks differ from each other.
    EXPECT_GE(ticks.step, std::pow(10.0, -ticks.decimals) * (1.0 - 1e-9));
  }
}

ReportedExperiment TwoScenes() {
  ReportedExperiment experiment;
  experiment.record.expectations = {{"frame_ms_median", 25.0, 25.0, "paper A, table 1", ""}};
  for (const char* run_id : {"walk-a", "kick-a", "walk-b"}) {
    RunRecord record;
    record.run_id = run_id;
    record.scene = record.run_id.substr(0, 4);
    record.diagonal_m = 2.0;
    record.frames = {{"l2_mean_m", {0.1, std::nan(""), 0.3}},
                     {"l2_max_m", {1.0, 2.0, 3.0}},
                     {"frame_ms", {5.0, 6.0, 7.0}},
                     {"failed", {0.0, 1.0, 0.0}}};
    record.threshold_m = {0.0, 0.1};
    record.joint_accuracy = {{"all", {0.5, 1.0}}};
    record.summary = {
        {"frame_ms_median", 6.0}, {"frame_ms_p95", 7.0}, {"l2_mean_of_diagonal", 0.1}};
    experiment.runs.push_back({run_id, record, ""});
  }
  return experiment;
}

TEST(MakeFigures, GroupsRunsByScene) {
  std::vector<std::string> names;
  for (const Figure& figure : MakeFigures(TwoScenes())) names.push_back(figure.name);
  EXPECT_THAT(names, testing::ElementsAre("error-per-frame-walk", "error-per-frame-kick",
                                          "speed-against-error", "joint-accuracy-walk",
                                          "joint-accuracy-kick", "time-per-frame-walk",
                                          "time-per-frame-kick"));
}

TEST(MakeFigures, ShowsTheStoredNumbers) {
  const std::vector<Figure> figures = MakeFigures(TwoScenes());
  const Panel& mean = figures[0].panels[0];
  ASSERT_EQ(mean.series.size(), 2u);
  EXPECT_EQ(mean.series[1].name, "walk-b");
  EXPECT_EQ(mean.series[0].y[0], 0.05);  // of the diagonal
  EXPECT_TRUE(std::isnan(mean.series[0].y[1]));
  EXPECT_EQ(mean.series[0].failed_x, std::vector<double>{1.0});
  EXPECT_EQ(figures[0].panels[1].series[0].y[2], 1.5);
  const Panel& speed = figures[2].panels[0];
  EXPECT_EQ(speed.series.size(), 3u);
  EXPECT_EQ(speed.series[0].x[0], 6.0);
  EXPECT_EQ(speed.series[0].x_reach[0], 7.0);
  EXPECT_EQ(speed.x_references[0].value, 25.0);
  EXPECT_EQ(speed.x_references[0].label, "paper A, table 1: 25 ms");
  EXPECT_EQ(figures[3].panels[0].series[0].y[0], 50.0);  // percent
  EXPECT_EQ(figures[3].panels[0].series[0].x[1], 10.0);  // cm
}

TEST(MakeFigures, ManyRunsGoToSeveralFigures) {
  ReportedExperiment experiment = TwoScenes();
  const ReportedRun walk = experiment.runs[0];
  experiment.runs.assign(8, walk);
  const std::vector<Figure> figures = MakeFigures(experiment);
  EXPECT_EQ(figures[0].name, "error-per-frame-walk");
  EXPECT_EQ(figures[0].panels[0].series.size(), 7u);
  EXPECT_EQ(figures[1].name, "error-per-frame-walk-2");
  EXPECT_EQ(figures[1].panels[0].series.size(), 1u);
}

TEST(MakeFigures, NamesTheRunAndTheSeriesThatIsMissing) {
  ReportedExperiment experiment = TwoScenes();
  experiment.runs[1].record->frames.erase("l2_max_m");
  EXPECT_THAT([&] { MakeFigures(experiment); },
              testing::ThrowsMessage<DataError>(
                  HasSubstr("run kick-a: record.json: frames.l2_max_m: key missing")));
}

TEST(DrawingWriter, IsSilentAndDrawsWhereAsked) {
  const TemporaryFolder folder;
  testing::internal::CaptureStderr();
  DrawingWriter writer;
  writer.Write(folder / "dash", 100, 50, [](Canvas& canvas) {
    canvas.Polyline({{10.0, 20.0}, {40.0, 20.0}}, {{255, 0, 0}, 2.0, 10.0});
    canvas.Rectangle({60.0, 5.0}, 30.0, 10.0, {0, 0, 255});
  });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  const std::string svg = ReadWholeFile(folder / "dash.svg");
  EXPECT_THAT(svg, HasSubstr("viewBox=\"0 0 100 50\""));
  // Two dashes of 10 units, and a gap between them.
  EXPECT_THAT(svg, HasSubstr("10,20\n20,20\n"));
  EXPECT_THAT(svg, HasSubstr("30,20\n40,20\n"));
  EXPECT_THAT(svg, testing::Not(HasSubstr("20,20\n30,20\n")));
  EXPECT_THAT(svg, HasSubstr("fill=\"#0000ff\""));
}

}  // namespace
}  // namespace vitruvia
