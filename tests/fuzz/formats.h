// Every format that is read, with small whole files of it.
#pragma once

#include <vector>

#include "support/mutation_trials.h"

namespace vitruvia {

std::vector<MutatedFormat> MutatedFormats();

}  // namespace vitruvia
