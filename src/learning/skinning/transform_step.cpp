#include "learning/skinning/transform_step.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "core/parallel.h"
#include "math/rigid.h"

namespace vitruvia::skinning {
namespace {

constexpr int kChunks = 16;  // of poses, each with a workspace of its own

// Damping of the linearised step, relative to the diagonal.
constexpr double kLeastDamping = 1e-12;
constexpr double kFirstRaisedDamping = 1e-4;
constexpr double kDampingFactor = 10.0;
constexpr int kMostRejections = 8;
// A pose is solved when a step gains less, relative to its energy.
constexpr double kLeastPoseGain = 1e-12;

using PoseBlock = Eigen::Matrix<double, Eigen::Dynamic, 3>;  // 4B × 3
using Block43 = Eigen::Matrix<double, 4, 3>;

Matrix3<double> RotationOf(const PoseBlock& pose, int bone) {
  return pose.block<3, 3>(4 * bone, 0).transpose();
}

}  // namespace

// One pose's problem: D = now − start lowers the energy by 2 ⟨cross, D⟩ − ⟨D, second D⟩.
struct TransformStep::Workspace {
  PoseBlock start, now, trial, cross, pull;
  Eigen::MatrixXd normal, damped;
  Eigen::VectorXd right, step;
  Eigen::LLT<Eigen::MatrixXd> cholesky;

  explicit Workspace(int bones)
      : start(4 * bones, 3),
        now(4 * bones, 3),
        trial(4 * bones, 3),
        cross(4 * bones, 3),
        pull(4 * bones, 3),
        normal(6 * bones, 6 * bones),
        damped(6 * bones, 6 * bones),
        right(6 * bones),
        step(6 * bones),
        cholesky(6 * bones) {}

