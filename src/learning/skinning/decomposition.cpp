#include "learning/skinning/decomposition.h"

#include <cmath>

#include "core/error.h"
#include "core/timer.h"
#include "learning/skinning/joint_step.h"
#include "learning/skinning/packed_examples.h"
#include "learning/skinning/transform_step.h"
#include "learning/skinning/weight_step.h"

namespace vitruvia::skinning {
namespace {

constexpr int kRigidRounds = 2;

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
        packed_(examples, labels),
        label_of_row_(LabelsOfRows(packed_, labels)),
        weights_(RigidWeights(label_of_row_)),
        weight_step_(packed_, label_of_row_, candidates, settings.influences, settings.threads),
        transform_step_(bones_, packed_.pose_count(), settings.transforms, settings.transform_steps,
                        settings.threads),
        joint_step_(packed_, bones_, settings.joint_iterations, settings.threads),
        pattern_(bones_),
        moments_(bones_, packed_.pose_count()),
        stack_(Standing(bones_, packed_.pose_count())) {}

  // Rigid pieces: in closed form, since they may have turned by any angle.
  double FitRigidPieces() {
    weight_step_.Gather(stack_, weights_, moments_);
    TransformStep closed_form(bones_, packed_.pose_count(), TransformSolver::kClosedForm, 1,
                              settings_.threads);
    energy_ = closed_form.Solve(pattern_, moments_, stack_);
    next_ = stack_;
    return Rmse(energy_);
  }

  Alternation Alternate() {
    const Stopwatch watch;
    Alternation result;
    kept_weights_ = weights_;
    weight_step_.Solve(next_, weights_, moments_);
    result.extrapolated = joint_ && moments_.energy <= energy_;
    if (joint_ && !result.extrapolated) {
      weights_ = kept_weights_;
      next_ = stack_;
      weight_step_.Solve(next_, weights_, moments_);
      damping_ = std::min(damping_ * 10.0, 1e3);
    } else if (joint_) {
      damping_ = std::max(damping_ / 4.0, 1e-6);
    }
    stack_ = next_;
    pattern_.Analyse(moments_.second);
    joint_ = settings_.joint_iterations > 0;
    if (joint_) joint_step_.Solve(pattern_, moments_, weights_, stack_, damping_, next_);
    energy_ = transform_step_.Solve(pattern_, moments_, stack_);
    if (!joint_) next_ = stack_;
    result.rmse_m = Rmse(energy_);
    result.time_ms = watch.ElapsedMs();
    return result;
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

  const Settings settings_;
  int bones_;
  PackedExamples packed_;
  std::vector<std::uint8_t> label_of_row_;
  RowWeights weights_, kept_weights_;
  WeightStep weight_step_;
  TransformStep transform_step_;
  JointStep joint_step_;
  BonePattern pattern_;
  SkinMoments moments_;
  BoneStack stack_;  // belongs to weights_ and energy_
  BoneStack next_;   // where the next alternation goes out from
  bool joint_ = false;
  double damping_ = 1e-2;
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
    const Alternation done = alternator.Alternate();
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

}  // namespace vitruvia::skinning
