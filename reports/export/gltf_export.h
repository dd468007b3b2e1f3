// A run as one animated file for programs of computer graphics (binary glTF 2.0).
//
// Node "estimate" and, where the sequence has a true surface, node "truth": a mesh whose morph
// targets are the frames, and an animation that shows one after the other. Metres, y up, z towards
// the camera; the camera is at the origin. Morph targets are exact to single precision.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitruvia {

// Writes those frames of a run to the file and returns how many: all if there are none, but then
// evenly chosen ones where there are more than kMostGltfFrames. DataError as in OpenForExport.
int ExportGltf(const std::filesystem::path& experiment_folder, const std::string& run_id,
               std::vector<int> frames, const std::filesystem::path& file);
inline constexpr int kMostGltfFrames = 300;

}  // namespace vitruvia
