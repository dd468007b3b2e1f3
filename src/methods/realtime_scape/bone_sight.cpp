#include "methods/realtime_scape/bone_sight.h"

#include <algorithm>

namespace vitruvia::realtime_scape {
namespace {

int MainBone(const Model& model, int vertex) { return model.weights.bones[vertex][0]; }

bool FacesCamera(const Model& model, const PosedSurface& surface, int vertex) {
  const Matrix3<float> rotation =
      surface.camera_from_rest[MainBone(model, vertex)].rotation.cast<float>();
  return (rotation * model.rest_normals[vertex]).dot(surface.vertices[vertex]) < 0.0f;
}

}  // namespace

BoneSight::BoneSight(const Model& model) {
  for (int i = 0; i < static_cast<int>(model.rest_vertices.size()); ++i) {
    ++vertices_[MainBone(model, i)];
  }
}

void BoneSight::Count(const Model& model, const std::vector<int>& visible,
                      const VertexClasses& classes) {
  visible_.fill(0);
  confirmed_.fill(0);
  for (const int i : visible) ++visible_[MainBone(model, i)];
  for (const int i : classes.near_surface) ++confirmed_[MainBone(model, i)];
}

void BoneSight::EndFrame(double seen_share) {
  for (int j = 0; j < kBoneCount; ++j) {
    const bool seen = confirmed_[j] > 0 && confirmed_[j] >= seen_share * vertices_[j];
    frames_unseen_[j] = seen ? 0 : frames_unseen_[j] + 1;
  }
}

void BoneSight::Forget() { frames_unseen_.fill(0); }

CandidateFinder::CandidateFinder(const Model& model) {
  for (int i = 0; i < static_cast<int>(model.rest_vertices.size()); ++i) {
    vertices_of_[MainBone(model, i)].push_back(i);
  }
}

void CandidateFinder::Find(const Model& model, const PosedSurface& surface,
                           const std::vector<int>& visible, const BoneSight& sight,
                           const SearchSettings& settings, std::vector<int>& candidates,
                           std::vector<int>& settled) {
  settled.clear();
  if (settings.candidates == PairCandidates::kVisible) {
    candidates = visible;
    return;
  }
  candidates.clear();
  for (const int i : visible) {
    const int bone = MainBone(model, i);
    if (sight.frames_unseen(bone) > 0) continue;  // below, with those that are hidden
    (sight.IsSettled(bone, settings.settled_share) ? settled : candidates).push_back(i);
  }
  for (int j = 0; j < kBoneCount; ++j) {
    if (sight.frames_unseen(j) == 0) continue;
    for (const int i : vertices_of_[j]) {
      if (FacesCamera(model, surface, i)) candidates.push_back(i);
    }
  }
}

double ReachOf(int bone, const BoneSight& sight, const FitSettings& fit,
               const SearchSettings& search) {
  if (search.candidates == PairCandidates::kVisible) return fit.pair_cutoff_m;
  const double grown = fit.pair_cutoff_m + search.growth_m * sight.frames_unseen(bone);
  return std::max(std::min(grown, search.reach_m), fit.pair_cutoff_m);
}

}  // namespace vitruvia::realtime_scape
