#include "reports/report.h"

#include <cstdlib>
#include <regex>

#include <gmock/gmock.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "core/error.h"
#include "core/files.h"
#include "records/run_record.h"
#include "reports/synthetic_experiment.h"
#include "reports/tables.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// "" or what is wrong: every element closed in order, every attribute quoted.
std::string XmlProblem(const std::string& text) {
  static const std::regex tag(R"(<(/?)([A-Za-z][\w:.-]*)((?:\s+[\w:.-]+="[^"<]*")*)\s*(/?)>)");
  std::vector<std::string> open;
  std::size_t at = text.find('<');
  if (text.compare(at, 5, "<?xml") == 0) at = text.find('<', text.find("?>"));
  while (at != std::string::npos) {
    std::smatch match;
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) return "no end of a tag";
    const std::string element = text.substr(at, end - at + 1);
    if (!std::regex_match(element, match, tag)) return "odd tag " + element.substr(0, 80);
    if (match[1] == "/") {
      if (open.empty() || open.back() != match[2]) return "misplaced " + element;
      open.pop_back();
    } else if (match[4] != "/") {
      open.push_back(match[2]);
    }
    at = text.find('<', end);
  }
  return open.empty() ? "" : "not closed: " + open.back();
}

struct PngFacts {
  int width = 0, height = 0;
  bool uniform = true;
};

PngFacts ReadPng(const fs::path& file) {
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

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

// What the page refers to and is made of.
void ExpectSelfContained(const std::string& page) {
  const std::regex reference(R"re((?:src|href|data|action)="([^"]*)")re");
  for (auto it = std::sregex_iterator(page.begin(), page.end(), reference);
       it != std::sregex_iterator(); ++it) {
    const std::string target = (*it)[1];
    EXPECT_TRUE(target.starts_with("data:") || target.starts_with("#")) << target.substr(0, 80);
  }
  EXPECT_THAT(page, Not(HasSubstr("url(")));
  EXPECT_THAT(page, Not(HasSubstr("@import")));
  EXPECT_LT(page.size(), 8'000'000u);
  EXPECT_EQ(Count(page, "<img "), 3u * 2u * 7u);  // runs, frames, pictures
}

void ExpectFigures(const fs::path& figures) {
  int pairs = 0;
  for (const auto& entry : fs::directory_iterator(figures)) {
    if (entry.path().extension() != ".svg") continue;
    ++pairs;
    const std::string svg = ReadWholeFile(entry.path());
    EXPECT_EQ(XmlProblem(svg), "") << entry.path();
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    // Ids of several drawings would clash inside the page.
    EXPECT_THAT(svg, Not(HasSubstr(" id=")));
    static const std::regex view_box(R"re(viewBox="0 0 (\d+) (\d+)")re");
    std::smatch size;
    ASSERT_TRUE(std::regex_search(svg, size, view_box));
    const PngFacts png = ReadPng(fs::path(entry.path()).replace_extension(".png"));
    EXPECT_EQ(png.width, 2 * std::stoi(size[1])) << entry.path();
    EXPECT_EQ(png.height, 2 * std::stoi(size[2])) << entry.path();
    EXPECT_FALSE(png.uniform) << entry.path();
  }
  // Error, accuracy and time for each of two scenes, speed against error, pictures of three runs.
  EXPECT_EQ(pairs, 3 * 2 + 1 + 3);
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
