#include "reports/drawing/plot.h"

#include <cmath>

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/files.h"
#include "reports/drawing/axis.h"
#include "reports/figures/run_plots.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
using testing::HasSubstr;

TEST(RoundedUp, GivesOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(RoundedUp(1e-4), 1e-4);
  EXPECT_DOUBLE_EQ(RoundedUp(0.011), 0.02);
  EXPECT_DOUBLE_EQ(RoundedUp(0.2), 0.2);
  EXPECT_DOUBLE_EQ(RoundedUp(2.0001), 5.0);
  EXPECT_DOUBLE_EQ(RoundedUp(51.0), 100.0);
  EXPECT_DOUBLE_EQ(RoundedUp(1000.0), 1000.0);
}

std::vector<std::string> Labels(const Axis& axis, int count) {
  std::vector<std::string> labels;
  for (const Tick& tick : axis.Ticks(count)) labels.push_back(tick.label);
  return labels;
}

TEST(Axis, TicksAreRoundAndPrintedWithAsManyDecimalsAsTheyNeed) {
  EXPECT_THAT(Labels(Axis::Linear(0.0317), 5),
              testing::ElementsAre("0.00", "0.01", "0.02", "0.03"));
  EXPECT_THAT(Labels(Axis::Linear(100.0), 5),
              testing::ElementsAre("0", "20", "40", "60", "80", "100"));
  EXPECT_THAT(Labels(Axis::Linear(299.0), 3), testing::ElementsAre("0", "100", "200"));
  EXPECT_THAT(Labels(Axis::Logarithmic(3.0, 286.0), 5),
              testing::ElementsAre("2", "5", "10", "20", "50", "100", "200", "500"));
  EXPECT_THAT(Labels(Axis::Logarithmic(0.5, 0.5), 5), testing::ElementsAre("0.5", "1"));
}

TEST(Axis, SharesRunFromStartToEnd) {
  EXPECT_DOUBLE_EQ(Axis::Linear(4.0).Share(1.0), 0.25);
  const Axis decades = Axis::Logarithmic(1.0, 1000.0);
  EXPECT_DOUBLE_EQ(decades.Share(1.0), 0.0);
  EXPECT_DOUBLE_EQ(decades.Share(10.0), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(decades.Share(1000.0), 1.0);
  EXPECT_DOUBLE_EQ(decades.Share(0.0), 0.0);
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
  ASSERT_EQ(speed.series.size(), 1u);  // one variant in three runs: all frames together
  EXPECT_EQ(speed.series[0].x[0], 6.0);
  EXPECT_EQ(speed.series[0].x_reach[0], 7.0);
  EXPECT_DOUBLE_EQ(speed.series[0].y[0], 0.1);
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
