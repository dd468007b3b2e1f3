#include "learning/skinning/labels.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "learning/skinning/simplex_qp.h"

namespace vitruvia::skinning {
namespace {

// Edges of the surface between vertices of each two bones (bone × bone).
std::vector<int> SharedEdges(std::span<const std::uint8_t> labels,
                             const std::vector<Triangle>& triangles, int bone_count) {
  std::vector<int> shared(static_cast<std::size_t>(bone_count) * bone_count, 0);
  for (const Triangle& triangle : triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = labels[triangle[k]], b = labels[triangle[(k + 1) % 3]];
      if (a == b) continue;
      ++shared[a * bone_count + b];
      ++shared[b * bone_count + a];
    }
  }
  return shared;
}

}  // namespace

std::string LabelsProblem(std::span<const std::uint8_t> labels, std::size_t vertex_count,
                          int bone_count) {
  if (bone_count < 1 || bone_count > 256) {
    return fmt::format("{} bones, expected 1 to 256", bone_count);
  }
  if (labels.size() != vertex_count) {
    return fmt::format("labels for {} vertices, mesh of {}", labels.size(), vertex_count);
  }
  for (std::size_t v = 0; v < labels.size(); ++v) {
    if (labels[v] >= bone_count) {
      return fmt::format("vertex {}: label {}, but there are {} bones", v, labels[v], bone_count);
    }
  }
  return "";
}

std::string CandidatesProblem(const BoneGraph& candidates) {
  for (std::size_t label = 0; label < candidates.size(); ++label) {
    const std::vector<std::uint8_t>& bones = candidates[label];
    for (const std::uint8_t bone : bones) {
      if (bone >= candidates.size()) {
        return fmt::format("label {} may follow bone {}, but there are {} bones", label, bone,
                           candidates.size());
      }
    }
    if (std::find(bones.begin(), bones.end(), label) == bones.end()) {
      return fmt::format("bone {} is no candidate of its own label", label);
    }
    if (bones.size() > kMaxCandidates) {
      return fmt::format("label {} may follow {} bones, expected {} or fewer", label, bones.size(),
                         kMaxCandidates);
    }
  }
  return "";
}

Labels HeaviestBones(const SkinWeights& weights) {
  Labels labels(weights.size());
  for (std::size_t v = 0; v < labels.size(); ++v) {
    const auto& row = weights.weights[v];
    labels[v] = weights.bones[v][std::max_element(row.begin(), row.end()) - row.begin()];
  }
  return labels;
}

BoneGraph NeighboursOnSurface(std::span<const std::uint8_t> labels,
                              const std::vector<Triangle>& triangles, int bone_count,
                              int most_neighbours) {
  Require(most_neighbours >= 1, "NeighboursOnSurface: at most {} neighbours, expected 1 or more",
          most_neighbours);
  const std::vector<int> shared = SharedEdges(labels, triangles, bone_count);
  BoneGraph neighbours(bone_count);
  for (int bone = 0; bone < bone_count; ++bone) {
    const int* const edges = shared.data() + bone * bone_count;
    std::vector<std::uint8_t>& near = neighbours[bone];
    for (int other = 0; other < bone_count; ++other) {
      if (edges[other] > 0) near.push_back(static_cast<std::uint8_t>(other));
    }
    std::stable_sort(near.begin(), near.end(), [&](int a, int b) { return edges[a] > edges[b]; });
    if (near.size() > static_cast<std::size_t>(most_neighbours)) near.resize(most_neighbours);
    std::sort(near.begin(), near.end());
  }
  return neighbours;
}

BoneGraph BonesWithin(const BoneGraph& neighbours, int steps, int most) {
  Require(most >= 1 && steps >= 0, "BonesWithin: at most {} bones within {} steps", most, steps);
  BoneGraph within(neighbours.size());
  for (std::size_t bone = 0; bone < neighbours.size(); ++bone) {
    std::vector<std::uint8_t>& reached = within[bone];
    std::vector<bool> seen(neighbours.size(), false);
    reached.push_back(static_cast<std::uint8_t>(bone));
    seen[bone] = true;
    std::size_t ring = 0;  // where the bones of the last step begin
    for (int step = 0; step < steps; ++step) {
      const std::size_t ring_end = reached.size();
      for (; ring < ring_end; ++ring) {
        for (const std::uint8_t next : neighbours[reached[ring]]) {
          if (!seen[next]) reached.push_back(next);
          seen[next] = true;
        }
      }
      std::sort(reached.begin() + ring_end, reached.end());
    }
    if (reached.size() > static_cast<std::size_t>(most)) reached.resize(most);
  }
  return within;
}

BoneGraph CandidateBones(std::span<const std::uint8_t> labels,
                         const std::vector<Triangle>& triangles, int bone_count,
                         const Settings& settings) {
  return BonesWithin(NeighboursOnSurface(labels, triangles, bone_count, settings.neighbours),
                     settings.neighbour_steps, kMaxCandidates);
}

}  // namespace vitruvia::skinning
