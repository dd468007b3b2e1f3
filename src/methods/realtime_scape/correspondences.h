// Lines 6 and 8 of algorithm 1 (paper A): correspondences of points and vertices.
#pragma once

#include <memory>
#include <vector>

#include "methods/realtime_scape/bone_visibility.h"
#include "methods/realtime_scape/observation.h"

namespace vitruvia::realtime_scape {

// The model rendered in a pose.
struct RenderedView {
  const DepthImage* depth = nullptr;  // metres, 0: no model at this pixel
  std::vector<int> visible;           // vertices
};

// Classification of the model's vertices and the frame's points.
struct Classification {
  VertexClasses classes;         // V1 and V2 of the visible vertices
  std::vector<int> unexplained;  // P2: indices of the cloud's points
  BoneCounts counts;
};

// Model vertices with which unexplained points may be paired. PairCandidates::kVisible (paper): the
// visible ones. kReach: the visible ones of bones that are not well explained, because the points
// of a well explained bone are known already; and all camera-facing vertices of bones that have not
// been observed, because such a bone may be the one that appears.
struct VertexCandidates {
  std::vector<int> vertices;
  std::vector<int> of_explained;  // the visible vertices of well explained bones, which `vertices`
                                  // does not contain
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

  // The sets in which line 8 searches.
  struct SearchSets {
    VertexCandidates candidates;
    std::unique_ptr<NearestNeighbors> near_candidates, near_explained;
    std::vector<int> points;  // of P2, without those that belong to well explained bones
  };

  // Line 6, run after line 7, because the candidates depend on the classes.
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
