#include "learning/skinning/decomposition.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/timer.h"
#include "core/worker_team.h"
#include "learning/skinning/joint_step.h"
#include "learning/skinning/packed_examples.h"
#include "learning/skinning/transform_step.h"
#include "learning/skinning/weight_step.h"
#include "math/rigid.h"

namespace vitruvia::skinning {
namespace {

constexpr int kManyTransformSteps = 50;  // they end by themselves when nothing is gained
constexpr int kRigidRounds = 2;  // floats of a body's size, then of the first round's errors

// Of joint steps, relative to the diagonal: less after each that lowered the energy, more after
// each that did not.
constexpr double kFirstDamping = 1e-2, kLeastDamping = 1e-6, kMostDamping = 1e3;
constexpr double kDampingFall = 4.0, kDampingRise = 10.0;

std::vector<std::uint8_t> LabelsOfRows(const PackedExamples& packed, const Labels& labels) {
  std::vector<std::uint8_t> of_rows(labels.size());
  for (int row = 0; row < packed.vertex_count(); ++row) {
    of_rows[row] = labels[packed.VertexOfRow(row)];
  }
  return of_rows;
}

RowWeights RigidWeights(const std::vector<std::uint8_t>& label_of_row) {
  RowWeights weights;
  weights.bones.resize(label_of_row.size());
  weights.weights.assign(label_of_row.size(), {1.0f, 0.0f, 0.0f, 0.0f});
  for (std::size_t row = 0; row < label_of_row.size(); ++row) {
    weights.bones[row] = {label_of_row[row], 0, 0, 0};
  }
  return weights;
}

BoneStack Standing(int bones, int poses) {
  BoneStack stack = BoneStack::Zero(4 * bones, 3 * poses);
  for (int p = 0; p < poses; ++p) {
    for (int b = 0; b < bones; ++b) stack.block<3, 3>(4 * b, 3 * p).setIdentity();
  }
  return stack;
}

class Alternator {
 public:
  Alternator(const Examples& examples, const Labels& labels, const BoneGraph& candidates,
             const Settings& settings)
      : settings_(settings),
        bones_(static_cast<int>(candidates.size())),
        team_(settings.threads),
        packed_(examples, labels),
        label_of_row_(LabelsOfRows(packed_, labels)),
        weights_(RigidWeights(label_of_row_)),
        weight_step_(packed_, label_of_row_, candidates, settings.influences, team_),
        transform_step_(bones_, packed_.pose_count(), settings.transforms, settings.transform_steps,
                        team_),
        joint_step_(packed_, bones_, settings.joint_iterations, team_),
        pattern_(bones_),
        moments_(bones_, packed_.pose_count()),
        stack_(Standing(bones_, packed_.pose_count())) {}

  // Rigid pieces: in closed form, since they may have turned by any angle.
  double FitRigidPieces() {
    TransformStep closed_form(bones_, packed_.pose_count(), TransformSolver::kClosedForm, 1, team_);
    for (int round = 0; round < kRigidRounds; ++round) {
      weight_step_.Gather(stack_, weights_, moments_);
      energy_ = closed_form.Solve(pattern_, moments_, stack_);
    }
    next_ = stack_;
    return Rmse(energy_);
  }

  // Solves for weights at the joint step's transforms, or at the last ones if that raises the
  // energy; then for transforms at these weights, and for the next joint step. False, with
  // everything unchanged, if neither lowers the energy.
  bool Alternate(Alternation& done) {
    const Stopwatch watch;
    kept_weights_ = weights_;
    done.jointly = has_joint_step_ && TakeWeightsAt(next_);
    if (has_joint_step_) {
      damping_ = done.jointly ? std::max(damping_ / kDampingFall, kLeastDamping)
                              : std::min(damping_ * kDampingRise, kMostDamping);
    }
    if (!done.jointly && !TakeWeightsAt(stack_)) return false;
    pattern_.Analyse(moments_.second);
    has_joint_step_ = settings_.joint_iterations > 0;
    if (has_joint_step_) {
      joint_step_.Solve(pattern_, moments_, weights_, stack_, damping_, next_);
    }
    energy_ = transform_step_.Solve(pattern_, moments_, stack_);
    done.rmse_m = Rmse(energy_);
    done.time_ms = watch.ElapsedMs();
    return true;
  }

  // Optimal transforms for these weights.
  void FitTransformsTo(const SkinWeights& weights) {
    for (int row = 0; row < packed_.vertex_count(); ++row) {
      weights_.bones[row] = weights.bones[packed_.VertexOfRow(row)];
      weights_.weights[row] = weights.weights[packed_.VertexOfRow(row)];
    }
    weight_step_.Gather(stack_, weights_, moments_);
    pattern_.Analyse(moments_.second);
    TransformStep(bones_, packed_.pose_count(), TransformSolver::kLinearised, kManyTransformSteps,
                  team_)
        .Solve(pattern_, moments_, stack_);
  }

