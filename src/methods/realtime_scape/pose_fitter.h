// Lines 4 to 12 of algorithm 1 (paper A): the pose that minimises the energy for one frame.
#pragma once

#include <memory>
#include <optional>

#include "geometry/mesh_rasterizer.h"
#include "methods/realtime_scape/correspondences.h"
#include "methods/realtime_scape/pose_step.h"
#include "methods/realtime_scape/prediction.h"
#include "methods/realtime_scape/terms/energy_terms.h"
#include "methods/realtime_scape/terms/free_space_term.h"
#include "methods/realtime_scape/terms/joint_term.h"
#include "solver/linear_solver.h"
#include "solver/system_check.h"
#include "tracking/agreement.h"
#include "tracking/realtime_scape_steps.h"
#include "tracking/step_clock.h"

namespace vitruvia::realtime_scape {

struct FitSummary {
  BodyPose pose;
  PosedSurface surface;  // in that pose
  // Of the last classification, which precedes the last step.
  Agreement agreement;
  BoneCounts counts;
  Energies energies{};      // at the last linearisation
  double energy_rise = -1;  // see TrackResult
  double condition = -1;    // of the last normal equations; -1 if not estimated
  // Of the last normal equations (tracking/joint_uncertainty.h); empty if not requested.
  std::vector<Matrix3<double>> unit_covariances;
  std::vector<JointSupport> supports;  // filled by the tracker if requested
  std::optional<SystemCheck> check;    // of the last step, if solver.watch_energy is set
  int iterations = 0;
  int inexact_steps = 0;   // steps that conjugate gradients did not solve to their tolerance
  bool converged = false;  // the stopping rule was met
  bool solved = true;      // false: `pose` is that of the last frame
  StepTimes<RealtimeScapeStep> times;
};

// How well the model in some pose agrees with a frame.
struct PoseCheck {
  Agreement agreement;
  BoneCounts counts;
};

// Fits the pose of one model, step by step; a step's result stays valid until the step's next call.
// Only buffers are kept between calls of Fit.
class PoseFitter {
 public:
  // `model` must outlive the fitter.
  PoseFitter(const Model& model, const PinholeCamera& camera, const Settings& settings);

  // Iterates from the predicted pose, at most max_iterations (≥ 1) times. The observation must hold
  // points. If the equations have no solution or the pose diverges, the pose is history.last.
  FitSummary Fit(const Observation& observation, const PoseHistory& history,
                 const Prediction& prediction, int max_iterations);

  // Lines 5 and 7 for a pose, without iterations.
  PoseCheck Compare(const Observation& observation, const BodyPose& pose);
  // Fits a hypothesis: a body at rest in `pose`. Agreement and counts are those of the pose that is
  // reached, which is compared last.
  FitSummary Refine(const Observation& observation, const BodyPose& pose, int max_iterations);
  // Points of the cloud that the pose of the last Fit or Compare does not explain, by their
  // indices.
  const std::vector<int>& unexplained() const { return classification_.unexplained; }
  // Depth of the model in the last iteration of Fit, or in the pose of Compare.
  const DepthImage& rendered() const { return *view_.depth; }
  // Mean of the vertices that are visible in a pose (camera frame, metres); the root's centre if
  // none is.
  Vector3d VisibleCentroid(const BodyPose& pose);

 private:
  struct Solution {
    const Eigen::VectorXd& increment;
    SolveStatus status;
  };

  const PosedSurface& Pose(const BodyPose& pose);
  const RenderedView& Render(const PosedSurface& surface);
  const Classification& Classify(const Observation& observation, const PosedSurface& surface,
                                 const RenderedView& view);
  void AverageDepth(const Observation& observation, const PosedSurface& surface,
                    const RenderedView& view);
  void SharePixels(const PosedSurface& surface);
  const std::vector<Pair>& Correspond(const Observation& observation, const PosedSurface& surface,
                                      const RenderedView& view,
                                      const Classification& classification,
                                      const BoneVisibility& visibility);
  const FreeSpace& Delimit(const Observation& observation, const PosedSurface& surface,
                           const Classification& classification);
  Energies Assemble(const TermInput& input);
  Solution Solve(const BlockNormalEquations& equations);
  double EnergyRise(const BlockNormalEquations& before, const TermInput& after);
  std::vector<Matrix3<double>> JointUnitCovariances(const BodyPose& pose) const;
  bool IsSmall(const PoseStep& step) const;
  bool IsWorthless(const Eigen::VectorXd& increment) const;

  const Model& model_;
  PinholeCamera camera_;
  Settings settings_;
  JointTerm joint_term_;
  std::unique_ptr<MeshRasterizer> rasterizer_;
  PixelSharing pixel_sharing_;
  CorrespondenceFinder correspondence_finder_;
  std::unique_ptr<LinearSolver> solver_;
  StepClock<RealtimeScapeStep> clock_;

  // Kept between iterations to avoid allocation.
  PosedSurface surface_;
  RenderedView view_;
  Classification classification_;
  FreeSpace free_space_;
  BlockNormalEquations equations_, equations_after_;  // before and after a step
  Eigen::VectorXd descent_, increment_;               // −g, and the x of H x = −g
};

}  // namespace vitruvia::realtime_scape
