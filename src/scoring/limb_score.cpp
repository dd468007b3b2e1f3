#include "scoring/limb_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "body/limbs.h"
#include "geometry/zbuffer.h"
#include "metrics/limb_recovery.h"
#include "metrics/vertex_error.h"
#include "scoring/joint_score.h"
#include "scoring/score.h"

namespace vitruvia {
namespace {

constexpr double kVisibleShare = 0.2;  // of the lower half's vertices; a camera sees at most half
constexpr int kAllowedFrames = 10;

using LimbFlags = std::array<bool, kLimbCount>;

// Of a limb in one frame. Unknown: the truth of one of its joints is, and the other one is in
// place.
enum class LimbOutcome { kUnknown, kTracked, kLost };
using LimbOutcomes = std::array<LimbOutcome, kLimbCount>;

// Columns of JointErrorsOfFrames that hold the joints of the limb's lower half: the proximal ends
// of its two bones.
std::vector<std::size_t> JointsOf(const Limb& limb, const std::vector<std::string>& names) {
  std::vector<std::size_t> columns;
  for (const BoneId bone : {limb.lower, limb.end}) {
    const auto found = std::find(names.begin(), names.end(), Bones()[static_cast<int>(bone)].joint);
    if (found != names.end()) columns.push_back(std::distance(names.begin(), found));
  }
  return columns;
}

LimbOutcome OutcomeOf(const std::vector<double>& errors_m, const std::vector<std::size_t>& joints) {
  const auto is_off = [&](std::size_t joint) { return errors_m[joint] > kJointThreshold_m; };
  const auto is_known = [&](std::size_t joint) { return !std::isnan(errors_m[joint]); };
  if (std::any_of(joints.begin(), joints.end(), is_off)) return LimbOutcome::kLost;
  const bool is_whole = joints.size() == 2 && std::all_of(joints.begin(), joints.end(), is_known);
  return is_whole ? LimbOutcome::kTracked : LimbOutcome::kUnknown;
}

std::vector<LimbOutcomes> OutcomesOf(const JointErrorsOfFrames& joints) {
  std::vector<LimbOutcomes> outcomes(joints.errors_m.size());
  for (int k = 0; k < kLimbCount; ++k) {
    const std::vector<std::size_t> columns = JointsOf(Limbs()[k], joints.joints);
    for (std::size_t frame = 0; frame < outcomes.size(); ++frame)
      outcomes[frame][k] = OutcomeOf(joints.errors_m[frame], columns);
  }
  return outcomes;
}

bool Holds(const LimbOutcomes& frame, LimbOutcome outcome) {
  return std::find(frame.begin(), frame.end(), outcome) != frame.end();
}

// Which limbs the camera sees in a frame of a sequence.
class LimbView {
 public:
  explicit LimbView(const SequenceReader& sequence)
      : sequence_(sequence),
        correspondence_(sequence.subject().rest, sequence.true_rest_mesh()),
        zbuffer_(sequence.info().camera) {
    const auto& bones = sequence.subject().weights.bones;
    for (int k = 0; k < kLimbCount; ++k) {
      for (std::size_t i = 0; i < bones.size(); ++i) {
        const auto bone = static_cast<BoneId>(bones[i][0]);
        if (bone == Limbs()[k].lower || bone == Limbs()[k].end) vertices_[k].push_back(i);
      }
    }
  }

  LimbFlags VisibleIn(int frame) {
    const std::vector<Vector3f> surface = sequence_.ReadTrueVertices(frame);
    const DepthImage& rendered = zbuffer_.Render(surface, sequence_.true_rest_mesh().triangles);
    const std::vector<bool> seen = VisiblePoints(correspondence_.TruePositions(surface), rendered,
                                                 sequence_.info().camera, kVisibleWithin_m);
    LimbFlags visible{};
    for (int k = 0; k < kLimbCount; ++k) {
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
  std::array<std::vector<std::size_t>, kLimbCount> vertices_;
};

using LimbStates = std::array<std::vector<LimbState>, kLimbCount>;

// Frames in which a limb's outcome is unknown are left out. Visibility is found only for frames
// with a lost limb; it does not count elsewhere.
LimbStates StatesOf(const SequenceReader& sequence, const std::vector<LimbOutcomes>& outcomes) {
  LimbStates states;
  std::optional<LimbView> view;
  for (std::size_t frame = 0; frame < outcomes.size(); ++frame) {
    LimbFlags visible{};
    if (Holds(outcomes[frame], LimbOutcome::kLost)) {
      if (!view) view.emplace(sequence);
      visible = view->VisibleIn(static_cast<int>(frame));
    }
    for (int k = 0; k < kLimbCount; ++k) {
      if (outcomes[frame][k] == LimbOutcome::kUnknown) continue;
      states[k].push_back({outcomes[frame][k] == LimbOutcome::kLost, visible[k]});
    }
  }
  return states;
}

}  // namespace

void ScoreLimbs(const SequenceReader& sequence, const EstimateReader& estimate, RunRecord& record) {
  const SequenceInfo& info = sequence.info();
  if (!info.surface || !info.subject || info.joints.empty()) return;
  const LimbStates states = StatesOf(sequence, OutcomesOf(FindJointErrors(sequence, estimate)));
  const auto is_measured = [](const std::vector<LimbState>& limb) { return !limb.empty(); };
  if (!std::all_of(states.begin(), states.end(), is_measured)) return;
  LimbRecoveries sum;
  for (const std::vector<LimbState>& limb : states) {
    const LimbRecoveries of_limb = CountRecoveries(limb, kAllowedFrames);
    sum.losses += of_limb.losses;
    sum.in_time += of_limb.in_time;
  }
  record.summary["limb_losses"] = sum.losses;
  if (sum.losses > 0)
    record.summary["limbs_found_within_10_frames"] = static_cast<double>(sum.in_time) / sum.losses;
}

}  // namespace vitruvia
