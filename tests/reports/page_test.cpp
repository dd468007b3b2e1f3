// What the page and the tables say; drawing them is tested in report_test.cpp.
#include <algorithm>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "analysis/tables.h"
#include "reports/pages/html_page.h"
#include "reports/synthetic_experiment.h"
#include "support/count.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
using testing::HasSubstr;

std::vector<std::vector<std::string>> ReadCsv(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string>& cells = rows.emplace_back(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        cells.emplace_back();
      else if (c != '\r')
        cells.back() += c;
    }
  }
  return rows;
}

class PageTest : public testing::Test {
 protected:
  const RunRecord& Run(const std::string& run_id) const {
    for (const RunRecord* run : experiment_.finished()) {
      if (run->run_id == run_id) return *run;
    }
    throw std::invalid_argument(run_id + " is no finished run");
  }

  TemporaryFolder root_;
  ReportedExperiment experiment_ = ReadExperiment(WriteSyntheticExperiment(root_.path()));
  std::string page_ = MakePage(experiment_, {}, {}, {});
};

TEST_F(PageTest, NamesEveryRunAndWhatBecameOfIt) {
  for (const char* run : {kWavingRun, kExactRun, kOtherScene, kFailedRun, kMissingRun}) {
    // In each of the three comparisons, and among all runs.
    EXPECT_GE(Count(page_, std::string("<td class=\"run\">") + run + "</td>"), 3u) << run;
  }
  EXPECT_THAT(page_, HasSubstr("3 of 5 runs finished; <b>2 failed or missing</b>"));
  EXPECT_THAT(page_, HasSubstr("failed: sequences/turn/depth/000003.png: file is cut short"));
  EXPECT_THAT(page_, HasSubstr("missing: it has not been run, or was interrupted"));
}

TEST_F(PageTest, SetsPaperOursAndDifferenceSideBySide) {
  for (const char* run_id : {kWavingRun, kExactRun, kOtherScene}) {
    const RunRecord& run = Run(run_id);
    for (const Expectation& e : experiment_.record.expectations) {
      const double ours = run.summary.at(e.metric);
      const int decimals = e.metric == "frame_ms_median" ? 1 : 5;
      std::string difference = fmt::format("{:+.{}f}", ours - e.paper, decimals);
      if (difference[0] == '-') difference.replace(0, 1, "−");
      EXPECT_THAT(page_,
                  HasSubstr(fmt::format(
                      "<td class=\"run\">{}</td><td class=\"n\" data-label=\"paper\">{:.{}f}</td>"
                      "<td class=\"n\" data-label=\"ours\">{:.{}f}</td>"
                      "<td class=\"n\" data-label=\"difference\">{}</td>",
                      run_id, e.paper, decimals, ours, decimals, difference)));
      EXPECT_THAT(page_, HasSubstr(e.source));
      EXPECT_THAT(page_, HasSubstr(e.remark));
    }
  }
  EXPECT_EQ(Count(page_, "✗ missed"), 1u);  // only the other scene's mean error
  EXPECT_EQ(Count(page_, "✓ met"), 5u);
  EXPECT_EQ(Count(page_, ">no result<"), 6u);  // two runs, three numbers
}

TEST_F(PageTest, EscapesWhatOthersWrote) {
  EXPECT_THAT(page_, HasSubstr("<h1>A figure of boxes &lt;waving&gt;</h1>"));
  EXPECT_THAT(page_, HasSubstr("one that failed &amp; one"));
  EXPECT_THAT(page_, HasSubstr("g++ &lt;12&gt;"));
}

TEST_F(PageTest, ShowsProvenanceAndConfig) {
  for (const char* part : {"abcdef012345", "0123456789abcdef", "&quot;lambda&quot;: 0.25"}) {
    EXPECT_EQ(Count(page_, part), 3u) << part;
  }
}

TEST_F(PageTest, CsvHoldsTheSummariesToTheLastDigit) {
  const auto rows = ReadCsv(ToCsv(experiment_));
  ASSERT_EQ(rows.size(), 6u);
  const std::vector<std::string>& header = rows[0];
  const auto cell = [&](const std::vector<std::string>& row, const std::string& key) {
    const auto at = std::find(header.begin(), header.end(), key) - header.begin();
    return row.at(static_cast<std::size_t>(at));
  };
  for (const auto& row : rows) EXPECT_EQ(row.size(), header.size());
  for (std::size_t r = 1; r <= 3; ++r) {
    const RunRecord& run = Run(rows[r][0]);
    for (const auto& item : run.summary.items()) {
      const std::string text = cell(rows[r], item.key());
      if (item.value().is_number()) {
        EXPECT_EQ(std::strtod(text.c_str(), nullptr), item.value().get<double>()) << item.key();
      } else {
        EXPECT_EQ(text, item.value().is_null() ? "" : item.value().get<std::string>());
      }
    }
    EXPECT_EQ(cell(rows[r], "status"), "done");
    EXPECT_EQ(std::strtod(cell(rows[r], "frame_ms_median_difference").c_str(), nullptr),
              run.summary.at("frame_ms_median").get<double>() - 25.0);
  }
  EXPECT_EQ(cell(rows[4], "run_id"), kFailedRun);
  EXPECT_THAT(cell(rows[4], "status"), HasSubstr("cut short"));
  EXPECT_EQ(cell(rows[4], "l2_mean_m"), "");
  EXPECT_THAT(cell(rows[5], "status"), HasSubstr("missing"));
}

TEST_F(PageTest, LatexHoldsTheSummariesAsPrinted) {
  const std::string latex = ToLatex(experiment_);
  const RunRecord& run = Run(kOtherScene);
  const double ours = run.summary.at("l2_mean_of_diagonal");
  EXPECT_THAT(latex, HasSubstr(fmt::format(
                         "turn-base-s1 & mean L2 error / diagonal & 0.00100 & {:.5f} & {:+.5f} & "
                         "$\\le$ 0.00100 & missed \\\\",
                         ours, ours - 0.001)));
  EXPECT_THAT(latex, HasSubstr("failed: sequences/turn/depth/000003.png"));
  EXPECT_EQ(Count(latex, "\\begin{tabular}"), 2u);
  EXPECT_EQ(Count(latex, "\\end{tabular}"), 2u);
}

}  // namespace
}  // namespace vitruvia
