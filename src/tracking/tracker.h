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
  // Known joints of the first frame, camera frame; may be empty. A start by search begins at them.
  KnownJoints known{};
};

enum class Outcome {
  kConverged,       // the stopping rule was met
  kIterationLimit,  // stopped by the iteration limit: usable, but not converged
  kLost,            // too little of the model is supported by the data; the pose is a guess
  kNoData,          // the frame holds no measurement; the pose is that of the last frame
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
  std::string message;                  // reason of the outcome, for the user; "" when converged
  std::vector<Vector3f> vertices;       // the subject's surface, camera frame, metres
  std::vector<Vector3<double>> joints;  // one for each bone: its proximal end, camera frame, metres
  // Optional uncertainty of the joints (joint_uncertainty.h): each joint's covariance, m², and
  // whether it is unreliable. Empty: not estimated.
  std::vector<Matrix3<double>> joint_covariances{};
  std::vector<bool> unreliable_joints{};
  BoneTransforms camera_from_rest;  // one for each bone; empty for methods without bones
  int iterations = 0;
  std::vector<NamedValue> energies;  // at the last linearisation, weighted as minimised
  std::vector<NamedValue> step_ms;   // summed over the frame's iterations
  double condition = -1.0;           // of the normal equations; -1 if not estimated
  // Largest relative increase of the energy in a step, at fixed correspondences; 0 if no step
  // increased it, -1 if not evaluated.
  double energy_rise = -1.0;
  // Check of the last normal equations (solver/system_check.h): number of eigenvalues below 1e-6 of
  // the largest, and number of digits in which the solution agrees with a reference; -1 if not
  // checked.
  int weak_directions = -1;
  double agreeing_digits = -1.0;
};

class Tracker {
 public:
  virtual ~Tracker() = default;
  // To be called before the first frame, in which the subject stands in the rest pose facing the
  // camera, upright to within some 30 degrees. Throws std::invalid_argument for a subject that the
  // method cannot use.
  virtual void Start(const Subject& subject, const PinholeCamera& camera) = 0;
  virtual TrackResult TrackFrame(const DepthFrame& frame) = 0;
};

}  // namespace vitruvia
