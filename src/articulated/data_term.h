// The part of the pose's normal equations that a method computes from a frame.
#pragma once

#include <vector>

#include "articulated/model_view.h"
#include "articulated/pose_system.h"
#include "core/worker_team.h"
#include "geometry/point_cloud.h"
#include "tracking/step_clock.h"
#include "tracking/tracker.h"

namespace vitruvia::articulated {

enum class TimedStep {
  kObserve,  // cloud and other data derived from the frame
  kPose,     // bones, their twists, and geometry attached to them
  kMatch,    // model against frame
  kAssemble,
  kSolve,
  kAgreement,
  kRecover,
  kSurface,  // the subject's vertices
  kCount
};
constexpr const char* Name(TimedStep step) {
  constexpr std::array kNames{"observe", "pose",      "match",   "assemble",
                              "solve",   "agreement", "recover", "surface"};
  return kNames[static_cast<std::size_t>(step)];
}
using Clock = StepClock<TimedStep>;

// A frame that holds measurements. Valid while the frame is tracked.
struct Observation {
  const DepthImage* depth;  // metres, 0: no measurement
  const PointCloud* cloud;  // camera frame, at the settings' stride; not empty
};

class DataTerm {
 public:
  virtual ~DataTerm() = default;

  virtual void Observe(const Observation& observation) = 0;
  // Called with the pose from which iterations begin.
  virtual void Begin(const MovingBones& /*bones*/) {}
  // Adds the rows of the last observed frame, linearised at the bones' pose. `progress` goes from 0
  // in the first iteration to 1 in the last one that is allowed. Charges its time to kPose, kMatch,
  // kAssemble.
  virtual void AddRows(const MovingBones& bones, double progress, WorkerTeam& team, Clock& clock,
                       PoseSystem& system) = 0;
  // Energies of the rows last added, each term once and in a fixed order; 0 before the first rows.
  virtual std::vector<NamedValue> Energies() const = 0;
};

// A width that falls geometrically from first to last while progress goes from 0 to 1.
double Narrowed(double first, double last, double progress);

}  // namespace vitruvia::articulated
