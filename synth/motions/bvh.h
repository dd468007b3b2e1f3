// Biovision motion capture (.bvh).
#pragma once

#include "synth/motions/mocap_clip.h"

namespace vitruvia {

// Keywords may be in any case; names may hold blanks. A position channel of a joint below the root
// replaces the joint's OFFSET on its axis, as most programs write it, unless the values of the
// whole clip lie nearer to 0 than to the OFFSETs: then they are added to these. A note states the
// choice. DataError naming file and line if the file is missing, damaged or cut short, or if its
// frame time is implausible for a capture system.
MocapClip ReadBvh(const std::filesystem::path& file);

}  // namespace vitruvia
