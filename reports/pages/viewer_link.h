// From tables of runs to the runs in three dimensions.
#pragma once

#include <filesystem>
#include <string>

namespace vitruvia {

// The address of a run's viewer as seen from the page of folder `from`; "" where it has none
// (`vitruvia view` writes it).
std::string ViewerLink(const std::filesystem::path& experiment_folder, const std::string& run_id,
                       const std::filesystem::path& from);

// HTML: the run's id, followed by that link and a box that chooses the run where it is not "".
std::string RunWithViewer(const std::string& run_id, const std::string& link);

// HTML before a table of such cells: a button that opens the chosen runs in lockstep, or how runs
// get viewers where none has one.
std::string ViewerChoice(bool any_viewer, const std::string& experiment_folder);

}  // namespace vitruvia
