// The viewer's page, by its content and in a real browser. The latter is skipped where there is no
// chromium.
#include "reports/viewer/viewer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "metrics/vertex_error.h"
#include "records/estimate.h"
#include "reports/browser.h"
#include "reports/pages/index_page.h"
#include "reports/pages/report.h"
#include "reports/synthetic_experiment.h"
#include "reports/viewer/packing.h"
#include "reports/viewer/thinned_mesh.h"
#include "sequence/sequence.h"
#include "support/count.h"
#include "support/temporary_folder.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Ge;
using testing::HasSubstr;
using testing::Le;
using testing::Not;
using testing::SizeIs;

nlohmann::json ContentOf(const fs::path& page) {
  const std::string text = ReadWholeFile(page), begin = "id=\"content\">";
  const std::size_t at = text.find(begin) + begin.size();
  return nlohmann::json::parse(text.substr(at, text.find("</script>", at) - at));
}

TEST(StoredFrames, AreAllWhereThereIsRoom) {
  EXPECT_THAT(StoredFrames(4, 10, {}), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(StoredFrames(1, 10, {}), ElementsAre(0));
}

TEST(StoredFrames, HoldBothEndsAndWhatIsWanted) {
  EXPECT_THAT(StoredFrames(101, 5, {13, 100, 500}), ElementsAre(0, 13, 25, 50, 75, 100));
}

TEST(PositionGrid, IsFineEnough) {
  Eigen::AlignedBox3f box(Vector3f(-1.0f, -2.0f, 1.0f), Vector3f(1.5f, 0.4f, 3.0f));
  const PositionGrid grid = PositionGrid::Over(box);
  const Vector3f point(0.123456f, -1.987654f, 2.718281f);
  const std::vector<std::uint16_t> cells = grid.Quantised({point, box.max(), Vector3f(9, 9, 9)});
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(grid.origin[axis] + grid.step_m * cells[axis], point[axis], 0.00005 + 1e-6);
    EXPECT_NEAR(grid.origin[axis] + grid.step_m * cells[3 + axis], box.max()[axis], 0.00005 + 1e-6);
    EXPECT_EQ(cells[6 + axis], 65535) << "points outside are held at the border";
  }
}

// Vertices 0 … 3 of two triangles: 2 has 0 and 1 before it, 3 has 1 and 2.
TEST(EarlierNeighbours, ShareAnEdgeAndStandBefore) {
  const EarlierNeighbours neighbours({{0, 1, 2}, {1, 3, 2}, {2, 1, 0}, {2, 3, 1}}, 5);
  EXPECT_THAT(neighbours.Of(0), SizeIs(0));
  EXPECT_THAT(neighbours.Of(1), ElementsAre(0));
  EXPECT_THAT(neighbours.Of(2), ElementsAre(0, 1, 1));  // the inner edge, from either side
  EXPECT_THAT(neighbours.Of(3), ElementsAre(1, 2));
  EXPECT_THAT(neighbours.Of(4), ElementsAre(3)) << "without an edge: the vertex before";
}

TEST(ThinnedMesh, KeepsVerticesOfTheMesh) {
  const TriangleMesh rest = TinyBody(6).rest;
  const auto count = static_cast<int>(rest.vertices.size());
  EXPECT_THAT(Thinned(rest, count).triangles, SizeIs(rest.triangles.size()));
  const ThinnedMesh thinned = Thinned(rest, count / 3);
  EXPECT_THAT(thinned.kept.size(), AllOf(Ge(count / 4u), Le(count / 2u)));
  const TriangleMesh mesh{thinned.Of(rest.vertices), thinned.triangles};
  EXPECT_EQ(InspectMesh(mesh).problem, "");
  EXPECT_NEAR(EnclosedVolume(mesh), EnclosedVolume(rest), 0.05 * EnclosedVolume(rest));
}

class ViewerPage : public testing::Test {
 protected:
  ViewerPage() : experiment_(WriteSyntheticExperiment(folder_.path())) {}
  fs::path Run(const std::string& run_id) const { return experiment_ / run_id; }

  const TemporaryFolder folder_;
  const fs::path experiment_;
  const fs::path page_ = folder_ / "page.html";
};

