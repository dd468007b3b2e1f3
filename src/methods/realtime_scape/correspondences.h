// Lines 6 and 8 of algorithm 1 (paper A): which points and vertices are paired.
#pragma once

#include <memory>
#include <vector>

#include "methods/realtime_scape/bone_visibility.h"
#include "methods/realtime_scape/observation.h"

namespace vitruvia::realtime_scape {

// The model as it would be seen in some pose.
struct RenderedView {
  const DepthImage* depth = nullptr;  // metres, 0 where the model is not
  std::vector<int> visible;           // vertices
};

// What model and frame say of each other.
struct Classification {
  VertexClasses classes;         // V1 and V2 of the visible vertices
  std::vector<int> unexplained;  // P2: indices of the cloud's points
  BoneCounts counts;
};

// Model vertices with which unexplained points may be paired. Paper: the visible ones. Reach: those
// of bones that are not well explained, for the points of a well explained bone are known; and all
// vertices that face the camera of a bone that has not been observed, for it may be what appears.
struct VertexCandidates {
  std::vector<int> vertices;
  std::vector<int> of_explained;  // the visible vertices of well explained bones, left out above
};
void FindVertexCandidates(const Model& model, const PosedSurface& surface,
                          const std::vector<int>& visible, const BoneCounts& counts,
                          const BoneVisibility& visibility, const SearchSettings& settings,
                          VertexCandidates& candidates);

// Upper bound of the distance between a bone's vertices and the points paired with them, metres. It
// grows with every frame in which the bone is not observed.
double SearchRadius(int bone, const BoneVisibility& visibility, const FitSettings& fit,
                    const SearchSettings& search);

class CorrespondenceFinder {
 public:
  CorrespondenceFinder(const Model& model, const PinholeCamera& camera, const Settings& settings);

  // What line 8 searches in.
  struct SearchSets {
    VertexCandidates candidates;
    std::unique_ptr<NearestNeighbors> near_candidates, near_explained;
    std::vector<int> points;  // of P2, without those that belong to well explained bones
  };

  // Line 6. After line 7, on whose classes the candidates depend.
  const SearchSets& BuildSearchSets(const Observation& observation, const PosedSurface& surface,
                                    const RenderedView& view, const Classification& classification,
                                    const BoneVisibility& visibility);
  // Line 8: pairs of V2, then of P2.
  const std::vector<Pair>& FindPairs(const Observation& observation, const PosedSurface& surface,
                                     const Classification& classification, const SearchSets& sets,
                                     const BoneVisibility& visibility);

 private:
  void Build(const PosedSurface& surface, const std::vector<int>& vertices,
             NearestNeighbors& neighbors);

  const Model& model_;
  FitSettings fit_;
  SearchSettings search_;
  PairFinder pair_finder_;
  // Kept between iterations to avoid allocation.
  SearchSets sets_;
  std::vector<Pair> pairs_;
  std::vector<Vector3f> positions_;
};

}  // namespace vitruvia::realtime_scape
