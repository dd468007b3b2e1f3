// The pages in a real browser: no error in its console, every picture loads, a table sorts. Skipped
// where there is no chromium.
#include "reports/browser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "reports/pages/index_page.h"
#include "reports/pages/report.h"
#include "reports/synthetic_experiment.h"
#include "support/count.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

// Sorts the last table by its runs, twice, and writes what became of it into the title.
constexpr const char* kProbe = R"js(addEventListener("load", () => {
  const images = [...document.images];
  const table = [...document.querySelectorAll("table.sortable")].pop();
  const column = [...table.tBodies[0].rows[0].cells].findIndex(c => c.className === "run");
  const cells = () => [...table.tBodies[0].rows].map(row => row.cells[column].dataset.value).join(",");
  const button = table.querySelectorAll("thead button")[column];
  button.click();
  const up = cells();
  button.click();
  document.title = JSON.stringify({
    images: images.length, loaded: images.filter(i => i.complete && i.naturalWidth > 0).length,
    up: up, down: cells(), wide: document.documentElement.scrollWidth > innerWidth});
});)js";

// Goes to the first point of a plot by the keyboard, and over a curve by the pointer.
constexpr const char* kHover = R"js(addEventListener("load", () => {
  const hint = document.getElementById("hint"), seen = {dark: getComputedStyle(document.body).backgroundColor};
  const point = document.querySelector("figure.plot svg [tabindex]");
  point.focus({focusVisible: true});
  seen.point = hint.hidden ? "" : hint.textContent;
  point.blur();
  seen.left = hint.hidden;
  const curve = document.querySelector("figure.plot svg [data-values]"), svg = curve.ownerSVGElement;
  curve.scrollIntoView({block: "center"});
  const at = curve.points[3].matrixTransform(svg.getScreenCTM());
  svg.dispatchEvent(new PointerEvent("pointermove", {clientX: at.x, clientY: at.y + 2, bubbles: true}));
  seen.curve = hint.hidden ? "" : hint.textContent;
  seen.value = curve.dataset.values.split(",")[3];
  seen.unnamed = [...document.querySelectorAll("button, input, a, svg [tabindex], img")].filter(
      part => !part.ariaLabel && !part.alt && !part.textContent.trim()).length;
  seen.skipped = [...document.querySelectorAll("h1, h2, h3, h4")].map(h => Number(h.tagName[1])).filter(
      (level, i, levels) => i > 0 && level > levels[i - 1] + 1).length;
  document.title = JSON.stringify(seen);
});)js";

const fs::path kScreenshots = VITRUVIA_SCREENSHOTS;

void ExpectSound(const SeenPage& seen) {
  EXPECT_EQ(seen.console, "");
  EXPECT_GT(seen.probe.at("images").get<int>(), 0);
  EXPECT_EQ(seen.probe.at("loaded"), seen.probe.at("images"));
  EXPECT_NE(seen.probe.at("up"), seen.probe.at("down"));
  EXPECT_FALSE(seen.probe.at("wide").get<bool>()) << "the page scrolls sideways";
}

class Browser : public testing::Test {
 protected:
  void SetUp() override {
    if (!HasBrowser()) GTEST_SKIP() << kBrowser << " is not installed";
    fs::create_directories(kScreenshots);
    report_ = WriteReport(WriteSyntheticExperiment(root_.path()));
    index_ = WriteIndex(root_.path());
  }

  const TemporaryFolder root_;
  fs::path report_, index_;
};

TEST_F(Browser, ShowsReportAndIndexOnScreenAndPhone) {
  ExpectSound(OpenInBrowser(report_, kProbe, {.screenshot = kScreenshots / "report.png"}));
  ExpectSound(OpenInBrowser(index_, kProbe, {.screenshot = kScreenshots / "index.png"}));
  ExpectSound(
      OpenInBrowser(report_, kProbe, {.width = 375, .screenshot = kScreenshots / "phone.png"}));
  ExpectSound(OpenInBrowser(index_, kProbe, {.width = 375}));
}

TEST_F(Browser, PlotsAnswerToPointerAndKeyboardInTheDarkToo) {
  for (const bool dark : {false, true}) {
    const SeenPage seen = OpenInBrowser(
        report_, kHover,
        {.dark = dark, .screenshot = kScreenshots / (dark ? "hover-dark.png" : "hover.png")});
    const nlohmann::json& p = seen.probe;
    EXPECT_EQ(seen.console, "");
    EXPECT_EQ(p.at("dark"), dark ? "rgb(21, 24, 27)" : "rgb(255, 255, 255)");
    EXPECT_THAT(p.at("point").get<std::string>(), HasSubstr(": "));
    EXPECT_TRUE(p.at("left"));
    const std::string curve = p.at("curve"), value = p.at("value");
    const std::size_t space = value.find(' ');
    EXPECT_THAT(curve,
                HasSubstr(" · " + value.substr(space + 1) + " at " + value.substr(0, space)));
    EXPECT_EQ(p.at("unnamed"), 0) << "controls without a name for a screen reader";
    EXPECT_EQ(p.at("skipped"), 0) << "headings that skip a level";
  }
}

TEST_F(Browser, PrintsTheReport) {
  const fs::path pdf = kScreenshots / "report.pdf";
  fs::remove(pdf);
  PrintInBrowser(report_, pdf);
  const std::string text = ReadWholeFile(pdf);
  EXPECT_GE(Count(text, "/Type /Page\n"), 2u);
  EXPECT_GE(Count(text, "/Subtype /Image"), 2u) << "the pictures are there";
}

}  // namespace
}  // namespace vitruvia
