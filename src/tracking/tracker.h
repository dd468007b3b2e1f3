// The interface of a tracker: a Subject and one DepthFrame at a time in, a TrackResult out.
// A tracker never sees ground truth, metrics or files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "body/body_model.h"
#include "fitting/joint_fit.h"
#include "geometry/camera.h"
#include "geometry/image.h"
#include "math/rigid.h"

namespace vitruvia {

// What a tracker may know of the person.
using Subject = BodyModel;

struct DepthFrame {
  int index = 0;
  double time_s = 0.0;
  DepthImage depth;  // metres along z, 0 = no measurement; the body only, background removed
  // Joints that may be known of the first frame, camera frame; a start by search begins there.
  KnownJoints known{};
};

enum class Outcome {
  kConverged,       // the stopping rule was met
  kIterationLimit,  // stopped by the limit: usable, but not at rest
  kLost,            // too little of the model is supported by the data; the pose is a guess
  kNoData,          // the frame holds no measurement; the pose is carried over
};
const char* Name(Outcome outcome);
inline bool IsFailure(Outcome outcome) {
  return outcome == Outcome::kLost || outcome == Outcome::kNoData;
}

// A named number, in a fixed order per method: energies per term, milliseconds per step.
struct NamedValue {
  std::string name;
  double value = 0.0;
};

struct TrackResult {
  Outcome outcome = Outcome::kNoData;
  std::string message;                  // why, for a person; "" when converged
  std::vector<Vector3f> vertices;       // the subject's surface, camera frame, metres
  std::vector<Vector3<double>> joints;  // one for each bone: its proximal end, camera frame, metres
  // What trackers say of their joints' accuracy, where they are asked (joint_uncertainty.h): each
  // joint's covariance, m², and whether it should not be relied on. Empty: nothing.
  std::vector<Matrix3<double>> joint_covariances{};
  std::vector<bool> unreliable_joints{};
  BoneTransforms camera_from_rest;  // one for each bone; empty for methods without bones
  int iterations = 0;
  std::vector<NamedValue> energies;  // at the last linearisation, weighted as minimised
  std::vector<NamedValue> step_ms;   // summed over the frame's iterations
  double condition = -1.0;           // of the normal equations; -1 where not estimated
  // By what share of itself a step raised the energy at most, its correspondences kept; 0 where
  // none did, -1 where that was not looked at.
  double energy_rise = -1.0;
  // Of the last normal equations, where they were checked (solver/system_check.h): eigenvalues
  // below 1e-6 of the largest, and digits in which the solution agrees with a slow one; -1
  // elsewhere.
  int weak_directions = -1;
  double agreeing_digits = -1.0;
};

class Tracker {
 public:
  virtual ~Tracker() = default;
  // Before the first frame, in which the subject stands in the rest pose facing the camera, upright
  // to within some 30 degrees. Throws std::invalid_argument on a subject the method cannot use.
  virtual void Start(const Subject& subject, const PinholeCamera& camera) = 0;
  virtual TrackResult TrackFrame(const DepthFrame& frame) = 0;
};

}  // namespace vitruvia
