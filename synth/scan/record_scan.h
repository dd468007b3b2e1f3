// A scan's frames on disk, as a sequence: to look at, or to be fused later as recorded ones are.
#pragma once

#include <filesystem>

#include "synth/scan/scan_scene.h"

namespace vitruvia {

// Writes a sequence (sequence/sequence.h) whole or not at all. Its camera frame moves: the true
// vertices and joints are those of the subject before the moving camera. The provenance holds the
// scene and where the first frame was taken from (camera_from_subject, row by row).
void RecordScan(const ScanSceneSettings& settings, const std::filesystem::path& folder);

}  // namespace vitruvia
