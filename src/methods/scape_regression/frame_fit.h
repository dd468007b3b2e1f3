// The energy of a frame and its minimisation: Levenberg–Marquardt over the rotations of the parts.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/scape_regression/pairs.h"
#include "methods/scape_regression/scape_body.h"
#include "methods/scape_regression/settings.h"
#include "tracking/step_clock.h"

namespace vitruvia::scape_regression {

enum class TimedStep { kRender, kAssemble, kSolve, kSurface, kCount };
const char* Name(TimedStep step);

// In mm².
struct Energies {
  double depth = 0.0, contour = 0.0, pose_change = 0.0, pose = 0.0;
  double total() const { return depth + contour + pose_change + pose; }
};

struct NormalEquations {
  Eigen::Matrix<double, ScapeBody::kParameters, ScapeBody::kParameters> hessian;
  Eigen::Matrix<double, ScapeBody::kParameters, 1> gradient;
};

// E = mean ρ(depth) + weight · (mean ρ(contours one way) + mean ρ(the other way)) + change of the
// pose since the last frame + deviation of the pose from captured poses (body/pose_statistics.h).
class FrameEnergy {
 public:
  FrameEnergy(const ScapeBody& body, const PinholeCamera& camera, const Settings& settings)
      : body_(body), camera_(camera), settings_(settings) {}

  Energies Of(const Pairs& pairs, const std::vector<Vector3f>& vertices, const ScapePose& pose,
              const ScapePose& last, double kernel_m) const;
  // Gauss–Newton with the kernel applied as weights; `gradient` is half the gradient of the energy.
  NormalEquations Linearized(const Pairs& pairs, const std::vector<Vector3f>& vertices,
                             const ScapePose& pose, const ScapePose& last, double kernel_m) const;

 private:
  const ScapeBody& body_;
  PinholeCamera camera_;
  Settings settings_;
};

struct FitResult {
  ScapePose pose;
  int iterations = 0;
  bool converged = false;
  Energies energies;
  double supported = 0.0;  // share of the visible vertices whose depth is within the last kernel
};

class FrameFit {
 public:
  FrameFit(const ScapeBody& body, const PinholeCamera& camera, const Settings& settings);

  // From `start`; a change of pose is measured against `last`. Leaves the surface in `vertices`.
  FitResult Fit(const DepthImage& depth, const ScapePose& start, const ScapePose& last,
                int iterations, std::vector<Vector3f>& vertices, StepClock<TimedStep>& clock);

 private:
  double KernelAt(int iteration, int iterations) const;
  double Supported(const Pairs& pairs, const std::vector<Vector3f>& vertices) const;

  const ScapeBody& body_;
  Settings settings_;
  PairFinder finder_;
  FrameEnergy energy_;
};

}  // namespace vitruvia::scape_regression
