// Knowing that the subject is lost, and where to look for it. Paper A lists this as future work.
#pragma once

#include <vector>

#include "matching/classification.h"
#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/settings.h"

namespace vitruvia::realtime_scape {

// How well model and frame agree, 0 … 1: the share of the cloud that the model explains, times the
// share that the frame confirms (V1) of the visible vertices on which it has a say (V1 and V2).
double Agreement(std::size_t points, std::size_t unexplained, const VertexClasses& classes);

// Remembers how well frames usually agree and poses that did.
class Recovery {
 public:
  explicit Recovery(const RecoverySettings& settings) : settings_(settings) {}

  // Takes note of a frame. True if other poses should be tried for it: agreement has been below its
  // usual level for `patience` frames, or is low in the first one already; what the first then
  // reaches is usual.
  bool Note(double agreement, const BodyPose& pose);
  // Another pose was found to agree better.
  void Found(double agreement);

  bool is_lost() const { return misses_ > 0; }
  double usual_agreement() const { return usual_; }

  // Poses to try: those remembered and `latest`, each turned about the camera's vertical axis in
  // steps of 45 degrees, upright and upside down. Where they stand is left to the caller.
  std::vector<BodyPose> Hypotheses(const BodyPose& latest) const;

 private:
  void Remember(const BodyPose& pose);

  RecoverySettings settings_;
  double usual_ = 1.0;
  bool is_first_ = true;
  int misses_ = 0;                    // frames in a row
  std::vector<BodyPose> remembered_;  // the first is that of the first frame
  std::size_t next_ = 1;              // to be replaced
};

// The same pose elsewhere: every bone moved by `shift` (camera frame, metres).
BodyPose Shifted(BodyPose pose, const Vector3<double>& shift);

}  // namespace vitruvia::realtime_scape
