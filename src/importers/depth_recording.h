// The frames of a depth recording: which files, in which order, at which times.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitruvia {

struct DepthRecording {
  std::vector<std::filesystem::path> frames;  // empty where the file is missing
  double fps = 0.0;                           // of time stamps; 0 where there are none
  int missing = 0;                            // frames without a file
  // For people: between which files how many are missing, and files that a list does not name.
  std::vector<std::string> gaps;

  int there() const { return static_cast<int>(frames.size()) - missing; }
};

// `images` is a folder of image files (geometry/image_file.h) or of .pcd files, taken in the
// natural order of their names; or a list as the TUM RGB-D benchmark has it, one line "seconds
// path" for each frame, paths relative to the list, # before a comment; or one such file. Where
// numbers in names, or time stamps, step over some, a missing frame is put in for each. DataError
// naming the file and the line: nothing there, time stamps that do not rise, files that are not
// there, files of both kinds.
DepthRecording FindRecordedFrames(const std::filesystem::path& images);

bool IsPcdFile(const std::filesystem::path& file);

}  // namespace vitruvia
