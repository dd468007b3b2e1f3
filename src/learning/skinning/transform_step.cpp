#include "learning/skinning/transform_step.h"

#include <algorithm>

#include "math/rotation.h"
#include "math/vector.h"

namespace vitruvia::skinning {
namespace {

constexpr int kPoseChunks = 16;  // of poses, each with a workspace of its own

// Damping of the linearised step, relative to the diagonal.
constexpr double kLeastDamping = 1e-12;
constexpr double kFirstRaisedDamping = 1e-4;
constexpr double kDampingFactor = 10.0;
constexpr int kMostRejections = 8;

}  // namespace

// One pose's problem: the change D from `start` lowers the energy by 2 ⟨cross, D⟩ − ⟨D, second D⟩.
struct TransformStep::Workspace {
  PoseBlock start, now, trial, change, cross, pull;
  Eigen::VectorXd step;
  PoseEquations equations;

  explicit Workspace(int bones)
      : start(4 * bones, 3),
        now(4 * bones, 3),
        trial(4 * bones, 3),
        change(4 * bones, 3),
        cross(4 * bones, 3),
        pull(4 * bones, 3),
        step(6 * bones) {}

  double Gain(const Eigen::MatrixXd& second, const PoseBlock& reached);
  double SolveClosedForm(const Eigen::MatrixXd& second, int steps);
  double SolveLinearised(const BonePattern& pattern, const Eigen::MatrixXd& second, int steps);
};

double TransformStep::Workspace::Gain(const Eigen::MatrixXd& second, const PoseBlock& reached) {
  change = reached - start;
  pull.noalias() = second * change;
  return 2.0 * cross.cwiseProduct(change).sum() - pull.cwiseProduct(change).sum();
}

double TransformStep::Workspace::SolveClosedForm(const Eigen::MatrixXd& second, int steps) {
  for (int round = 0; round < steps; ++round) {
    for (int row = 0; row < start.rows(); row += 4) {
      const Eigen::Matrix4d own = second.block<4, 4>(row, row);
      const double mass = own(3, 3);
      if (!(mass > 0.0)) continue;
      // What the other bones leave for this one to explain, and its weighted centroids.
      change = now - start;
      Eigen::Matrix<double, 4, 3> target = cross.middleRows<4>(row);
      target.noalias() += own * now.middleRows<4>(row);
      target.noalias() -= second.middleRows<4>(row) * change;
      const Vector3<double> centre = own.block<3, 1>(0, 3) / mass;
      const Vector3<double> posed_centre = target.row(3).transpose() / mass;
      const Matrix3<double> covariance =
          target.topRows<3>().transpose() - mass * posed_centre * centre.transpose();
      const Matrix3<double> rotation = NearestRotation<double>(covariance);
      now.middleRows<3>(row) = rotation.transpose();
      now.row(row + 3) = (posed_centre - rotation * centre).transpose();
    }
  }
  return Gain(second, now);
}

double TransformStep::Workspace::SolveLinearised(const BonePattern& pattern,
                                                 const Eigen::MatrixXd& second, int steps) {
  double gain = 0.0, damping = kLeastDamping;
  for (int round = 0; round < steps; ++round) {
    equations.Linearise(pattern, second, now);
    bool improved = false;
    for (int rejections = 0; rejections < kMostRejections && !improved; ++rejections) {
      if (equations.Factor(pattern, damping)) {
        change = now - start;
        pull = cross;
        pull.noalias() -= second * change;
        Adjoint(now, pull, step);
        equations.SolveInPlace(pattern, step);
        Move(now, step, trial);
        const double trial_gain = Gain(second, trial);
        improved = trial_gain > gain;
        if (improved) gain = trial_gain;
      }
      if (!improved) damping = std::max(damping * kDampingFactor, kFirstRaisedDamping);
    }
    if (!improved) break;
    now.swap(trial);
    damping = std::max(damping / kDampingFactor, kLeastDamping);
  }
  return gain;
}

TransformStep::TransformStep(int bones, int poses, TransformSolver solver, int steps,
                             WorkerTeam& team)
    : solver_(solver),
      steps_(steps),
      team_(team),
      workspaces_(std::min(kPoseChunks, poses), Workspace(bones)),
      gains_(poses) {}

TransformStep::~TransformStep() = default;

double TransformStep::Solve(const BonePattern& pattern, const SkinMoments& moments,
                            BoneStack& stack) {
  const int chunks = static_cast<int>(workspaces_.size()), poses = PoseCount(stack);
  team_.For(chunks, 1, [&](int begin, int end) {
    for (int chunk = begin; chunk < end; ++chunk) {
      Workspace& work = workspaces_[chunk];
      for (int p = poses * chunk / chunks; p < poses * (chunk + 1) / chunks; ++p) {
        work.start = work.now = stack.middleCols<3>(3 * p);
        work.cross = moments.cross.middleCols<3>(3 * p);
        gains_[p] = solver_ == TransformSolver::kClosedForm
                        ? work.SolveClosedForm(moments.second, steps_)
                        : work.SolveLinearised(pattern, moments.second, steps_);
        if (gains_[p] > 0.0) stack.middleCols<3>(3 * p) = work.now;
      }
    }
  });
  double energy = moments.energy;
  for (const double gain : gains_) energy -= std::max(gain, 0.0);
  return energy;
}

}  // namespace vitruvia::skinning
