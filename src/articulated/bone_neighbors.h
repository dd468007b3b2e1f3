// Bones that are adjacent in the skeleton.
#pragma once

#include "body/skeleton.h"

namespace vitruvia::articulated {

// True if both are the same bone or one is the parent of the other.
inline bool AreNeighbors(int bone, int other) {
  return bone == other || Bones()[bone].parent == other || Bones()[other].parent == bone;
}

}  // namespace vitruvia::articulated
