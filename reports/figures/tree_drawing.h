// A tree of bones as a drawing: the root on the left, each node joined to its parent.
#pragma once

#include "records/bone_tree.h"
#include "reports/drawing/canvas.h"

namespace vitruvia {

struct TreeSize {
  int width = 0, height = 0;  // page units
};
TreeSize SizeOf(const BoneTree& tree);

void DrawTree(Canvas& canvas, const BoneTree& tree);

}  // namespace vitruvia