TEST_F(ViewerPage, NeedsNoNetwork) {
  WriteViewer({Run(kWavingRun)}, {}, page_);
  const std::string text = ReadWholeFile(page_);
  EXPECT_THAT(text, Not(HasSubstr("src=\"")));
  EXPECT_THAT(text, Not(HasSubstr("<link rel=\"stylesheet")));
  EXPECT_EQ(Count(text, "<title>" + std::string(kWavingRun) + "</title>"), 1u);
}

TEST_F(ViewerPage, RunsOfOneSequenceShareIt) {
  WriteViewer({Run(kWavingRun), Run(kExactRun)}, {}, page_);
  const nlohmann::json content = ContentOf(page_);
  EXPECT_THAT(content.at("sequences"), SizeIs(1));
  EXPECT_THAT(content.at("runs"), SizeIs(2));
  EXPECT_THAT(content.at("notes"), SizeIs(0));
}

TEST_F(ViewerPage, SaysWhatItLeavesOut) {
  WriteViewer({Run(kWavingRun)}, {.most_frames = 5, .most_vertices = 300}, page_);
  const nlohmann::json content = ContentOf(page_);
  EXPECT_EQ(content.at("frames"), kSyntheticFrames);
  EXPECT_LT(content.at("stored_frames").size(), std::size_t{kSyntheticFrames});
  EXPECT_THAT(content.at("notes").dump(),
              AllOf(HasSubstr("of 12 frames"), HasSubstr("vertices are shown")));
}

TEST_F(ViewerPage, RefusesWhatIsNoRun) {
  EXPECT_THROW(WriteViewer({folder_ / "nothing"}, {}, page_), DataError);
  EXPECT_THROW(WriteViewer({Run(kMissingRun)}, {}, page_), DataError);
  EXPECT_FALSE(fs::exists(page_));
}

TEST_F(ViewerPage, IsLinkedFromReportAndIndex) {
  WriteViewer({Run(kWavingRun)}, {}, Run(kWavingRun) / kViewerPage);
  const std::string report = ReadWholeFile(WriteReport(experiment_));
  EXPECT_THAT(report, HasSubstr(fmt::format("<a href=\"{}/view.html\"", kWavingRun)));
  EXPECT_THAT(report, HasSubstr("Open chosen runs in lockstep"));
  EXPECT_EQ(Count(report, "type=\"checkbox\""), 1u) << "other runs have no viewer";
  EXPECT_THAT(ReadWholeFile(WriteIndex(folder_.path())),
              HasSubstr(fmt::format("<a href=\"synthetic/{}/view.html\"", kWavingRun)));
}

