// Reports: drawn from stored run records, sequences and estimates; nothing is run again.
#pragma once

#include <filesystem>

namespace vitruvia {

// Writes report.html (self-contained), table.csv, table.tex and figures/ (PNG and SVG) into an
// experiment's folder (records/run_record.h). Missing and failed runs are shown as such.
// DataError if the folder holds no experiment; returns the path of report.html.
std::filesystem::path WriteReport(const std::filesystem::path& experiment_folder);

}  // namespace vitruvia
