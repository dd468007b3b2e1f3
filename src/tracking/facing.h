// Front or back: finds out that a body is tracked with its front where its back is.
//
// A body seen from behind has nearly the outline that it has from the front, so that neither
// classes of vertices nor areas tell one from the other; depth does (depth_gap.h).
#pragma once

#include "body/skeleton.h"
#include "config/settings.h"
#include "math/rigid.h"
#include "math/vector.h"
#include "tracking/search_pause.h"

namespace vitruvia {

// Search for the other facing.
struct FacingSettings {
  double margin_m = 0.01;        // 0: facing is not checked
  double least_decrease = 0.35;  // share of the squared gap
  int pause = 5;                 // frames
  void Describe(Fields& fields);
};

// The pose with the same joints in which front and back, and left and right, are exchanged: each
// bone takes the place of its mirror image and is turned by 180° about the rest pose's vertical.
BoneTransforms FacingAway(const Skeleton& skeleton, const BoneTransforms& camera_from_rest);

// The turn by 180° about a bone's own rest-pose vertical through `center` (camera frame).
Rigidd HalfTurn(const Matrix3<double>& camera_from_rest, const Vector3<double>& center);

// Decides from the gaps in depth between model and frame when other facings are tried, and what
// they must reach to be taken.
class FacingWatch {
 public:
  explicit FacingWatch(const FacingSettings& settings)
      : settings_(settings), pause_(settings.pause) {}

  // To be called once for each frame with measurements: whether model and frame are farther apart
  // than usual and the pause since the last trial has passed. Follows the usual gap.
  bool IsDue(double gap_m2);
  // Another facing is taken if its gap is below this.
  double GapToBeat(double current_m2) const;  // m²
  // To be called after each trial: whether another facing was taken. A trial without success raises
  // the usual gap by the margin: a pose that the model cannot quite follow is not tried in each
  // frame, and a body that is tracked the wrong way round is tried again.
  void NoteTrial(bool found);

 private:
  double margin_m2() const { return settings_.margin_m * settings_.margin_m; }

  FacingSettings settings_;
  double usual_m2_ = -1.0;  // gap; negative before the first frame
  SearchPause pause_;
};

}  // namespace vitruvia
