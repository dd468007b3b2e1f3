// One page over all experiments of an output folder.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "reports/pages/page_parts.h"

namespace vitruvia {

struct IndexedExperiment {
  std::string link;  // its report, relative to the page; "" where there is none
  ReportedExperiment experiment;
  std::string speed_svg;                       // the file's content; "" where there is none
  std::string picture_png;                     // a small one
  std::map<std::string, std::string> viewers;  // run id → link, of the runs that have one
};

// The last verdict of a regression gate and its history.
struct IndexedGate {
  std::string name, verdict, date, commit, link;  // of its Markdown summary
  std::vector<DrawnFigure> figures;
};

struct IndexContent {
  std::vector<IndexedExperiment> experiments;
  std::vector<IndexedGate> gates;
  std::vector<std::string> problems;  // folders that could not be read, and why
};

std::string MakeIndexPage(const IndexContent& content);

// Reads every experiment and every gate below `folder` and writes `folder`/index.html:
// self-contained but for the links to the reports. DataError if there is no such folder or nothing
// in it to show; returns the page's path.
std::filesystem::path WriteIndex(const std::filesystem::path& folder);

}  // namespace vitruvia