// Drives the page as a person would, and writes what became of it into the title.
constexpr const char* kDrive = R"js(
// A window that nobody looks at gets no frames of its own.
window.requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), 16);
addEventListener("load", async () => {
  const pause = () => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
  for (let i = 0; i < 500 && !(window.viewer && viewer.eventPictures.length === 0); ++i)
    await new Promise(done => setTimeout(done, 10));
  const id = name => document.getElementById(name);
  // Of each half of the picture: how many pixels are no background, and a sum that tells pictures
  // apart.
  const look = async () => {
    await viewer.settled();
    await pause();
    const copy = document.createElement("canvas"), {width, height} = id("stage");
    copy.width = width;
    copy.height = height;
    const pen = copy.getContext("2d", {willReadFrequently: true});
    pen.drawImage(id("stage"), 0, 0);
    return [0, 1].map(half => {
      const data = pen.getImageData(half * width / 2 | 0, 0, width / 2 | 0, height).data;
      let drawn = 0, sum = 0;
      for (let i = 0; i < data.length; i += 4) {
        if (Math.abs(data[i] - data[0]) + Math.abs(data[i + 1] - data[1]) > 8) ++drawn;
        sum = (sum * 31 + data[i] * 3 + data[i + 1] * 5 + data[i + 2] * 7) % 1000000007;
      }
      return {share: drawn / (data.length / 4), sum};
    });
  };
  const input = (element, value) => {
    if (element.type === "checkbox" || element.type === "radio") element.click();
    else { element.value = value; element.dispatchEvent(new Event("input", {bubbles: true})); }
  };
  const seen = {};
  seen.first = await look();
  input(id("scrub"), 7);
  seen.scrubbed = await look();
  seen.scrubbed_to = viewer.state.frame;
  seen.address = location.hash;
  document.body.dispatchEvent(new KeyboardEvent("keydown", {key: "w", bubbles: true}));
  await viewer.settled();
  seen.worst = viewer.state.frame;
  const error = await look();
  input(document.querySelector("[name=color][value=bone]"));
  seen.colors_differ = (await look())[0].sum !== error[0].sum;
  const bones = await look();
  input(document.querySelector("[name=color][value=uncertainty]"));
  seen.uncertainty_differs = (await look())[0].sum !== bones[0].sum;
  input(document.querySelector("[name=layer][value=regions]"));
  input(document.querySelector("[name=layer][value=skeleton]"));
  seen.layers = [...viewer.state.layers];
  input(document.querySelector("[name=layout][value=over]"));
  seen.over = await look();
  input(id("difference"));
  input(id("series"), "joint:left_wrist");
  await pause();
  seen.values = id("values").textContent;
  document.body.dispatchEvent(new KeyboardEvent("keydown", {key: " ", bubbles: true}));
  seen.playing = viewer.playing;
  document.body.dispatchEvent(new KeyboardEvent("keydown", {key: " ", bubbles: true}));
  input(document.querySelector("[name=layout][value=beside]"));
  input(document.querySelector("[name=color][value=error]"));
  viewer.go(4);
  await look();

  const {grid, runs} = viewer.page, surface = runs[0].surface;
  seen.vertices = Array.from(surface.positions.at(4), (cell, i) => grid.origin[i % 3] + cell * grid.step_m);
  seen.errors_m = Array.from(surface.error.values.at(4), byte => (byte / 255) ** 2 * surface.error.most_m);
  seen.most_error_m = surface.error.most_m;
  const wrist = viewer.page.series.get("joint:left_wrist");
  seen.wrist_mm = [...wrist.values[0]];
  seen.expected_wrist_mm = [...viewer.page.series.get("uncertainty:left_wrist").values[0]];
  seen.exact_has_uncertainty = viewer.page.series.get("uncertainty:left_wrist").values[1] !== null;
  seen.pictures = [...document.querySelectorAll("#events img")].map(picture => picture.src.length);
  seen.unnamed = [...document.querySelectorAll("button, input, select")].filter(
      control => !(control.labels && control.labels.length) && !control.ariaLabel &&
                 !control.textContent.trim()).length;
  seen.wide = document.documentElement.scrollWidth > innerWidth;
  seen.opened_after_ms = viewer.openedAfter_ms;
  document.title = JSON.stringify(seen);
});
)js";

// What the page shows of its runs and of those beside them.
constexpr const char* kLookBeside = R"js(
window.requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), 16);
addEventListener("load", async () => {
  for (let i = 0; i < 800 && !(window.viewer && viewer.eventPictures.length === 0); ++i)
    await new Promise(done => setTimeout(done, 10));
  viewer.go(7);
  await viewer.settled();
  const {page} = viewer;
  document.title = JSON.stringify({
    runs: page.runs.map(run => run.id), sequences: page.sequences.length, address: location.hash,
    shown: viewer.stage.scenes.map(scene => scene.moving.estimate.shown),
    frames: document.querySelectorAll("iframe").length});
});
)js";

class ViewerInBrowser : public ViewerPage {};

TEST_F(ViewerInBrowser, TakesInTheRunsOfOtherPages) {
  if (!HasBrowser()) GTEST_SKIP() << kBrowser << " is not installed";
  for (const char* run : {kWavingRun, kExactRun})
    WriteViewer({Run(run)}, {}, Run(run) / kViewerPage);
  const std::string other = fmt::format("../{}/{}", kExactRun, kViewerPage);
  const fs::path screenshots = VITRUVIA_SCREENSHOTS;
  fs::create_directories(screenshots);
  const SeenPage seen =
      OpenInBrowser(Run(kWavingRun) / kViewerPage, kLookBeside,
                    {.fragment = "with=" + other, .screenshot = screenshots / "lockstep.png"});
  EXPECT_EQ(seen.console, "");
  EXPECT_THAT(seen.probe.at("runs"), ElementsAre(kWavingRun, kExactRun));
  EXPECT_EQ(seen.probe.at("sequences"), 1) << "runs of one sequence share it";
  EXPECT_THAT(seen.probe.at("shown"), ElementsAre(7, 7));
  EXPECT_EQ(seen.probe.at("frames"), 0);
  EXPECT_THAT(seen.probe.at("address").get<std::string>(), HasSubstr("with="));
}

