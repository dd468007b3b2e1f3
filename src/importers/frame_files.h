// Finds and sorts the frame files of a folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace vitruvia {

struct FrameFiles {
  std::vector<std::filesystem::path> files;  // in the order of their numbers
  std::string warning;                       // names missing numbers; "" if none is missing
};

// The files that `is_frame` accepts, without hidden ones and `not_frames`, sorted by the numbers in
// their names: 2 comes before 10 and after 1, with or without padding. Names may differ only in
// their numbers and in the case of the extension. DataError if there is no file, if a name has a
// different pattern, or if two files have the same number; `expected` names the kind of file in
// messages.
FrameFiles FindFrameFiles(const std::filesystem::path& folder,
                          const std::function<bool(const std::filesystem::path&)>& is_frame,
                          const std::vector<std::filesystem::path>& not_frames,
                          const std::string& expected);

}  // namespace vitruvia
