// The pictures of all runs, for the report's page.
#pragma once

#include <string>
#include <vector>

#include "reports/pictures/pictures.h"

namespace vitruvia {

std::string PictureSection(const std::vector<RunPictures>& runs);

}  // namespace vitruvia
