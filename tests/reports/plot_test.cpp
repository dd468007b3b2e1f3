#include "reports/drawing/plot.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/files.h"
#include "reports/drawing/axis.h"
#include "reports/drawing/color_maps.h"
#include "reports/drawing/drawing_writer.h"
#include "reports/drawing/thumbnail.h"
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
  EXPECT_THAT(Labels(Axis::Linear(0.0, 0.0317), 5),
              testing::ElementsAre("0.00", "0.01", "0.02", "0.03"));
  EXPECT_THAT(Labels(Axis::Linear(0.0, 100.0), 5),
              testing::ElementsAre("0", "20", "40", "60", "80", "100"));
  EXPECT_THAT(Labels(Axis::Linear(0.0, 299.0), 3), testing::ElementsAre("0", "100", "200"));
  EXPECT_THAT(Labels(Axis::Linear(96.3, 99.9), 4), testing::ElementsAre("97", "98", "99"));
  EXPECT_THAT(Labels(Axis::Logarithmic(3.0, 286.0), 10),
              testing::ElementsAre("2", "5", "10", "20", "50", "100", "200", "500"));
  // Decades alone only where there are three of them.
  EXPECT_EQ(Labels(Axis::Logarithmic(3.0, 286.0), 5).size(), 8u);
  EXPECT_THAT(Labels(Axis::Logarithmic(3.0, 2860.0), 5), testing::ElementsAre("10", "100", "1000"));
  EXPECT_THAT(Labels(Axis::Logarithmic(0.5, 0.5), 5), testing::ElementsAre("0.5", "1"));
}

TEST(Axis, SharesRunFromStartToEnd) {
  EXPECT_DOUBLE_EQ(Axis::Linear(0.0, 4.0).Share(1.0), 0.25);
  EXPECT_DOUBLE_EQ(Axis::Linear(2.0, 4.0).Share(3.0), 0.5);
  EXPECT_TRUE(Axis::Linear(2.0, 4.0).Holds(4.0));
  EXPECT_FALSE(Axis::Linear(2.0, 4.0).Holds(4.1));
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
    record.variant = record.run_id.substr(5);
    record.seed = 1;
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
  EXPECT_EQ(mean.series[1].name, "b");
  EXPECT_EQ(figures[0].runs[1].second, std::vector<std::string>{"walk-b"});
  EXPECT_EQ(mean.series[0].y[0], 0.05);  // of the diagonal
  EXPECT_TRUE(std::isnan(mean.series[0].y[1]));
  EXPECT_EQ(mean.series[0].failed_x, std::vector<double>{1.0});
  EXPECT_EQ(figures[0].panels[1].series[0].y[2], 1.5);
  const Panel& speed = figures[2].panels[0];
  ASSERT_EQ(speed.title, "walk");
  ASSERT_EQ(speed.series.size(), 3u);  // the front, and two variants
  EXPECT_EQ(speed.series[1].x[0], 6.0);
  EXPECT_DOUBLE_EQ(speed.series[1].x_reach[0], 6.9);  // 95th percentile of 5 and 7
  EXPECT_DOUBLE_EQ(speed.series[1].y[0], 0.1);
  EXPECT_EQ(speed.x_references[0].value, 25.0);
  EXPECT_EQ(speed.x_references[0].label, "paper A, table 1: 25 ms");
  EXPECT_EQ(figures[3].panels[0].series[0].y[0], 50.0);  // percent
  EXPECT_EQ(figures[3].panels[0].series[0].x[1], 10.0);  // cm
}

TEST(MakeFigures, ManyVariantsGoToSeveralFigures) {
  ReportedExperiment experiment = TwoScenes();
  const ReportedRun walk = experiment.runs[0];
  experiment.runs.assign(8, walk);
  for (std::size_t i = 0; i < 8; ++i) experiment.runs[i].record->variant = std::string(i + 1, 'v');
  const std::vector<Figure> figures = MakeFigures(experiment);
  EXPECT_EQ(figures[0].name, "error-per-frame-walk");
  EXPECT_EQ(figures[0].panels[0].series.size(), 7u);
  EXPECT_EQ(figures[1].name, "error-per-frame-walk-2");
  EXPECT_EQ(figures[1].panels[0].series.size(), 1u);
}

TEST(MakeFigures, SeedsAreOneLineWithABand) {
  ReportedExperiment experiment = TwoScenes();
  experiment.runs.resize(1);
  experiment.runs.push_back(experiment.runs[0]);
  experiment.runs[1].record->seed = 2;
  experiment.runs[1].record->frames["l2_mean_m"] = {0.2, 0.4, std::nan("")};
  const Series line = MakeFigures(experiment)[0].panels[0].series.at(0);
  EXPECT_DOUBLE_EQ(line.y[0], 0.075);  // of 0.1 and 0.2 m, the diagonal being 2 m
  EXPECT_DOUBLE_EQ(line.y_low[0], 0.05);
  EXPECT_DOUBLE_EQ(line.y_high[0], 0.1);
  EXPECT_DOUBLE_EQ(line.y[1], 0.2);  // of the seed that has it
  EXPECT_DOUBLE_EQ(line.y_low[2], 0.15);
}

