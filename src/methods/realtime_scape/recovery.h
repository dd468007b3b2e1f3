// Knowing that the subject is lost, and where to look for it. Paper A lists this as future work.
#pragma once

#include <vector>

#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/settings.h"
#include "tracking/classification.h"

namespace vitruvia::realtime_scape {

// How well model and frame fit each other.
struct Agreement {
  double explained = 0.0;  // share of the cloud that the model explains
  double confirmed = 0.0;  // share of V1 in V1 and V2: of what the frame has a say on
  double judged = 0.0;  // share of V1 and V2 in all visible vertices; the rest is behind something

  // Whether the body is where the model is, 0 … 1. What stands before the body, or beside it, does
  // not count against it, unless so much is hidden that only the cloud can tell.
  double presence() const;
  // Of two poses for one frame the one to prefer has more.
  double score() const { return explained * confirmed; }
};
Agreement MeasureAgreement(std::size_t points, std::size_t unexplained, std::size_t visible,
                           const VertexClasses& classes);

// Remembers how well frames usually agree and poses that did.
class Recovery {
 public:
  explicit Recovery(const RecoverySettings& settings) : settings_(settings) {}

  // Takes note of a frame. True if other poses should be tried for it: agreement has been below its
  // usual level for `patience` frames, empty ones included, or is low in the first one already;
  // what the first then reaches is usual.
  bool Note(const Agreement& agreement, const BodyPose& pose);
  void NoteEmptyFrame() { ++misses_; }
  // Whether `other` is so much better than `current` that its pose should be taken: more of both
  // sides agrees, and no less of the model, so that no post is taken for the body that it hides.
  bool IsBetter(const Agreement& other, const Agreement& current) const;
  // A better pose was taken.
  void Found(const Agreement& agreement);

  bool is_lost() const { return misses_ > 0; }
  const Agreement& usual() const { return usual_; }

  // Poses to try: those remembered and `latest`, each turned about the camera's vertical axis in
  // steps of 45 degrees, upright and upside down. Where they stand is left to the caller.
  std::vector<BodyPose> Hypotheses(const BodyPose& latest) const;

 private:
  bool IsLow(const Agreement& agreement) const;
  void Remember(const BodyPose& pose);

  RecoverySettings settings_;
  Agreement usual_{1.0, 1.0, 1.0};
  bool is_first_ = true;
  int misses_ = 0;                    // frames in a row
  int pause_ = 0;                     // frames before the next attempt
  std::vector<BodyPose> remembered_;  // the first is that of the first frame
  std::size_t next_ = 1;              // to be replaced
};

// The same pose elsewhere: every bone moved by `shift` (camera frame, metres).
BodyPose Shifted(BodyPose pose, const Vector3<double>& shift);

}  // namespace vitruvia::realtime_scape
