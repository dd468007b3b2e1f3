// Reports, and figures in the size that a paper wants: drawn from stored run records, sequences and
// estimates; nothing is run again.
#pragma once

#include <filesystem>
#include <vector>

#include "reports/drawing/drawing_writer.h"

namespace vitruvia {

// Writes report.html (self-contained), table.csv, table.tex, table.md and figures/ (PNG and SVG)
// into an experiment's folder (records/run_record.h). Missing and failed runs are shown as such.
// DataError if the folder holds no experiment; returns the path of report.html.
std::filesystem::path WriteReport(const std::filesystem::path& experiment_folder);

inline constexpr double kPointsPerMillimeter = 72.0 / 25.4;

struct PaperFormat {
  double width_pt = 84.0 * kPointsPerMillimeter;  // points: 1/72 inch
  double text_pt = 8.0;
  std::vector<FileFormat> formats{FileFormat::kPdf};
};

// Writes every figure of the report to paper/ in the experiment's folder, in that size, and beside
// it NAME.tex, a figure environment with its caption, and NAME.txt, the caption and the runs behind
// each name of the legend. Returns that folder.
std::filesystem::path WritePaperFigures(const std::filesystem::path& experiment_folder,
                                        const PaperFormat& format);

}  // namespace vitruvia