TEST(MakeFigures, NamesTheRunAndTheSeriesThatIsMissing) {
  ReportedExperiment experiment = TwoScenes();
  experiment.runs[1].record->frames.erase("l2_max_m");
  EXPECT_THAT([&] { MakeFigures(experiment); },
              testing::ThrowsMessage<DataError>(
                  HasSubstr("run kick-a: record.json: frames.l2_max_m: key missing")));
}

int DashedLines(const Panel& panel) {
  Canvas canvas;
  DrawFigure(canvas, {"f", "", "", 1, {panel}});
  int dashed = 0;
  for (const PageShape& shape : canvas.shapes()) {
    const auto* line = std::get_if<PolylineShape>(&shape);
    dashed += line != nullptr && line->stroke.dash > 0.0 ? 1 : 0;
  }
  return dashed;
}

TEST(DrawFigure, ANumberThatIsNotComparableStretchesNoAxis) {
  Panel panel{"", "x", "y", {}, {{"paper", 10.0, true}}, {}};
  Series line;
  line.name = "ours";
  line.x = {0.0, 1.0};
  line.y = {0.1, 0.2};
  panel.series = {line};
  constexpr int kNoteSample = 1;
  EXPECT_EQ(DashedLines(panel), kNoteSample + 1);
  panel.y_references[0].stretches_axis = false;
  EXPECT_EQ(DashedLines(panel), kNoteSample);
  panel.y_references[0].value = 0.15;
  EXPECT_EQ(DashedLines(panel), kNoteSample + 1);
}

TEST(DrawFigure, KeepsItsTextInsideAtAnyWidth) {
  Panel panel{"a title that is long enough to need two lines in a column",
              "a label of the x axis",
              "mean L2 error / diagonal (a long label)",
              {},
              {{"paper A, figure 11: 0.001", 0.1}},
              {}};
  for (const char* name : {"default,fit.edge_px=2,joint_weight=0.5", "another_variant"}) {
    Series line;
    line.name = name;
    line.x = {0.0, 1.0};
    line.y = {0.1, 0.2};
    panel.series.push_back(line);
  }
  const Figure figure{"f", "", "", 3, {panel, panel, panel}};
  for (const double width : {238.0, 500.0, 780.0}) {
    const FigureStyle style{width, width < 600.0 ? 8.0 : 13.0};
    Canvas canvas;
    DrawFigure(canvas, figure, style);
    const double height = FigureHeight(figure, style);
    for (const PageShape& shape : canvas.shapes()) {
      const auto* text = std::get_if<TextShape>(&shape);
      if (text == nullptr) continue;
      const bool upwards = text->style.direction == Direction::kUpwards;
      const double length = TextWidth(text->text, text->style);
      const double before = text->style.anchor == Anchor::kStart    ? 0.0
                            : text->style.anchor == Anchor::kMiddle ? 0.5 * length
                                                                    : length;
      const double start = upwards ? text->at.y + before : text->at.x - before;
      const double end = upwards ? start - length : start + length;
      EXPECT_GE(std::min(start, end), -0.5) << text->text << " at " << width;
      EXPECT_LE(std::max(start, end), (upwards ? height : width) + 0.5) << text->text;
    }
  }
}

constexpr FigureStyle kColumn{238.0, 8.0};  // 84 mm and 8 pt

std::vector<TextShape> TextsOf(const Figure& figure, const FigureStyle& style) {
  Canvas canvas;
  DrawFigure(canvas, figure, style);
  std::vector<TextShape> texts;
  for (const PageShape& shape : canvas.shapes()) {
    if (const auto* text = std::get_if<TextShape>(&shape)) texts.push_back(*text);
  }
  return texts;
}

bool HasText(const std::vector<TextShape>& texts, const std::string& wanted) {
  return std::any_of(texts.begin(), texts.end(),
                     [&](const TextShape& text) { return text.text == wanted; });
}

TEST(DrawFigure, NamesBesideBarsAreWholeWhereTheyFit) {
  Series bars;
  bars.mark = Mark::kStackedBars;
  bars.x = {1.0, 2.0};
  bars.y = {0.0, 1.0};
  Panel panel{"", "time (ms)", "", {bars}, {}, {}};
  panel.y_ticks = {{0.0, "fitted_subject"}, {1.0, "fit.pair_cutoff_m=0.02"}};
  Figure figure;
  figure.panels = {panel};
  const std::vector<TextShape> texts = TextsOf(figure, kColumn);
  EXPECT_TRUE(HasText(texts, "fitted_subject"));
  EXPECT_TRUE(HasText(texts, "fit.pair_cutoff_m=0.02"));
}

