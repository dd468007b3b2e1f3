// Plots of the regression gate's history.
#pragma once

#include <string>
#include <vector>

#include "analysis/gate_files.h"
#include "reports/drawing/plot.h"

namespace vitruvia {

// One figure for each experiment of the history, its runs as lines over the occasions: the main
// error, and the time where there is one. Empty for an empty history.
std::vector<Figure> MakeHistoryFigures(const std::vector<HistoryEntry>& history);

}  // namespace vitruvia
