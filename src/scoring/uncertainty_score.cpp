#include "scoring/uncertainty_score.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

#include "body/skeleton.h"
#include "core/absent.h"
#include "math/statistics.h"

namespace vitruvia {
namespace {

// Quantiles of the chi-squared distribution of three degrees of freedom at 0.68 and 0.95.
constexpr double kSquareAt68 = 3.5059, kSquareAt95 = 7.8147;

struct JointOfFrame {
  double error_m;
  double square;          // eᵀ C⁻¹ e; absent without a covariance
  double log_likelihood;  // negative, nats; absent without a covariance
  bool is_flagged;
};

JointOfFrame Judge(const FrameEstimate& frame, int bone, const Vector3d& truth) {
  const Vector3d error = frame.joints[bone] - truth;
  const std::string name(Bones()[bone].joint);
  const bool is_flagged = std::find(frame.unreliable_joints.begin(), frame.unreliable_joints.end(),
                                    name) != frame.unreliable_joints.end();
  JointOfFrame judged{error.norm(), kAbsent, kAbsent, is_flagged};
  if (!frame.has_covariances()) return judged;
  const Eigen::LLT<Matrix3<double>> cholesky(frame.covariance_m2(bone));
  if (cholesky.info() != Eigen::Success) return judged;
  const Matrix3<double> factor = cholesky.matrixL();
  judged.square = error.dot(cholesky.solve(error));
  judged.log_likelihood = 0.5 * judged.square + factor.diagonal().array().log().sum() +
                          1.5 * std::log(2.0 * std::numbers::pi);
  return judged;
}

// Visible joints, in all frames.
std::vector<JointOfFrame> JudgeAll(const SequenceReader& sequence, const EstimateReader& estimate) {
  std::vector<JointOfFrame> judged;
  const std::vector<std::string>& joints = sequence.info().joints;
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    const JointTruth& truth = sequence.true_joints(frame);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const int bone = FindJoint(joints[j]);
      if (bone >= 0 && truth.visible[j])
        judged.push_back(Judge(estimate.frames()[frame], bone, truth.positions[j]));
    }
  }
  return judged;
}

template <class Belongs>
double ShareOf(const std::vector<JointOfFrame>& joints, Belongs belongs) {
  const auto count = std::count_if(joints.begin(), joints.end(), belongs);
  return static_cast<double>(count) / static_cast<double>(joints.size());
}

void SummarizeCoverage(const std::vector<JointOfFrame>& joints, nlohmann::json& row) {
  std::vector<JointOfFrame> known;
  std::copy_if(joints.begin(), joints.end(), std::back_inserter(known),
               [](const JointOfFrame& joint) { return !std::isnan(joint.square); });
  row["covariances_given"] = static_cast<double>(known.size()) / static_cast<double>(joints.size());
  if (known.empty()) return;
  row["coverage_68"] =
      ShareOf(known, [](const JointOfFrame& joint) { return joint.square <= kSquareAt68; });
  row["coverage_95"] =
      ShareOf(known, [](const JointOfFrame& joint) { return joint.square <= kSquareAt95; });
  std::vector<double> likelihoods;
  for (const JointOfFrame& joint : known) likelihoods.push_back(joint.log_likelihood);
  row["negative_log_likelihood"] = Mean(likelihoods);
}

void SummarizeFlags(const std::vector<JointOfFrame>& joints, nlohmann::json& row) {
  std::vector<JointOfFrame> off, on;
  for (const JointOfFrame& joint : joints)
    (joint.error_m > kReliableWithin_m ? off : on).push_back(joint);
  const auto is_flagged = [](const JointOfFrame& joint) { return joint.is_flagged; };
  if (!off.empty()) row["unreliable_told"] = ShareOf(off, is_flagged);
  if (!on.empty()) row["unreliable_false_alarms"] = ShareOf(on, is_flagged);
}

}  // namespace

void ScoreUncertainty(const SequenceReader& sequence, const EstimateReader& estimate,
                      RunRecord& record) {
  const auto& frames = estimate.frames();
  const bool has_any = std::any_of(frames.begin(), frames.end(), [](const FrameEstimate& frame) {
    return frame.has_covariances();
  });
  if (!has_any) return;
  const std::vector<JointOfFrame> joints = JudgeAll(sequence, estimate);
  if (joints.empty()) return;
  SummarizeCoverage(joints, record.summary);
  SummarizeFlags(joints, record.summary);
}

}  // namespace vitruvia
