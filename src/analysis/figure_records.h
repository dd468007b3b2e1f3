// A reproduced figure and the run records that it is made from.
#pragma once

#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "analysis/reproduction_list.h"

namespace vitruvia {

struct FigureRecords {
  ReproducedFigure figure;
  std::vector<ReportedExperiment> experiments;  // of each the runs that the figure is made from
  std::vector<std::string> problems;            // of experiments that could not be planned
};

// The figure's verdict. A run that failed or is missing is not left out of a mean: with one the
// claim cannot be tested. Of a figure without a claim only the reason counts: what is missing.
ClaimDecision DecideFigure(const FigureRecords& records);

// Only the runs of the method and variant and of the scenes that match.
ReportedExperiment RunsThatMatch(const ReportedExperiment& experiment, const std::string& contender,
                                 const std::vector<std::string>& scenes);

// One row of a table: means over its runs in the scenes of the table.
struct TableRow {
  std::string name;  // "method/variant" or "method"
  int runs = 0;
  std::vector<double> means;  // in the order of the table's metrics; NaN where no run has one
};
// In the order of the grids, over all the experiments together.
std::vector<TableRow> Tabulate(const ShownTable& table,
                               const std::vector<ReportedExperiment>& experiments);

}  // namespace vitruvia