  double MeasuredRmse() {
    weight_step_.Gather(stack_, weights_, moments_);
    return Rmse(moments_.energy);
  }

  SkinWeights Weights() const {
    SkinWeights weights = weights_;
    for (int row = 0; row < packed_.vertex_count(); ++row) {
      weights.bones[packed_.VertexOfRow(row)] = weights_.bones[row];
      weights.weights[packed_.VertexOfRow(row)] = weights_.weights[row];
    }
    return weights;
  }

  std::vector<BoneTransforms> Poses() const {
    std::vector<BoneTransforms> poses(packed_.pose_count(), BoneTransforms(bones_));
    for (int p = 0; p < packed_.pose_count(); ++p) {
      for (int b = 0; b < bones_; ++b) {
        const Matrix3<double> rotation = stack_.block<3, 3>(4 * b, 3 * p).transpose();
        const Vector3<double> translation = stack_.block<1, 3>(4 * b + 3, 3 * p).transpose();
        poses[p][b] = {rotation,
                       translation + packed_.PoseCentroid(p) - rotation * packed_.rest_centroid()};
      }
    }
    return poses;
  }

 private:
  double Rmse(double energy) const {
    const double places = static_cast<double>(packed_.vertex_count()) * packed_.pose_count();
    return std::sqrt(std::max(energy, 0.0) / places);
  }

  // The best weights at these transforms; false, and nothing is changed, if the energy is not lower
  // than it was.
  bool TakeWeightsAt(const BoneStack& stack) {
    weight_step_.Solve(stack, weights_, moments_);
    if (moments_.energy > energy_) {
      weights_ = kept_weights_;
      return false;
    }
    stack_ = stack;
    return true;
  }

  const Settings settings_;
  int bones_;
  WorkerTeam team_;
  PackedExamples packed_;
  std::vector<std::uint8_t> label_of_row_;
  RowWeights weights_, kept_weights_;
  WeightStep weight_step_;
  TransformStep transform_step_;
  JointStep joint_step_;
  BonePattern pattern_;
  SkinMoments moments_;
  BoneStack stack_;  // belongs to weights_ and energy_
  BoneStack next_;   // after the joint step
  bool has_joint_step_ = false;
  double damping_ = kFirstDamping;
  double energy_ = 0.0;
};

}  // namespace

const char* Name(Ending ending) {
  return ending == Ending::kConverged ? "converged" : "alternation limit";
}

Decomposition Decompose(const Examples& examples, const Labels& labels, const BoneGraph& candidates,
                        const Settings& settings) {
  const std::string problem = ExamplesProblem(examples);
  Require(problem.empty(), "Decompose: {}", problem);
  const std::string label_problem =
      LabelsProblem(labels, examples.rest.size(), static_cast<int>(candidates.size()));
  Require(label_problem.empty(), "Decompose: {}", label_problem);
  const std::string candidate_problem = CandidatesProblem(candidates);
  Require(candidate_problem.empty(), "Decompose: {}", candidate_problem);
  Alternator alternator(examples, labels, candidates, settings);
  Decomposition result;
  result.rmse_m = result.start_rmse_m = alternator.FitRigidPieces();
  for (int i = 0; i < settings.alternations; ++i) {
    Alternation done;
    if (!alternator.Alternate(done)) {
      result.ending = Ending::kConverged;
      break;
    }
    result.alternations.push_back(done);
    const double gain = result.rmse_m - done.rmse_m;
    result.rmse_m = done.rmse_m;
    if (gain <= settings.least_gain * done.rmse_m) {
      result.ending = Ending::kConverged;
      break;
    }
  }
  result.rmse_m = alternator.MeasuredRmse();
  result.weights = alternator.Weights();
  result.poses = alternator.Poses();
  return result;
}

FittedTransforms FitTransforms(const Examples& examples, const SkinWeights& weights, int bone_count,
                               int threads) {
  const std::string problem = ExamplesProblem(examples);
  Require(problem.empty(), "FitTransforms: {}", problem);
  const std::string weights_problem = WeightsProblem(weights, examples.rest.size(), bone_count);
  Require(weights_problem.empty(), "FitTransforms: {}", weights_problem);
  BoneGraph own(bone_count);
  for (int b = 0; b < bone_count; ++b) own[b] = {static_cast<std::uint8_t>(b)};
  Settings settings;
  settings.threads = threads;
  settings.joint_iterations = 0;
  Alternator alternator(examples, HeaviestBones(weights), own, settings);
  alternator.FitRigidPieces();
  alternator.FitTransformsTo(weights);
  const double rmse_m = alternator.MeasuredRmse();
  return {alternator.Poses(), rmse_m};
}

}  // namespace vitruvia::skinning
