// The pages in a real browser: no error in its console, every picture loads, a table sorts. Skipped
// where there is no chromium.
#include "reports/browser.h"

#include <gtest/gtest.h>

#include "reports/pages/index_page.h"
#include "reports/pages/report.h"
#include "reports/synthetic_experiment.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;

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

void ExpectSound(const SeenPage& seen) {
  EXPECT_EQ(seen.console, "");
  EXPECT_GT(seen.probe.at("images").get<int>(), 0);
  EXPECT_EQ(seen.probe.at("loaded"), seen.probe.at("images"));
  EXPECT_NE(seen.probe.at("up"), seen.probe.at("down"));
  EXPECT_FALSE(seen.probe.at("wide").get<bool>()) << "the page scrolls sideways";
}

TEST(Browser, ShowsReportAndIndexOnScreenAndPhone) {
  if (!HasBrowser()) GTEST_SKIP() << kBrowser << " is not installed";
  const TemporaryFolder root;
  const fs::path report = WriteReport(WriteSyntheticExperiment(root.path()));
  const fs::path index = WriteIndex(root.path());
  ExpectSound(OpenInBrowser(report, kProbe, 1280));
  ExpectSound(OpenInBrowser(index, kProbe, 1280));
  ExpectSound(OpenInBrowser(index, kProbe, 500));  // no window of this browser is narrower
}

}  // namespace
}  // namespace vitruvia
