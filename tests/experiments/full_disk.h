// Calls of the program on a disk without room.
#pragma once

#include <string>
#include <sys/resource.h>
#include <vector>

#include "experiments/command_line.h"

namespace vitruvia {

// CallVitruvia() where no file may grow beyond that size.
CallResult CallWithFullDisk(rlim_t largest_file_bytes, const std::vector<std::string>& arguments);

}  // namespace vitruvia
