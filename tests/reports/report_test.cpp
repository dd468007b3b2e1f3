#include "reports/pages/report.h"

#include <cmath>
#include <cstdlib>
#include <regex>
#include <string_view>

#include <gmock/gmock.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "analysis/tables.h"
#include "core/error.h"
#include "core/files.h"
#include "records/run_record.h"
#include "reports/pictures/cause_pictures.h"
#include "reports/pictures/drawn_before.h"
#include "reports/pictures/pictures.h"
#include "reports/synthetic_experiment.h"
#include "support/count.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

// "" or what is wrong with an element's inside: a name, then attributes in quotes.
std::string ElementProblem(std::string_view inside) {
  std::size_t at = std::min(inside.find_first_of(" \n"), inside.size());
  if (at == 0) return "element without a name";
  while ((at = inside.find_first_not_of(" \n", at)) != std::string_view::npos) {
    const std::size_t value = inside.find("=\"", at);
    if (value == std::string_view::npos) return "attribute without a value";
    const std::size_t end = inside.find('"', value + 2);
    if (end == std::string_view::npos) return "attribute without an end";
    at = end + 1;
  }
  return "";
}

// "" or what is wrong: every element closed in order, every attribute quoted.
std::string XmlProblem(std::string_view text) {
  std::vector<std::string_view> open;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
    const std::size_t end = text.find('>', at);
    if (end == std::string_view::npos) return "no end of a tag";
    std::string_view inside = text.substr(at + 1, end - at - 1);
    if (inside.starts_with("?xml")) continue;
    if (inside.starts_with('/')) {
      if (open.empty() || open.back() != inside.substr(1))
        return "misplaced " + std::string(inside);
      open.pop_back();
      continue;
    }
    if (inside.ends_with('/')) {
      inside.remove_suffix(1);
    } else {
      open.push_back(inside.substr(0, inside.find_first_of(" \n")));
    }
    const std::string problem = ElementProblem(inside);
    if (!problem.empty()) return problem + ": " + std::string(inside.substr(0, 80));
  }
  return open.empty() ? "" : "not closed: " + std::string(open.back());
}

struct PngFacts {
  int width = 0, height = 0;
  bool uniform = true;
};

PngFacts FactsOfPng(const fs::path& file) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  PngFacts facts{image->GetDimensions()[0], image->GetDimensions()[1]};
  const auto* bytes = static_cast<const unsigned char*>(image->GetScalarPointer());
  const int count = facts.width * facts.height * image->GetNumberOfScalarComponents();
  for (int i = 1; i < count; ++i) facts.uniform = facts.uniform && bytes[i] == bytes[0];
  return facts;
}

// What the page refers to and is made of.
void ExpectSelfContained(const std::string& page) {
  for (const std::string attribute : {" src=\"", " href=\"", " data=\"", " action=\""}) {
    for (std::size_t at = page.find(attribute); at != std::string::npos;
         at = page.find(attribute, at + 1)) {
      const std::string target = page.substr(at + attribute.size(), 80);
      EXPECT_TRUE(target.starts_with("data:") || target.starts_with("#")) << target;
    }
  }
  EXPECT_EQ(Count(page, "url("), 0u);
  EXPECT_EQ(Count(page, "@import"), 0u);
  EXPECT_LT(page.size(), 8'000'000u);
  EXPECT_EQ(Count(page, "<figure><img "), 3u * 2u * 7u);  // runs, frames, pictures
}

