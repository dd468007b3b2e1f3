// Acclaim motion capture: skeletons (.asf) and motions (.amc), as in the CMU database.
#pragma once

#include "config/settings.h"
#include "synth/motions/mocap_clip.h"

namespace vitruvia {

enum class FrameGaps { kRefuse, kInterpolate };

struct AmcSettings {
  double fps = 120.0;  // CMU's clips; most files do not say
  FrameGaps gaps = FrameGaps::kRefuse;

  void Describe(Fields& fields);
};

// A bone of the skeleton becomes the joint at its near end. Translations of bones other than the
// root are in the bone's own axes and added to its place at rest. A frame's time is its number
// divided by the rate; numbers must increase. DataError naming file and line if a file is missing,
// damaged or cut short, if the motion names a bone that the skeleton lacks, if a header word is
// unknown, if the file's own rate is not that of the settings, or if frame numbers jump and the
// settings do not say that gaps are to be filled.
MocapClip ReadAsfAmc(const std::filesystem::path& amc, const std::filesystem::path& asf,
                     const AmcSettings& settings = {});

}  // namespace vitruvia
