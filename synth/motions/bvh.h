// Biovision motion capture (.bvh).
#pragma once

#include "synth/motions/mocap_clip.h"

namespace vitruvia {

// Translations of joints other than the root are left out: bones are rigid. DataError naming file
// and line if the file is missing, damaged or cut short.
MocapClip ReadBvh(const std::filesystem::path& file);

}  // namespace vitruvia
