// The frames of a depth recording: their files, order and times.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitruvia {

struct DepthRecording {
  std::vector<std::filesystem::path> frames;  // empty where the file is missing
  double fps = 0.0;                           // from time stamps; 0 if there are none
  int missing = 0;                            // frames without a file
  // Messages for the user: gaps with the number of missing frames, and files that a list does not
  // name.
  std::vector<std::string> gaps;

  int there() const { return static_cast<int>(frames.size()) - missing; }
};

// `images` is a folder of image files (geometry/image_file.h) or of .pcd files, taken in the
// natural order of their names; or a list in the format of the TUM RGB-D benchmark, one line
// "seconds path" for each frame, paths relative to the list, # before a comment; or one such file.
// A missing frame is inserted for each number or time stamp that is skipped. DataError naming the
// file and the line if there is no frame, time stamps do not increase, files are missing, or both
// kinds of files are present.
DepthRecording FindRecordedFrames(const std::filesystem::path& images);

bool IsPcdFile(const std::filesystem::path& file);

}  // namespace vitruvia
