// How much of each bone the data confirm, and for how long they have not.
#pragma once

#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/settings.h"
#include "tracking/classification.h"

namespace vitruvia::realtime_scape {

class BoneSight {
 public:
  explicit BoneSight(const Model& model);

  // Counts one iteration's visible and confirmed (V1) vertices by the bone that moves them most.
  void Count(const Model& model, const std::vector<int>& visible, const VertexClasses& classes);
  // Takes the last count as this frame's. A bone is seen when at least seen_share of all its
  // vertices are confirmed; one without vertices never is.
  void EndFrame(double seen_share);
  void Forget();  // as at the start: every bone just seen

  // Whether nearly all that the model shows of a bone is confirmed in the current iteration.
  bool IsSettled(int bone, double settled_share) const {
    return confirmed_[bone] > settled_share * visible_[bone];
  }
  int frames_unseen(int bone) const { return frames_unseen_[bone]; }

 private:
  std::array<int, kBoneCount> vertices_{}, visible_{}, confirmed_{}, frames_unseen_{};
};

// The model's vertices that an unexplained point (P2) may belong to.
class CandidateFinder {
 public:
  explicit CandidateFinder(const Model& model);

  // Paper: the visible ones. Reach: no vertex of a bone that is settled, for such a bone has its
  // points; and of a bone that has not been seen, all that face the camera, for it may be what
  // comes into sight. `settled` are the visible vertices left out.
  void Find(const Model& model, const PosedSurface& surface, const std::vector<int>& visible,
            const BoneSight& sight, const SearchSettings& settings, std::vector<int>& candidates,
            std::vector<int>& settled);

 private:
  std::array<std::vector<int>, kBoneCount> vertices_of_;
};

// How far from a bone's vertices its points may be: farther the longer it was not seen.
double ReachOf(int bone, const BoneSight& sight, const FitSettings& fit,
               const SearchSettings& search);

}  // namespace vitruvia::realtime_scape
