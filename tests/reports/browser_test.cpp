// The pages in a real browser: no error in its console, every picture loads, a table sorts. Skipped
// where there is no chromium.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/files.h"
#include "reports/pages/index_page.h"
#include "reports/pages/report.h"
#include "reports/synthetic_experiment.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kBrowser = "chromium";

// Sorts the last table by its runs, twice, and writes what became of it into the title.
constexpr const char* kProbe = R"js(<script>addEventListener("load", () => {
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
});</script></body>)js";

bool HasBrowser() {
  return std::system(fmt::format("command -v {} >/dev/null 2>&1", kBrowser).c_str()) == 0;
}

std::string OutputOf(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string output;
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe.get()))
    output.append(buffer.data(), count);
  return output;
}

struct SeenPage {
  nlohmann::json probe;
  std::string console;
};

// A copy of the page with the probe, as a browser of that width sees it.
SeenPage Seen(const fs::path& page, int width) {
  std::string text = ReadWholeFile(page);
  text.replace(text.rfind("</body>"), 7, kProbe);
  const fs::path probed = page.parent_path() / "probed.html";
  WriteWholeFile(probed, text);
  const std::string output = OutputOf(fmt::format(
      "timeout 100 {} --headless --no-sandbox --disable-gpu --user-data-dir='{}' "
      "--window-size={},900 --enable-logging=stderr --virtual-time-budget=20000 --dump-dom "
      "'file://{}' 2>&1",
      kBrowser, (page.parent_path() / "profile").string(), width, fs::absolute(probed).string()));
  SeenPage seen;
  const std::size_t begin = output.find("<title>{"), end = output.find("</title>", begin);
  if (begin == std::string::npos) throw std::runtime_error("no probed title in: " + output);
  std::string title = output.substr(begin + 7, end - begin - 7);
  seen.probe = nlohmann::json::parse(title);
  for (std::size_t at = output.find(":CONSOLE"); at != std::string::npos;
       at = output.find(":CONSOLE", at + 1)) {
    seen.console += output.substr(at, output.find('\n', at) - at) + "\n";
  }
  return seen;
}

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
  ExpectSound(Seen(report, 1280));
  ExpectSound(Seen(index, 1280));
  ExpectSound(Seen(index, 500));  // no window of this browser is narrower
}

}  // namespace
}  // namespace vitruvia
