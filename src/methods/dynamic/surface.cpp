#include "methods/dynamic/surface.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "methods/dynamic/blend.h"

namespace vitruvia::dynamic {
namespace {

// The bones of a vertex, that of the largest weight first and the others in ascending order: what
// the vertices of a patch have in common. −1 where there are fewer than four.
using BoneSet = std::array<int, kMaxInfluences>;

BoneSet BonesOf(const SkinWeights& weights, int vertex) {
  BoneSet set;
  set.fill(-1);
  int count = 0;
  for (int k = 0; k < kMaxInfluences; ++k) {
    const int bone = weights.bones[vertex][k];
    const bool is_new = std::find(set.begin(), set.begin() + count, bone) == set.begin() + count;
    if (weights.weights[vertex][k] > 0.0f && is_new) set[count++] = bone;
  }
  std::sort(set.begin() + 1, set.begin() + count);
  return set;
}

float WeightOf(const SkinWeights& weights, int vertex, int bone) {
  float sum = 0.0f;
  for (int k = 0; k < kMaxInfluences; ++k) {
    if (weights.bones[vertex][k] == bone) sum += weights.weights[vertex][k];
  }
  return sum;
}

}  // namespace

SurfaceLayout::SurfaceLayout(const SkinWeights& weights) : slot_of_vertex(weights.size(), -1) {
  std::map<BoneSet, std::vector<int>> groups;
  for (int v = 0; v < vertex_count(); ++v) groups[BonesOf(weights, v)].push_back(v);
  for (const auto& [set, vertices] : groups) {
    Patch patch;
    for (const int bone : set) {
      if (bone >= 0) patch.bones[patch.influences++] = bone;
    }
    for (std::size_t first = 0; first < vertices.size(); first += kMaxPatchSlots) {
      const std::size_t last = std::min(first + kMaxPatchSlots, vertices.size());
      patch.begin = slot_count();
      for (std::size_t i = first; i < last; ++i) {
        slot_of_vertex[vertices[i]] = slot_count();
        vertex_of_slot.push_back(vertices[i]);
      }
      while (slot_count() % kLanes != 0) vertex_of_slot.push_back(-1);
      patch.end = slot_count();
      patches.push_back(patch);
    }
  }
}

template <class Scalar>
Surface<Scalar>::Surface(const SkinWeights& skin, const std::vector<Vector3f>& rest_vertices,
                         const std::vector<Vector3f>& rest_unit_normals)
    : layout(skin) {
  Require(rest_vertices.size() == skin.size() && rest_unit_normals.size() == skin.size(),
          "Surface: {} vertices, {} normals, weights for {}", rest_vertices.size(),
          rest_unit_normals.size(), skin.size());
  const int slots = layout.slot_count();
  for (auto& column : weights) column.assign(slots, Scalar(0));
  for (auto* columns : {&rest, &rest_normals, &posed, &normals}) columns->Resize(slots);
  for (const Patch& patch : layout.patches) {
    int vertex = -1;
    for (int slot = patch.begin; slot < patch.end; ++slot) {
      if (layout.vertex_of_slot[slot] >= 0) vertex = layout.vertex_of_slot[slot];
      rest.Set(slot, rest_vertices[vertex].template cast<Scalar>());
      if (layout.vertex_of_slot[slot] >= 0) {
        rest_normals.Set(slot, rest_unit_normals[vertex].template cast<Scalar>());
      }
      for (int k = 0; k < patch.influences; ++k) {
        weights[k][slot] = static_cast<Scalar>(WeightOf(skin, vertex, patch.bones[k]));
      }
    }
  }
}

template <class Scalar>
BoneMotions<Scalar> MotionsOf(const TreePose& pose) {
  BoneMotions<Scalar> motions;
  for (int b = 0; b < kBoneCount; ++b) {
    motions[b] = {pose.camera_from_rest[b].real.cast<Scalar>(),
                  pose.camera_from_rest[b].dual.cast<Scalar>()};
  }
  return motions;
}

namespace {

template <int N, class Scalar>
void PoseLanes(const Patch& patch, const BoneMotions<Scalar>& bones, Surface<Scalar>& s) {
  const auto q = InOneHemisphere(patch, bones);
  for (int slot = patch.begin; slot < patch.end; slot += kLanes) {
    const auto blend = LaneBlend<Scalar>::template Of<N>(q, s.weights, slot);
    LaneVector<Scalar> v = blend.Rotated(LaneVector<Scalar>::Load(s.rest, slot));
    const LaneVector<Scalar> t = blend.Translation();
    v.x += t.x;
    v.y += t.y;
    v.z += t.z;
    v.Store(slot, s.posed);
    blend.Rotated(LaneVector<Scalar>::Load(s.rest_normals, slot)).Store(slot, s.normals);
  }
}

}  // namespace

template <class Scalar>
void PosePatch(const Patch& patch, const BoneMotions<Scalar>& bones, Surface<Scalar>& surface) {
  switch (patch.influences) {
    case 1:
      return PoseLanes<1>(patch, bones, surface);
    case 2:
      return PoseLanes<2>(patch, bones, surface);
    case 3:
      return PoseLanes<3>(patch, bones, surface);
    default:
      return PoseLanes<4>(patch, bones, surface);
  }
}

template struct Surface<float>;
template struct Surface<double>;
template BoneMotions<float> MotionsOf<float>(const TreePose&);
template BoneMotions<double> MotionsOf<double>(const TreePose&);
template void PosePatch<float>(const Patch&, const BoneMotions<float>&, Surface<float>&);
template void PosePatch<double>(const Patch&, const BoneMotions<double>&, Surface<double>&);

}  // namespace vitruvia::dynamic
