#include "scoring/limb_score.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "body/skeleton.h"
#include "geometry/zbuffer.h"
#include "metrics/limb_recovery.h"
#include "metrics/vertex_error.h"
#include "scoring/joint_score.h"
#include "scoring/score.h"

namespace vitruvia {
namespace {

constexpr double kVisibleShare =
    0.2;  // of a limb's vertices; half of a convex part face the camera
constexpr int kAllowedFrames = 10;

// The lower half of a limb; its joints are the proximal ends of its two bones.
struct Limb {
  BoneId lower, end;
};
constexpr std::array<Limb, 4> kLimbs{{{BoneId::kLeftForearm, BoneId::kLeftHand},
                                      {BoneId::kRightForearm, BoneId::kRightHand},
                                      {BoneId::kLeftShin, BoneId::kLeftFoot},
                                      {BoneId::kRightShin, BoneId::kRightFoot}}};

using LimbFlags = std::array<bool, kLimbs.size()>;

// Columns of JointErrorsOfFrames that hold the limb's joints.
std::vector<std::size_t> JointsOf(const Limb& limb, const std::vector<std::string>& names) {
  std::vector<std::size_t> columns;
  for (const BoneId bone : {limb.lower, limb.end}) {
    const auto found = std::find(names.begin(), names.end(), Bones()[static_cast<int>(bone)].joint);
    if (found != names.end()) columns.push_back(std::distance(names.begin(), found));
  }
  return columns;
}

std::vector<LimbFlags> LostLimbs(const JointErrorsOfFrames& joints) {
  std::vector<LimbFlags> lost(joints.errors_m.size(), LimbFlags{});
  for (std::size_t k = 0; k < kLimbs.size(); ++k) {
    for (const std::size_t joint : JointsOf(kLimbs[k], joints.joints)) {
      for (std::size_t frame = 0; frame < lost.size(); ++frame)
        lost[frame][k] |= joints.errors_m[frame][joint] > kJointThreshold_m;
    }
  }
  return lost;
}

// Which limbs the camera sees in a frame of a sequence.
class LimbView {
 public:
  explicit LimbView(const SequenceReader& sequence)
      : sequence_(sequence),
        correspondence_(sequence.subject().rest, sequence.true_rest_mesh()),
        zbuffer_(sequence.info().camera) {
    const auto& bones = sequence.subject().weights.bones;
    for (std::size_t k = 0; k < kLimbs.size(); ++k) {
      for (std::size_t i = 0; i < bones.size(); ++i) {
        const auto bone = static_cast<BoneId>(bones[i][0]);
        if (bone == kLimbs[k].lower || bone == kLimbs[k].end) vertices_[k].push_back(i);
      }
    }
  }

  LimbFlags VisibleIn(int frame) {
    const std::vector<Vector3f> surface = sequence_.ReadTrueVertices(frame);
    const DepthImage& rendered = zbuffer_.Render(surface, sequence_.true_rest_mesh().triangles);
    const std::vector<bool> seen = VisiblePoints(correspondence_.TruePositions(surface), rendered,
                                                 sequence_.info().camera, kVisibleWithin_m);
    LimbFlags visible{};
    for (std::size_t k = 0; k < kLimbs.size(); ++k) {
      const auto count = std::count_if(vertices_[k].begin(), vertices_[k].end(),
                                       [&seen](std::size_t i) { return seen[i]; });
      visible[k] =
          static_cast<double>(count) >= kVisibleShare * static_cast<double>(vertices_[k].size());
    }
    return visible;
  }

 private:
  const SequenceReader& sequence_;
  RestCorrespondence correspondence_;
  ZBuffer zbuffer_;
  std::array<std::vector<std::size_t>, kLimbs.size()> vertices_;
};

using LimbStates = std::array<std::vector<LimbState>, kLimbs.size()>;

bool AnyOf(const LimbFlags& flags) {
  return std::find(flags.begin(), flags.end(), true) != flags.end();
}

// Visibility is found only for frames with a lost limb; it does not count elsewhere.
LimbStates StatesOf(const SequenceReader& sequence, const std::vector<LimbFlags>& lost) {
  LimbStates states;
  if (std::none_of(lost.begin(), lost.end(), AnyOf)) return states;
  LimbView view(sequence);
  for (std::size_t frame = 0; frame < lost.size(); ++frame) {
    const LimbFlags visible =
        AnyOf(lost[frame]) ? view.VisibleIn(static_cast<int>(frame)) : LimbFlags{};
    for (std::size_t k = 0; k < kLimbs.size(); ++k)
      states[k].push_back({lost[frame][k], visible[k]});
  }
  return states;
}

}  // namespace

void ScoreLimbs(const SequenceReader& sequence, const EstimateReader& estimate, RunRecord& record) {
  if (!sequence.info().surface || !sequence.info().subject) return;
  const JointErrorsOfFrames joints = FindJointErrors(sequence, estimate);
  if (joints.joints.empty()) return;
  LimbRecoveries sum;
  for (const std::vector<LimbState>& frames : StatesOf(sequence, LostLimbs(joints))) {
    const LimbRecoveries of_limb = CountRecoveries(frames, kAllowedFrames);
    sum.losses += of_limb.losses;
    sum.in_time += of_limb.in_time;
  }
  record.summary["limb_losses"] = sum.losses;
  if (sum.losses > 0)
    record.summary["limbs_found_within_10_frames"] = static_cast<double>(sum.in_time) / sum.losses;
}

}  // namespace vitruvia
