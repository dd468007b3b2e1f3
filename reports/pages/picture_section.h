// Pictures of runs, as HTML.
#pragma once

#include <string>
#include <vector>

#include "reports/pictures/pictures.h"

namespace vitruvia {

// One run's legend and strips, or why there are none.
std::string RunPicturesHtml(const RunPictures& run);

// The report's section with the pictures of all runs.
std::string PictureSection(const std::vector<RunPictures>& runs);

}  // namespace vitruvia
