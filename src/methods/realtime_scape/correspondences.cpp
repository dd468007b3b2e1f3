#include "methods/realtime_scape/correspondences.h"

#include <algorithm>

#include "math/rigid.h"

namespace vitruvia::realtime_scape {
namespace {

bool FacesCamera(const Model& model, const PosedSurface& surface, int vertex) {
  const Matrix3<float> rotation =
      surface.camera_from_rest[model.MainBone(vertex)].rotation.cast<float>();
  return (rotation * model.rest_normals[vertex]).dot(surface.vertices[vertex]) < 0.0f;
}

}  // namespace

void FindVertexCandidates(const Model& model, const PosedSurface& surface,
                          const std::vector<int>& visible, const BoneCounts& counts,
                          const BoneVisibility& visibility, const SearchSettings& settings,
                          VertexCandidates& candidates) {
  candidates.of_explained.clear();
  if (settings.candidates == PairCandidates::kVisible) {
    candidates.vertices = visible;
    return;
  }
  candidates.vertices.clear();
  for (const int i : visible) {
    const int bone = model.MainBone(i);
    if (visibility.frames_unobserved[bone] > 0) continue;  // below, with those that are hidden
    const bool is_explained = counts.IsWellExplained(bone, settings.well_explained_share);
    (is_explained ? candidates.of_explained : candidates.vertices).push_back(i);
  }
  for (int j = 0; j < kBoneCount; ++j) {
    if (visibility.frames_unobserved[j] == 0) continue;
    for (const int i : model.vertices_of_bone[j]) {
      if (FacesCamera(model, surface, i)) candidates.vertices.push_back(i);
    }
  }
}

double SearchRadius(int bone, const BoneVisibility& visibility, const FitSettings& fit,
                    const SearchSettings& search) {
  if (search.candidates == PairCandidates::kVisible) return fit.pair_cutoff_m;
  const double grown = fit.pair_cutoff_m + search.growth_m * visibility.frames_unobserved[bone];
  return std::max(std::min(grown, search.reach_m), fit.pair_cutoff_m);
}

CorrespondenceFinder::CorrespondenceFinder(const Model& model, const PinholeCamera& camera,
                                           const Settings& settings)
    : model_(model), fit_(settings.fit), search_(settings.search) {
  sets_.near_candidates = MakeNearestNeighbors(fit_.association, camera, fit_.window_px);
  sets_.near_explained = MakeNearestNeighbors(fit_.association, camera, fit_.window_px);
}

void CorrespondenceFinder::Build(const PosedSurface& surface, const std::vector<int>& vertices,
                                 NearestNeighbors& neighbors) {
  positions_.clear();
  for (const int i : vertices) positions_.push_back(surface.vertices[i]);
  neighbors.Build(positions_);
}

const CorrespondenceFinder::SearchSets& CorrespondenceFinder::BuildSearchSets(
    const Observation& observation, const PosedSurface& surface, const RenderedView& view,
    const Classification& classification, const BoneVisibility& visibility) {
  FindVertexCandidates(model_, surface, view.visible, classification.counts, visibility, search_,
                       sets_.candidates);
  sets_.points = classification.unexplained;
  Build(surface, sets_.candidates.vertices, *sets_.near_candidates);
  if (sets_.candidates.of_explained.empty()) return sets_;
  // Points at the surface of a well explained bone belong to it.
  Build(surface, sets_.candidates.of_explained, *sets_.near_explained);
  pair_finder_.DropNear(observation.cloud, *sets_.near_explained,
                        static_cast<float>(search_.owned_m), sets_.points);
  return sets_;
}

const std::vector<Pair>& CorrespondenceFinder::FindPairs(const Observation& observation,
                                                         const PosedSurface& surface,
                                                         const Classification& classification,
                                                         const SearchSets& sets,
                                                         const BoneVisibility& visibility) {
  std::array<float, kBoneCount> radius;
  for (int j = 0; j < kBoneCount; ++j) {
    radius[j] = static_cast<float>(SearchRadius(j, visibility, fit_, search_));
  }
  pairs_.clear();
  pair_finder_.VerticesToPoints(surface.vertices, classification.classes.elsewhere,
                                observation.cloud, *observation.near_cloud,
                                static_cast<float>(fit_.pair_cutoff_m), pairs_);
  pair_finder_.PointsToVertices(
      observation.cloud, sets.points, sets.candidates.vertices, *sets.near_candidates,
      *std::max_element(radius.begin(), radius.end()),
      [&](int vertex) { return radius[model_.MainBone(vertex)]; }, pairs_);
  return pairs_;
}

}  // namespace vitruvia::realtime_scape
