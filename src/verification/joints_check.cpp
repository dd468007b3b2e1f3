#include <algorithm>
#include <cmath>
#include <optional>

#include "math/statistics.h"
#include "verification/checks.h"
#include "verification/likely_cause.h"
#include "verification/limits.h"

namespace vitruvia {
namespace {
using namespace verification_limits;

constexpr std::size_t kFewestBones = 4;  // that say something of the unit

// Where a joint of the skeleton stands in the sequence's list; -1: it is not there.
std::vector<int> PlacesOfJoints(const std::vector<std::string>& names) {
  std::vector<int> places;
  for (const BoneInfo& bone : Bones()) {
    const auto at = std::find(names.begin(), names.end(), bone.joint);
    places.push_back(at == names.end() ? -1 : static_cast<int>(at - names.begin()));
  }
  return places;
}

// A bone between two joints of the skeleton, with its length in every frame that knows both.
struct BoneLengths {
  int bone = 0;  // the joint at the far end; its parent is at the near one
  std::vector<double> lengths_m;
  double Median() const { return Quantile(lengths_m, 0.5); }
};

std::optional<Vector3d> Place(const SequenceReader& sequence, int frame, int joint) {
  if (joint < 0) return std::nullopt;
  const JointTruth& truth = sequence.true_joints(frame);
  const auto j = static_cast<std::size_t>(joint);
  if (!truth.Knows(j)) return std::nullopt;
  return truth.positions[j];
}

std::vector<BoneLengths> MeasureBones(const SequenceReader& sequence,
                                      const std::vector<int>& places) {
  std::vector<BoneLengths> bones;
  for (int b = 0; b < kBoneCount; ++b) {
    const int parent = Bones()[static_cast<std::size_t>(b)].parent;
    if (parent < 0) continue;
    BoneLengths bone{b, {}};
    for (int i = 0; i < sequence.info().frames; ++i) {
      const auto far = Place(sequence, i, places[static_cast<std::size_t>(b)]);
      const auto near = Place(sequence, i, places[static_cast<std::size_t>(parent)]);
      if (far && near) bone.lengths_m.push_back((*far - *near).norm());
    }
    if (!bone.lengths_m.empty()) bones.push_back(std::move(bone));
  }
  return bones;
}

std::string BoneName(int bone) {
  const auto& info = Bones()[static_cast<std::size_t>(bone)];
  return fmt::format("{} to {}", Bones()[static_cast<std::size_t>(info.parent)].joint, info.joint);
}

double LengthInSubject(const Skeleton& skeleton, int bone) {
  const auto b = static_cast<std::size_t>(bone);
  return (skeleton.joints[b] - skeleton.joints[static_cast<std::size_t>(Bones()[b].parent)]).norm();
}

std::optional<Finding> LengthProblem(const SequenceReader& sequence,
                                     const std::vector<BoneLengths>& bones) {
  if (!sequence.info().subject || bones.size() < kFewestBones) return std::nullopt;
  const Skeleton& skeleton = sequence.subject().skeleton;
  std::vector<double> ratios;
  for (const BoneLengths& bone : bones)
    ratios.push_back(bone.Median() / std::max(1e-6, LengthInSubject(skeleton, bone.bone)));
  const double ratio = Quantile(ratios, 0.5);
  const double off = std::max(ratio, 1.0 / ratio);
  if (off <= kBoneWarningFactor) return std::nullopt;
  const std::string text = fmt::format(
      "truth/joints.json: the bones are {} for the subject: in the median of {} bones {:.4g} of "
      "the subject's length (\"{}\" {:.4g} m, the subject's {:.4g} m){}",
      TimesTooLarge(ratio), bones.size(), ratio, BoneName(bones.front().bone),
      bones.front().Median(), LengthInSubject(skeleton, bones.front().bone),
      off > kBoneErrorFactor ? LengthUnitCause(ratio) : "; another person's subject?");
  return Finding{off > kBoneErrorFactor ? Severity::kError : Severity::kWarning, text};
}

std::optional<Finding> VariationProblem(const std::vector<BoneLengths>& bones) {
  const BoneLengths* worst = nullptr;
  double most = kBoneVariation;
  for (const BoneLengths& bone : bones) {
    const double variation =
        (Quantile(bone.lengths_m, 0.95) - Quantile(bone.lengths_m, 0.05)) / bone.Median();
    if (!(variation > most)) continue;
    most = variation;
    worst = &bone;
  }
  if (worst == nullptr) return std::nullopt;
  return Warning(
      "truth/joints.json: the length of \"{}\" changes from {:.3f} to {:.3f} m over the frames "
      "(5th and 95th percentile); are joints swapped or badly marked in some?",
      BoneName(worst->bone), Quantile(worst->lengths_m, 0.05), Quantile(worst->lengths_m, 0.95));
}

// The mean way of all joints that are known in both frames; NaN if none is.
double MeanStep(const JointTruth& from, const JointTruth& to) {
  double sum_m = 0.0;
  int count = 0;
  for (std::size_t j = 0; j < from.positions.size(); ++j) {
    if (!from.Knows(j) || !to.Knows(j)) continue;
    sum_m += (to.positions[j] - from.positions[j]).norm();
    ++count;
  }
  return sum_m / count;
}

std::optional<Finding> MotionProblem(const SequenceReader& sequence) {
  const SequenceInfo& info = sequence.info();
  std::vector<double> steps;
  for (int i = 0; i + 1 < info.frames; ++i)
    steps.push_back(MeanStep(sequence.true_joints(i), sequence.true_joints(i + 1)));
  int jumps = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double before = i > 0 ? steps[i - 1] : 0.0;
    const double after = i + 1 < steps.size() ? steps[i + 1] : 0.0;
    const bool has_neighbours = i > 0 && i + 1 < steps.size();
    const bool is_jump = has_neighbours && steps[i] > kJump_m &&
                         steps[i] > kJumpOfNeighbours * std::max(before, after);
    if (!is_jump && !(steps[i] * info.fps > kFastestBody_m_s)) continue;
    if (jumps == 0) first = i;
    ++jumps;
  }
  if (jumps == 0) return std::nullopt;
  return Warning(
      "truth/joints.json: the body jumps between frames, {} of {} times, first from frame {} to {} "
      "by {:.2f} m in the mean of its joints ({:.1f} m/s at {:g} frames/s); are frames out of "
      "order or missing, or is fps wrong?",
      jumps, steps.size(), first, first + 1, steps[first], steps[first] * info.fps, info.fps);
}

// The first frame must show a person who stands upright and faces the camera.
void CheckFirstFrame(const SequenceReader& sequence, const std::vector<int>& places,
                     Findings& findings) {
  const auto at = [&](BoneId bone) {
    return Place(sequence, 0, places[static_cast<std::size_t>(bone)]);
  };
  const auto head = at(BoneId::kHead), pelvis = at(BoneId::kPelvis);
  const auto left = at(BoneId::kLeftUpperArm), right = at(BoneId::kRightUpperArm);
  if (head && pelvis) {
    const double upright = (*pelvis - *head).normalized().y();
    if (upright < kUprightCosine)
      findings.push_back(Warning(
          "truth/joints.json: frame 0: the person is {:.0f} degrees from upright (pelvis to head "
          "({:.2f}, {:.2f}, {:.2f}) m, y down), where a tracker starts from a standing one; {}",
          std::acos(std::clamp(upright, -1.0, 1.0)) * 180.0 / EIGEN_PI, head->x() - pelvis->x(),
          head->y() - pelvis->y(), head->z() - pelvis->z(),
          upright < -kUprightCosine ? "is y up instead of down?" : "are axes swapped?"));
  }
  if (left && right && left->x() - right->x() < -kSidewaysShoulders_m)
    findings.push_back(
        Warning("truth/joints.json: frame 0: the left shoulder is {:.2f} m to the image's left of "
                "the right one, so the person turns the back to the camera; are left and right "
                "swapped or the images mirrored?",
                right->x() - left->x()));
}

}  // namespace

Findings CheckTrueJoints(const SequenceReader& sequence) {
  if (sequence.info().joints.empty()) return {};
  const std::vector<int> places = PlacesOfJoints(sequence.info().joints);
  const std::vector<BoneLengths> bones = MeasureBones(sequence, places);
  Findings findings;
  const auto add = [&](std::optional<Finding> finding) {
    if (finding) findings.push_back(std::move(*finding));
  };
  add(LengthProblem(sequence, bones));
  add(VariationProblem(bones));
  add(MotionProblem(sequence));
  CheckFirstFrame(sequence, places, findings);
  return findings;
}

}  // namespace vitruvia
