#include "scoring/bound_score.h"

#include <array>
#include <cmath>

#include "body/skeleton.h"
#include "bound/sequence_bound.h"
#include "core/absent.h"
#include "core/progress.h"

namespace vitruvia {
namespace {

// Sums of squares over frames in which a joint, or any joint, is visible.
struct SquareSums {
  double bound_m2 = 0.0, error_m2 = 0.0;
  int count = 0;

  void Add(double bound_m, double error_m) {
    bound_m2 += bound_m * bound_m;
    error_m2 += error_m * error_m;
    ++count;
  }
  double bound_m() const { return std::sqrt(bound_m2 / count); }
  double error_m() const { return std::sqrt(error_m2 / count); }
};

using SumsOfJoints = std::array<SquareSums, kBoneCount>;

void AddFrame(const JointTruth& truth, const std::vector<std::string>& joints,
              const FrameEstimate& estimate, const FrameBound& bound, SumsOfJoints& sums,
              SquareSums& of_frame) {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const int bone = FindJoint(joints[j]);
    if (bone < 0 || !truth.visible[j]) continue;
    const double error_m = (estimate.joints[bone] - truth.positions[j]).norm();
    sums[bone].Add(bound.joint_m[bone], error_m);
    of_frame.Add(bound.joint_m[bone], error_m);
  }
}

// One number each of a joint, named by the joint.
void RecordJoints(const SumsOfJoints& sums, RunRecord& record) {
  for (int bone = 0; bone < kBoneCount; ++bone) {
    if (sums[bone].count == 0) continue;
    const std::string joint(Bones()[bone].joint);
    record.joint_bound_m[joint] = sums[bone].bound_m();
    record.joint_error_rms_m[joint] = sums[bone].error_m();
  }
}

void SummarizeBound(const SumsOfJoints& sums, nlohmann::json& row) {
  SquareSums all;
  for (const SquareSums& of_joint : sums) {
    all.bound_m2 += of_joint.bound_m2;
    all.error_m2 += of_joint.error_m2;
    all.count += of_joint.count;
  }
  if (all.count == 0) return;
  row["joint_bound_rms_visible_m"] = all.bound_m();
  row["joint_error_rms_visible_m"] = all.error_m();
  if (all.error_m2 > 0.0) row["joint_efficiency"] = all.bound_m() / all.error_m();
}

}  // namespace

void BoundSettings::Describe(Fields& f) {
  f.Integer("every", every,
            {.meaning = "interval in frames at which the single-frame Cramér–Rao bound of the "
                        "joints is computed; 0: never",
             .unit = "frames",
             .min = 0,
             .max = 1e6,
             .origin = Origin::kInput});
  f.Section("prior", prior, {.meaning = "prior knowledge of the pose before the frame"});
}

void ScoreBound(const SequenceReader& sequence, const EstimateReader& estimate,
                const BoundSettings& settings, RunRecord& record) {
  if (settings.every == 0) return;
  const SequenceBound bounds(sequence, settings.prior);
  const SequenceInfo& info = sequence.info();
  const std::size_t frames = static_cast<std::size_t>(info.frames);
  std::vector<double> bound_m(frames, kAbsent), error_m(frames, kAbsent);
  SumsOfJoints sums{};
  Progress progress("bound", (info.frames + settings.every - 1) / settings.every);
  for (int frame = 0; frame < info.frames; frame += settings.every) {
    const std::optional<FrameBound> bound = bounds.At(frame);
    progress.Advance();
    if (!bound) continue;
    SquareSums of_frame;
    AddFrame(sequence.true_joints(frame), info.joints, estimate.frames()[frame], *bound, sums,
             of_frame);
    if (of_frame.count == 0) continue;
    bound_m[frame] = of_frame.bound_m();
    error_m[frame] = of_frame.error_m();
  }
  record.frames["joint_bound_rms_visible_m"] = std::move(bound_m);
  record.frames["joint_error_rms_visible_m"] = std::move(error_m);
  RecordJoints(sums, record);
  SummarizeBound(sums, record.summary);
}

}  // namespace vitruvia
