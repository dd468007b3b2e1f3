// A small experiment as the runner would leave it: a sequence, three finished runs with their
// estimates, one failed run and one that is missing.
#pragma once

#include <filesystem>

#include "records/run_record.h"

namespace vitruvia {

// Run ids, in the order of the grid.
inline constexpr const char* kWavingRun = "wave-base-s1";   // the left arm is off by some cm
inline constexpr const char* kExactRun = "wave-exact-s1";   // the truth as the estimate
inline constexpr const char* kOtherScene = "turn-base-s1";  // another scene, with failed frames
inline constexpr const char* kFailedRun = "turn-lost-s1";
inline constexpr const char* kMissingRun = "turn-later-s1";
inline constexpr int kSyntheticFrames = 12;
inline constexpr int kPictureFrame = 6;

// Writes it below `root` and returns the experiment's folder.
std::filesystem::path WriteSyntheticExperiment(const std::filesystem::path& root);

}  // namespace vitruvia
