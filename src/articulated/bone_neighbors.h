// Which bones touch by construction.
#pragma once

#include "body/skeleton.h"

namespace vitruvia::articulated {

// One bone and itself, or its parent.
inline bool AreNeighbors(int bone, int other) {
  return bone == other || Bones()[bone].parent == other || Bones()[other].parent == bone;
}

}  // namespace vitruvia::articulated
