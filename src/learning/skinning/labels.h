// Labels (one bone per vertex), neighbouring bones, and the candidate bones of vertices.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "body/skinning.h"
#include "learning/skinning/settings.h"

namespace vitruvia::skinning {

using Labels = std::vector<std::uint8_t>;                  // V, a bone each
using BoneGraph = std::vector<std::vector<std::uint8_t>>;  // per bone its neighbours, ascending

// "" if labels are valid for that many vertices and bones, otherwise what is wrong.
std::string LabelsProblem(std::span<const std::uint8_t> labels, std::size_t vertex_count,
                          int bone_count);

// "" if every label's candidates contain its own bone and only existing bones.
std::string CandidatesProblem(const BoneGraph& candidates);

Labels HeaviestBones(const SkinWeights& weights);

// Bones are neighbours if an edge of the surface connects vertices of both. Each bone keeps only
// the `most_neighbours` (≥ 1) with which it shares most edges (paper A, sec. 4: at most 3).
BoneGraph NeighboursOnSurface(std::span<const std::uint8_t> labels,
                              const std::vector<Triangle>& triangles, int bone_count,
                              int most_neighbours);

// Per bone, itself and those within that many steps of the graph, nearest first, at most `most`
// (≥ 1); among equally near ones those of lower index.
BoneGraph BonesWithin(const BoneGraph& neighbours, int steps, int most);

// Both functions combined, with the settings' parameters: the bones that a vertex of each label may
// follow.
BoneGraph CandidateBones(std::span<const std::uint8_t> labels,
                         const std::vector<Triangle>& triangles, int bone_count,
                         const Settings& settings);

}  // namespace vitruvia::skinning
