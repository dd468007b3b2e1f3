// The page of reproduced figures, in the papers' order: published and measured results, and the
// verdict on each claim.
#pragma once

#include <filesystem>
#include <vector>

#include "analysis/figure_records.h"
#include "analysis/reproduction_list.h"

namespace vitruvia {

// Draws the figures' pictures, plots and tables from their records and writes one self-contained
// page. The plots are also written as PNG and SVG to a folder of the page's name beside it.
void WriteReproductionPage(const ReproductionList& list, const std::vector<FigureRecords>& figures,
                           const std::filesystem::path& page);

}  // namespace vitruvia