TEST_F(ViewerInBrowser, IsDrivenByMouseAndKeys) {
  if (!HasBrowser()) GTEST_SKIP() << kBrowser << " is not installed";
  WriteViewer({Run(kWavingRun), Run(kExactRun)}, {}, page_);
  const fs::path screenshots = VITRUVIA_SCREENSHOTS;
  fs::create_directories(screenshots);
  const SeenPage seen = OpenInBrowser(page_, kDrive, {.screenshot = screenshots / "viewer.png"});
  const nlohmann::json& p = seen.probe;
  EXPECT_EQ(seen.console, "");
  for (const char* picture : {"first", "scrubbed", "over"})
    EXPECT_GT(p.at(picture)[0].at("share"), 0.02) << picture;
  EXPECT_GT(p.at("first")[1].at("share"), 0.02) << "the second run's half";
  EXPECT_NE(p.at("first")[0].at("sum"), p.at("scrubbed")[0].at("sum"));
  EXPECT_EQ(p.at("scrubbed_to"), 7);
  EXPECT_THAT(p.at("address").get<std::string>(),
              AllOf(HasSubstr("frame=7"), HasSubstr("layers="), HasSubstr("view=")));
  std::vector<int> worst;
  const nlohmann::json content = ContentOf(page_);
  for (const nlohmann::json& event : content.at("runs")[0].at("events"))
    worst.push_back(event.at("worst"));
  EXPECT_THAT(worst, Contains(p.at("worst").get<int>()));
  EXPECT_TRUE(p.at("colors_differ"));
  EXPECT_TRUE(p.at("uncertainty_differs"));
  EXPECT_FALSE(p.at("exact_has_uncertainty").get<bool>());
  EXPECT_THAT(p.at("layers"), AllOf(Contains("skeleton"), Contains("regions")));
  EXPECT_THAT(p.at("values").get<std::string>(), HasSubstr(" − "));
  EXPECT_TRUE(p.at("playing"));
  for (const nlohmann::json& size : p.at("pictures")) EXPECT_GT(size, 500);
  EXPECT_EQ(p.at("unnamed"), 0) << "controls without a name for a screen reader";
  EXPECT_FALSE(p.at("wide").get<bool>()) << "the page scrolls sideways";
  RecordProperty("opened_after_ms", p.at("opened_after_ms").dump());

  // What the browser unpacked is what the run stored.
  const EstimateReader estimate(Run(kWavingRun) / "estimate");
  const SequenceReader sequence(folder_ / "sequences" / "wave");
  const std::vector<Vector3f> vertices = estimate.ReadVertices(4);
  const std::vector<double> errors_m = VertexErrors(vertices, sequence.ReadTrueVertices(4));
  const double most_m = p.at("most_error_m");
  ASSERT_EQ(p.at("vertices").size(), 3 * vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(p.at("vertices")[3 * v + axis], vertices[v][axis], 0.00006);
    // Half a step of the byte: the square root of the share is stored.
    const double root = std::sqrt(errors_m[v] / most_m), half = 0.5 / 255.0;
    EXPECT_NEAR(p.at("errors_m")[v], errors_m[v],
                most_m * half * (2.0 * root + half) + 0.5 * kFinestStep_m + 1e-6);
  }
  const int wrist = FindJoint("left_wrist");
  for (int frame = 0; frame < kSyntheticFrames; ++frame) {
    const double error_m =
        (estimate.frames()[frame].joints[wrist] - sequence.true_joints(frame).positions[wrist])
            .norm();
    EXPECT_NEAR(p.at("wrist_mm")[frame], 1e3 * error_m, 1e-3);
    const double trace_m2 = estimate.frames()[frame].covariance_m2(wrist).trace();
    EXPECT_NEAR(p.at("expected_wrist_mm")[frame], 1e3 * std::sqrt(trace_m2), 1e-3);
  }
}

}  // namespace
}  // namespace vitruvia
