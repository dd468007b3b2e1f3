// Stores a scan's frames as a sequence, for inspection or later fusion.
#pragma once

#include <filesystem>

#include "synth/scan/scan_scene.h"

namespace vitruvia {

// Writes a sequence (sequence/sequence.h) whole or not at all. Its camera frame moves: the true
// vertices and joints are given in the frame of the moving camera. The provenance holds the scene
// and the camera pose of the first frame (camera_from_subject, row by row).
void RecordScan(const ScanSceneSettings& settings, const std::filesystem::path& folder);

}  // namespace vitruvia