TEST(DrawFigure, ASinglePanelIsAsWideAsTheFigure) {
  Series line;
  line.x = {0.0, 4.0};
  line.y = {0.00076, 0.00082};
  Figure figure;
  figure.columns = 2;
  figure.panels = {{"", "time (ms)", "mean L2 error / diagonal", {line}, {}, {}}};
  double last_tick = 0.0;
  for (const TextShape& text : TextsOf(figure, kColumn)) {
    if (text.text == "4") last_tick = text.at.x;
  }
  EXPECT_GT(last_tick, 0.8 * kColumn.width);
}

TEST(DrawFigure, CellsAreAtLeastAsWideAsTheirNumbers) {
  Panel panel{"mean joint error (mm)", "cutoff", "iterations", {}, {}, {}};
  panel.x_ticks = {{0.0, "0.02"}, {1.0, "0.08"}, {2.0, "0.32"}};
  panel.y_ticks = {{0.0, "2"}};
  panel.cells = CellMap{{{135.86, 110.46, 114.01}}, {{"135.86", "110.46", "114.01"}}, {}};
  Figure figure;
  figure.columns = 2;
  figure.panels = {panel, panel};
  std::vector<TextShape> row;
  for (const TextShape& text : TextsOf(figure, kColumn)) {
    if (text.text == "135.86" || text.text == "110.46") row.push_back(text);
  }
  ASSERT_EQ(row.size(), 4u);
  EXPECT_GT(row[1].at.x - row[0].at.x, TextWidth(row[0].text, row[0].style));
}

TEST(WrappedText, BreaksAtSpacesAndThenAtSignsOfNames) {
  const TextStyle style;
  const double width = TextWidth("default,", style) + 0.1;
  EXPECT_THAT(WrappedText("a default,edge", width, style),
              testing::ElementsAre("a", "default,", "edge"));
  EXPECT_THAT(WrappedText("", width, style), testing::IsEmpty());
}

// CIE 1976 lightness and colours of sRGB.
std::array<double, 3> Lab(const Color& color) {
  std::array<double, 3> linear{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double v = color[c] / 255.0;
    linear[c] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  const auto [r, g, b] = linear;
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
  const double y = f(0.2126 * r + 0.7152 * g + 0.0722 * b);
  const double z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

TEST(ColorMaps, StepsLookEqualAndDarkenSteadily) {
  constexpr int kSteps = 20;
  for (Color (*map)(double) : {DepthColor, ErrorColor}) {
    double shortest = 1e9, longest = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const auto a = Lab(map(static_cast<double>(i) / kSteps));
      const auto b = Lab(map(static_cast<double>(i + 1) / kSteps));
      EXPECT_LT(b[0], a[0]);
      const double step = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      shortest = std::min(shortest, step);
      longest = std::max(longest, step);
    }
    EXPECT_LT(longest, 2.6 * shortest);
  }
}

TEST(DrawingWriter, WritesTheSameShapesInEveryFormat) {
  const TemporaryFolder folder;
  testing::internal::CaptureStderr();
  const DrawingWriter writer({1.0, 2.0, {FileFormat::kSvg, FileFormat::kPdf, FileFormat::kPng}});
  const auto draw = [](Canvas& canvas) {
    canvas.Polyline({{10.0, 20.0}, {40.0, 20.0}}, {{255, 0, 0}, 2.0, 10.0});
    canvas.Rectangle({60.0, 5.0}, 30.0, 10.0, {0, 0, 255});
    canvas.Text({10.0, 40.0}, "−5 ≤ x", {.size = 9.0});
  };
  writer.Write(folder / "a", 100, 50, draw);
  writer.Write(folder / "b", 100, 50, draw);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  const std::string svg = ReadWholeFile(folder / "a.svg");
  EXPECT_THAT(svg, HasSubstr("viewBox=\"0 0 100 50\" width=\"100pt\" height=\"50pt\""));
  EXPECT_THAT(svg, HasSubstr("points=\"10,20 40,20\""));
  EXPECT_THAT(svg, HasSubstr("stroke-dasharray=\"10\""));
  EXPECT_THAT(svg, HasSubstr("fill=\"#0000ff\""));
  EXPECT_THAT(svg, HasSubstr(">−5 ≤ x</text>"));
  const std::string pdf = ReadWholeFile(folder / "a.pdf");
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 100 50 ]"));
  EXPECT_THAT(pdf, HasSubstr("LiberationSans"));
  EXPECT_THAT(pdf, HasSubstr("/FontFile"));   // embedded
  EXPECT_THAT(pdf, HasSubstr("/ToUnicode"));  // text stays text
  EXPECT_EQ(pdf, ReadWholeFile(folder / "b.pdf"));
  const ColorImage png = ReadPng(folder / "a.png");
  EXPECT_EQ(png.width(), 200);
  EXPECT_EQ(png(150, 20), (ColorPixel{0, 0, 255, 255}));
  EXPECT_EQ(png(30, 40), (ColorPixel{255, 0, 0, 255}));      // in the first dash
  EXPECT_EQ(png(50, 40), (ColorPixel{255, 255, 255, 255}));  // in the gap
}

}  // namespace
}  // namespace vitruvia
