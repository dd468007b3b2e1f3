// Acclaim motion capture: skeletons (.asf) and motions (.amc), as the CMU database has them.
#pragma once

#include "synth/motions/mocap_clip.h"

namespace vitruvia {

// CMU's clips; the files do not say.
inline constexpr double kAmcFrame_s = 1.0 / 120.0;

// A bone of the skeleton becomes the joint at its near end. DataError naming file and line if a
// file is missing, damaged or cut short, or if the motion names a bone that the skeleton lacks.
MocapClip ReadAsfAmc(const std::filesystem::path& amc, const std::filesystem::path& asf);

}  // namespace vitruvia
