// Runs as one page in which they are seen in three dimensions: turned, played and compared frame by
// frame. Drawn from stored records, sequences and estimates; nothing is run again.
//
// The page needs no network and no other file. Runs of a page go in lockstep: the same frame, the
// same view.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitruvia {

// Of a single run, in its folder.
inline constexpr const char* kViewerPage = "view.html";

// What a page holds at most; what is left out is said on the page.
struct ViewerLimits {
  int most_frames = 600;     // with surfaces and depth; numbers and joints are there for all frames
  int most_vertices = 6500;  // of a surface
};

// Writes the page. `run_folders`: <experiment>/<run id>, one at least. DataError if one is no
// finished run with an estimate, or its sequence is gone.
void WriteViewer(const std::vector<std::filesystem::path>& run_folders, const ViewerLimits& limits,
                 const std::filesystem::path& page);

// Which frames a page holds: `frames` spread evenly, the first and the last among them, and those
// of `wanted`, in order; all where there are no more than `most`.
std::vector<int> StoredFrames(int count, int most, const std::vector<int>& wanted);

}  // namespace vitruvia
