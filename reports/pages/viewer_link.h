// From tables of runs to the runs in three dimensions.
#pragma once

#include <filesystem>
#include <string>

namespace vitruvia {

// The address of a run's viewer as seen from the page of folder `from`; "" where it has none
// (`vitruvia view` writes it).
std::string ViewerLink(const std::filesystem::path& experiment_folder, const std::string& run_id,
                       const std::filesystem::path& from);

// HTML: the run's id, followed by that link where it is not "".
std::string RunWithViewer(const std::string& run_id, const std::string& link);

}  // namespace vitruvia