  int bones() const { return static_cast<int>(start.rows() / 4); }
  double Gain(const PoseBlock& stack, const Eigen::MatrixXd& second);
  double SolveClosedForm(const Eigen::MatrixXd& second, int steps);
  double SolveLinearised(const Eigen::MatrixXd& second, int steps);
  void Linearise(const Eigen::MatrixXd& second);
  void LinearisePair(const Eigen::Matrix4d& second, int a, int b);
  void MoveTrial();
};

double TransformStep::Workspace::Gain(const PoseBlock& stack, const Eigen::MatrixXd& second) {
  trial = stack - start;  // `trial` is scratch here: callers pass `now`, or are done with it
  pull.noalias() = second * trial;
  return 2.0 * cross.cwiseProduct(trial).sum() - pull.cwiseProduct(trial).sum();
}

double TransformStep::Workspace::SolveClosedForm(const Eigen::MatrixXd& second, int steps) {
  for (int step_number = 0; step_number < steps; ++step_number) {
    for (int b = 0; b < bones(); ++b) {
      const Eigen::Matrix4d own = second.block<4, 4>(4 * b, 4 * b);
      const double mass = own(3, 3);
      if (!(mass > 0.0)) continue;
      // What the other bones leave for this one to explain, and its weighted centroids.
      Block43 target = cross.middleRows<4>(4 * b) + own * now.middleRows<4>(4 * b);
      target -= second.middleRows<4>(4 * b) * (now - start);
      const Vector3<double> centre = own.block<3, 1>(0, 3) / mass;
      const Vector3<double> posed_centre = target.row(3).transpose() / mass;
      const Matrix3<double> covariance =
          target.topRows<3>().transpose() - mass * posed_centre * centre.transpose();
      const Matrix3<double> rotation = NearestRotation<double>(covariance);
      now.block<3, 3>(4 * b, 0) = rotation.transpose();
      now.row(4 * b + 3) = (posed_centre - rotation * centre).transpose();
    }
  }
  return Gain(now, second);
}

void TransformStep::Workspace::LinearisePair(const Eigen::Matrix4d& second, int a, int b) {
  const Matrix3<double> rotation_a = RotationOf(now, a), rotation_b = RotationOf(now, b);
  const Matrix3<double> arms = rotation_b * second.topLeftCorner<3, 3>() * rotation_a.transpose();
  const Vector3<double> centre = second.topRightCorner<3, 1>();
  auto block = normal.block<6, 6>(6 * a, 6 * b);
  block.topLeftCorner<3, 3>() = arms.trace() * Matrix3<double>::Identity() - arms;
  block.topRightCorner<3, 3>() = Skew<double>(rotation_a * centre);
  block.bottomLeftCorner<3, 3>() = -Skew<double>(rotation_b * centre);
  block.bottomRightCorner<3, 3>() = second(3, 3) * Matrix3<double>::Identity();
}

// Normal equations of the places Σ w (r × R v̄ + t) that a step (r, t) of all bones adds.
void TransformStep::Workspace::Linearise(const Eigen::MatrixXd& second) {
  pull = cross;
  pull.noalias() -= second * (now - start);
  normal.setZero();
  for (int a = 0; a < bones(); ++a) {
    for (int b = 0; b <= a; ++b) {
      if (second(4 * a + 3, 4 * b + 3) > 0.0) {
        LinearisePair(second.block<4, 4>(4 * a, 4 * b), a, b);
      }
    }
    Vector3<double> turn = Vector3<double>::Zero();
    for (int c = 0; c < 3; ++c) {
      turn += Vector3<double>(now.row(4 * a + c)).cross(Vector3<double>(pull.row(4 * a + c)));
    }
    right.segment<3>(6 * a) = turn;
    right.segment<3>(6 * a + 3) = pull.row(4 * a + 3).transpose();
    if (!(second(4 * a + 3, 4 * a + 3) > 0.0)) normal.diagonal().segment<6>(6 * a).setOnes();
  }
}

// trial = `now` moved by `step`: (I + r̂) R as a proper rotation, and T + t.
void TransformStep::Workspace::MoveTrial() {
  for (int b = 0; b < bones(); ++b) {
    const Matrix3<double> turn = ExpSo3<double>(step.segment<3>(6 * b));
    trial.block<3, 3>(4 * b, 0).noalias() = now.block<3, 3>(4 * b, 0) * turn.transpose();
    trial.row(4 * b + 3) = now.row(4 * b + 3) + step.segment<3>(6 * b + 3).transpose();
  }
}

double TransformStep::Workspace::SolveLinearised(const Eigen::MatrixXd& second, int steps) {
  double gain = 0.0, damping = kLeastDamping;
  PoseBlock moved(now.rows(), 3);
  for (int step_number = 0; step_number < steps; ++step_number) {
    Linearise(second);
    bool improved = false;
    for (int rejection = 0; rejection < kMostRejections && !improved; ++rejection) {
      damped = normal;
      damped.diagonal() *= 1.0 + damping;
      cholesky.compute(damped);
      step = right;
      cholesky.solveInPlace(step);
      MoveTrial();
      moved = trial;
      const double trial_gain = Gain(moved, second);
      improved = trial_gain > gain;  // false if not finite
      if (improved) {
        gain = trial_gain;
        now = moved;
      } else {
        damping = std::max(damping * kDampingFactor, kFirstRaisedDamping);
      }
    }
    if (!improved) break;
    damping = std::max(damping / kDampingFactor, kLeastDamping);
  }
  return gain;
}

TransformStep::TransformStep(int bones, int poses, const Settings& settings)
    : solver_(settings.transforms),
      most_steps_(settings.transform_steps),
      threads_(settings.threads),
      workspaces_(std::min(kChunks, poses), Workspace(bones)),
      gains_(poses) {}

TransformStep::~TransformStep() = default;

double TransformStep::Solve(const SkinMoments& moments, BoneStack& stack) {
  const int chunks = static_cast<int>(workspaces_.size()), poses = PoseCount(stack);
  ParallelFor(chunks, threads_, [&](int begin, int end) {
    for (int chunk = begin; chunk < end; ++chunk) {
      Workspace& work = workspaces_[chunk];
      for (int p = poses * chunk / chunks; p < poses * (chunk + 1) / chunks; ++p) {
        work.start = work.now = stack.middleCols<3>(3 * p);
        work.cross = moments.cross.middleCols<3>(3 * p);
        gains_[p] = solver_ == TransformSolver::kClosedForm
                        ? work.SolveClosedForm(moments.second, most_steps_)
                        : work.SolveLinearised(moments.second, most_steps_);
        if (gains_[p] > 0.0) stack.middleCols<3>(3 * p) = work.now;
      }
    }
  });
  double energy = moments.energy;
  for (const double gain : gains_) energy -= std::max(gain, 0.0);
  return energy;
}

void MakeRigid(BoneStack& stack, int threads) {
  ParallelFor(PoseCount(stack), threads, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      for (int b = 0; b < BoneCount(stack); ++b) {
        const Matrix3<double> rotation = stack.block<3, 3>(4 * b, 3 * p);
        stack.block<3, 3>(4 * b, 3 * p) = NearestRotation<double>(rotation);
      }
    }
  });
}

}  // namespace vitruvia::skinning
