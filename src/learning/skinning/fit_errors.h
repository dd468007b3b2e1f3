// How well a decomposition explains its examples, vertex by vertex, and which bone moves what: what
// pictures of it are coloured by.
#pragma once

#include <vector>

#include "body/skinning.h"
#include "learning/skinning/examples.h"

namespace vitruvia::skinning {

// P × V: the distance of each vertex, linearly skinned, from its place in each pose, metres.
// `poses` are the bones' transforms posed_from_rest in every pose. Misuse if numbers do not agree.
std::vector<std::vector<float>> VertexErrors(const Examples& examples, const SkinWeights& weights,
                                             const std::vector<BoneTransforms>& poses);

// V: each vertex's mean of its bones' colours by their weights; red, green, blue in 0 … 1. Colours
// of bones are far apart for neighbours in number.
std::vector<Vector3f> BoneColours(const SkinWeights& weights, int bone_count);

}  // namespace vitruvia::skinning