void ExpectFigures(const fs::path& figures) {
  int pairs = 0;
  for (const auto& entry : fs::directory_iterator(figures)) {
    if (entry.path().extension() != ".svg") continue;
    ++pairs;
    const std::string svg = ReadWholeFile(entry.path());
    EXPECT_EQ(XmlProblem(svg), "") << entry.path();
    EXPECT_EQ(Count(svg, ",nan") + Count(svg, "nan,"), 0u) << entry.path();
    // Ids of several drawings would clash inside the page.
    EXPECT_EQ(Count(svg, " id="), 0u) << entry.path();
    static const std::regex view_box(R"re(viewBox="0 0 (\d+) (\d+)")re");
    std::smatch size;
    const std::string head = svg.substr(0, 200);
    ASSERT_TRUE(std::regex_search(head, size, view_box));
    const PngFacts png = FactsOfPng(fs::path(entry.path()).replace_extension(".png"));
    // A sheet's pictures keep their pixels.
    const double scale =
        entry.path().filename().string().starts_with("pictures-") ? kSheetPngScale : 2.0;
    EXPECT_EQ(png.width, std::ceil(scale * std::stoi(size[1]))) << entry.path();
    EXPECT_EQ(png.height, std::ceil(scale * std::stoi(size[2]))) << entry.path();
    EXPECT_FALSE(png.uniform) << entry.path();
  }
  // Error, accuracy and time for each of two scenes, speed against error, times of the steps,
  // pictures of three runs.
  EXPECT_EQ(pairs, 3 * 2 + 1 + 1 + 3);
}

TEST(Report, IsWhole) {
  unsetenv("DISPLAY");
  const TemporaryFolder root;
  const fs::path folder = WriteSyntheticExperiment(root.path());
  const fs::path page_file = WriteReport(folder);
  EXPECT_EQ(page_file, folder / "report.html");
  const std::string page = ReadWholeFile(page_file);
  ExpectSelfContained(page);
  ExpectFigures(folder / "figures");
  const ReportedExperiment experiment = ReadExperiment(folder);
  EXPECT_EQ(ReadWholeFile(folder / "table.csv"), ToCsv(experiment));
  EXPECT_EQ(ReadWholeFile(folder / "table.tex"), ToLatex(experiment));

  // Drawn again, it is the same.
  const std::string figure = ReadWholeFile(folder / "figures/speed-against-error.png");
  WriteReport(folder);
  EXPECT_EQ(ReadWholeFile(page_file), page);
  EXPECT_EQ(ReadWholeFile(folder / "figures/speed-against-error.png"), figure);
}

TEST(Report, SaysWhatHoldsTheErrors) {
  const TemporaryFolder root;
  const fs::path folder = WriteSyntheticExperiment(root.path());
  const std::string page = ReadWholeFile(WriteReport(folder));
  const std::vector<RunCauses> runs = FindCauses(ReadExperiment(folder), {});
  std::size_t events = 0;
  for (const RunCauses& run : runs) {
    EXPECT_EQ(run.problem, "");
    EXPECT_EQ(run.pictures.size(), run.diagnosis.events.size());
    events += run.diagnosis.events.size();
  }
  EXPECT_GT(events, 3u);
  EXPECT_EQ(Count(page, "alt=\"Truth and estimate in frame"), events);
  const auto waving = std::ranges::find(runs, kWavingRun, &RunCauses::run_id);
  ASSERT_NE(waving, runs.end());
  for (int i = 0; i < kCauseCount; ++i) {
    const double share = waving->diagnosis.shares[i];
    if (share == 0.0) continue;
    EXPECT_THAT(page, HasSubstr(fmt::format(">{:.1f} %</td>", 1e2 * share)));
  }
}

TEST(Report, NeedsAnExperiment) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { WriteReport(folder.path()); },
              testing::ThrowsMessage<DataError>(HasSubstr("experiment.json: cannot be opened")));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Report, TellsWhenNoRunHasFinished) {
  const TemporaryFolder folder;
  ExperimentRecord experiment;
  experiment.name = experiment.title = "empty";
  experiment.run_ids = {"later"};
  WriteExperimentRecord(folder.path(), experiment);
  const std::string page = ReadWholeFile(WriteReport(folder.path()));
  EXPECT_THAT(page, HasSubstr("0 of 1 runs finished"));
  EXPECT_THAT(page, HasSubstr("No run has finished, so there is nothing to plot."));
}

TEST(Report, DoesWithoutPicturesWhereTheSequenceIsGone) {
  const TemporaryFolder root;
  const fs::path folder = WriteSyntheticExperiment(root.path());
  fs::remove_all(root / "sequences");
  const std::string page = ReadWholeFile(WriteReport(folder));
  EXPECT_EQ(Count(page, "No pictures: "), 3u);
  EXPECT_EQ(Count(page, "<img "), 0u);
}

}  // namespace
}  // namespace vitruvia
