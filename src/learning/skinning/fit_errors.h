// Errors of a decomposition at each vertex of its examples.
#pragma once

#include <vector>

#include "body/skinning.h"
#include "learning/skinning/examples.h"

namespace vitruvia::skinning {

// P × V: the distance of each vertex, linearly skinned, from its place in each pose, metres.
// `poses` are the bones' transforms posed_from_rest in every pose. std::invalid_argument if sizes
// do not agree.
std::vector<std::vector<float>> VertexErrors(const Examples& examples, const SkinWeights& weights,
                                             const std::vector<BoneTransforms>& poses);

}  // namespace vitruvia::skinning
