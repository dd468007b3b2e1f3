// Which files of a folder are the frames of a recording, and in which order.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace vitruvia {

struct FrameFiles {
  std::vector<std::filesystem::path> files;  // in the order of their numbers
  std::string warning;                       // numbers that are missing; "" if none is
};

// The files that `is_frame` accepts, hidden ones and `not_frames` left out, sorted by the numbers
// in their names: 2 comes before 10 and after 1, padded or not. Names may differ only in their
// numbers and in the case of the extension. DataError if there is none, if a name is of another
// kind, or if two files have the same number; `expected` names the kind of file in messages.
FrameFiles FindFrameFiles(const std::filesystem::path& folder,
                          const std::function<bool(const std::filesystem::path&)>& is_frame,
                          const std::vector<std::filesystem::path>& not_frames,
                          const std::string& expected);

}  // namespace vitruvia
