// A reproduced figure and the run records that it is made from.
#pragma once

#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "analysis/reproduction_list.h"

namespace vitruvia {

struct FigureRecords {
  ReproducedFigure figure;
  std::vector<ReportedExperiment> experiments;  // each with only the runs used for the figure
  std::vector<std::string> problems;            // of experiments that could not be planned
};

// The figure's verdict. If a run failed or is missing, the claim cannot be tested; means over the
// remaining runs are not used. For a figure without a claim, only `reason` is set: it names what is
// missing.
ClaimDecision DecideFigure(const FigureRecords& records);

// Only the runs of the method and variant and of the scenes that match.
ReportedExperiment RunsThatMatch(const ReportedExperiment& experiment, const std::string& contender,
                                 const std::vector<std::string>& scenes);

// One row of a table: means over its runs in the scenes of the table.
struct TableRow {
  std::string name;  // "method/variant" or "method"
  int runs = 0;
  std::vector<double> means;  // in the order of the table's metrics; NaN if no run has the metric
};
// Rows in the order of the grids, over all experiments together.
std::vector<TableRow> Tabulate(const ShownTable& table,
                               const std::vector<ReportedExperiment>& experiments);

}  // namespace vitruvia
