#include "diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "diagnosis/joint_evidence.h"

namespace vitruvia {
namespace {

constexpr double kSmall_m = 0.03;     // errors up to this are not explained
constexpr double kFound_m = 0.08;     // mean over the joints, up to which the body is found
constexpr double kLost_m = 0.20;      // mean over the joints, above which it is lost
constexpr int kFewPixels = 12;        // on a limb
constexpr double kFast_m = 0.08;      // from frame to frame: more than a limb is thick
constexpr double kTouching_m = 0.03;  // between a limb's flesh and another's
constexpr double kNoisy_m = 0.008;    // standard deviation of depth
constexpr double kEventAbove = 0.7;   // an event's frames reach this share of its worst frame

constexpr int Index(BoneId bone) { return static_cast<int>(bone); }

// Of one frame, by bone; 0 where the joint's truth is not known.
using JointErrors17 = std::array<double, kBoneCount>;
using JointCauses = std::array<Cause, kBoneCount>;

JointErrors17 ErrorsOf(const FrameEvidence& evidence, const FrameEstimate& estimate) {
  JointErrors17 errors_m{};
  for (int joint = 0; joint < kBoneCount; ++joint) {
    if (evidence.truth[joint])
      errors_m[joint] = (estimate.joints[joint] - *evidence.truth[joint]).norm();
  }
  return errors_m;
}

double MeanOfKnown(const JointErrors17& errors_m, const FrameEvidence& evidence) {
  double sum_m = 0.0;
  int known = 0;
  for (int joint = 0; joint < kBoneCount; ++joint) {
    if (!evidence.truth[joint]) continue;
    sum_m += errors_m[joint];
    ++known;
  }
  return known == 0 ? 0.0 : sum_m / known;
}

// From right to left through shoulders and hips, as far as they are known.
template <class PositionOf>
Vector3d Leftwards(const FrameEvidence& evidence, const PositionOf& position_of) {
  Vector3d sum = Vector3d::Zero();
  for (const BoneId left : {BoneId::kLeftUpperArm, BoneId::kLeftThigh}) {
    const int l = Index(left), r = Bones()[l].mirror;
    if (evidence.truth[l] && evidence.truth[r]) sum += position_of(l) - position_of(r);
  }
  return sum;
}

bool FacesTheWrongWay(const FrameEvidence& evidence, const FrameEstimate& estimate) {
  const Vector3d truth = Leftwards(evidence, [&](int joint) { return *evidence.truth[joint]; });
  const Vector3d found = Leftwards(evidence, [&](int joint) { return estimate.joints[joint]; });
  return truth.dot(found) < 0.0;
}

struct FrameState {
  double mean_error_m = 0.0;
  bool wrong_way = false, before_found = false, lost = false;
};

std::vector<FrameState> StatesOf(const std::vector<FrameEvidence>& evidence,
                                 const std::vector<FrameEstimate>& estimate,
                                 const std::vector<JointErrors17>& errors_m) {
  std::vector<FrameState> states;
  bool found = false;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    FrameState& state = states.emplace_back();
    state.mean_error_m = MeanOfKnown(errors_m[i], evidence[i]);
    state.wrong_way = FacesTheWrongWay(evidence[i], estimate[i]);
    found = found || state.mean_error_m <= kFound_m;
    state.before_found = !found;
    state.lost = IsFailure(estimate[i].outcome) || state.mean_error_m > kLost_m;
  }
  return states;
}

Cause CauseOf(double error_m, const JointEvidence& joint, const FrameEvidence& frame,
              const FrameState& state) {
  if (error_m <= kSmall_m) return Cause::kSmall;
  if (state.wrong_way) return Cause::kFacing;
  if (state.before_found) return Cause::kStart;
  if (!joint.in_view) return Cause::kOutOfView;
  if (!joint.visible) return Cause::kHidden;
  if (frame.measured_pixels == 0) return Cause::kNoData;
  if (joint.pixels < kFewPixels) return Cause::kFewPairs;
  if (joint.step_m > kFast_m) return Cause::kFast;
  if (joint.noise_m > kNoisy_m) return Cause::kNoise;
  if (joint.gap_m < kTouching_m) return Cause::kLimbOnBody;
  return state.lost ? Cause::kLost : Cause::kUnknown;
}

// An error without a cause of its own that continues from the last frame keeps that frame's cause.
void CarryOn(const JointCauses& before, JointCauses& causes) {
  for (int joint = 0; joint < kBoneCount; ++joint) {
    const bool unexplained = causes[joint] == Cause::kLost || causes[joint] == Cause::kUnknown;
    if (unexplained && before[joint] != Cause::kSmall) causes[joint] = before[joint];
  }
}

std::vector<JointCauses> CausesOf(const std::vector<FrameEvidence>& evidence,
                                  const std::vector<FrameState>& states,
                                  const std::vector<JointErrors17>& errors_m) {
  std::vector<JointCauses> causes(evidence.size());
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    for (int joint = 0; joint < kBoneCount; ++joint) {
      causes[i][joint] =
          CauseOf(errors_m[i][joint], evidence[i].joints[joint], evidence[i], states[i]);
    }
    if (i > 0) CarryOn(causes[i - 1], causes[i]);
  }
  return causes;
}

using CauseSums = std::array<double, kCauseCount>;

void AddErrors(const JointErrors17& errors_m, const JointCauses& causes, CauseSums& sums) {
  for (int joint = 0; joint < kBoneCount; ++joint)
    sums[static_cast<std::size_t>(causes[joint])] += errors_m[joint];
}

// The cause with the largest sum of errors, small errors excepted.
Cause LargestCause(const CauseSums& sums) {
  const auto largest = std::max_element(sums.begin() + 1, sums.end());
  return *largest > 0.0 ? static_cast<Cause>(largest - sums.begin()) : Cause::kSmall;
}

// "left wrist and 2 more joints: up to 0.31 m". Names the joint with the largest error of the
// event's cause.
std::string ReasonOf(const ErrorEvent& event, const std::vector<JointErrors17>& errors_m,
                     const std::vector<JointCauses>& causes) {
  int worst = 0, joints = 0;
  JointErrors17 most_m{};
  for (int frame = event.first; frame <= event.last; ++frame) {
    for (int joint = 0; joint < kBoneCount; ++joint) {
      if (causes[frame][joint] == event.cause)
        most_m[joint] = std::max(most_m[joint], errors_m[frame][joint]);
    }
  }
  for (int joint = 0; joint < kBoneCount; ++joint) {
    if (most_m[joint] > most_m[worst]) worst = joint;
    if (most_m[joint] > 0.0) ++joints;
  }
  std::string name(Bones()[worst].joint);
  std::ranges::replace(name, '_', ' ');
  const std::string more = joints > 1 ? fmt::format(" and {} more", joints - 1) : "";
  return fmt::format("{}{}: up to {:.2f} m", name, more, most_m[worst]);
}

// Intervals round the worst frames, of frames with nearly as large an error.
std::vector<ErrorEvent> FindEvents(const std::vector<JointErrors17>& errors_m,
                                   const std::vector<JointCauses>& causes, double total_m) {
  const auto count = static_cast<int>(errors_m.size());
  std::vector<double> remaining(errors_m.size());
  for (int i = 0; i < count; ++i)
    remaining[i] = std::accumulate(errors_m[i].begin(), errors_m[i].end(), 0.0);
  std::vector<ErrorEvent> events;
  while (events.size() < kMostEvents) {
    const auto worst = static_cast<int>(std::ranges::max_element(remaining) - remaining.begin());
    if (worst == count || remaining[worst] <= 0.0) break;
    const double enough = kEventAbove * remaining[worst];
    ErrorEvent event{worst, worst, worst};
    while (event.first > 0 && remaining[event.first - 1] > enough) --event.first;
    while (event.last + 1 < count && remaining[event.last + 1] > enough) ++event.last;
    CauseSums sums{};
    for (int frame = event.first; frame <= event.last; ++frame) {
      AddErrors(errors_m[frame], causes[frame], sums);
      event.share += remaining[frame] / total_m;
      remaining[frame] = 0.0;
    }
    event.cause = LargestCause(sums);
    event.reason = ReasonOf(event, errors_m, causes);
    events.push_back(std::move(event));
  }
  std::ranges::stable_sort(events, std::greater{}, &ErrorEvent::share);
  return events;
}

std::vector<int> LostFrames(const std::vector<FrameState>& states) {
  std::vector<int> lost;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].lost) lost.push_back(static_cast<int>(i));
  }
  return lost;
}

Diagnosis WithoutTruth(const EstimateReader& estimate) {
  Diagnosis diagnosis;
  for (std::size_t i = 0; i < estimate.frames().size(); ++i) {
    if (IsFailure(estimate.frames()[i].outcome))
      diagnosis.lost_frames.push_back(static_cast<int>(i));
  }
  return diagnosis;
}

}  // namespace

Cause Diagnosis::Main() const { return LargestCause(shares); }

Diagnosis Diagnose(const SequenceReader& sequence, const EstimateReader& estimate) {
  return Diagnose(GatherEvidence(sequence), estimate);
}

Diagnosis Diagnose(const std::vector<FrameEvidence>& gathered, const EstimateReader& estimate) {
  const bool has_joints = !gathered.empty() && !estimate.frames().empty() &&
                          estimate.frames().front().joints.size() == kBoneCount;
  if (!has_joints) return WithoutTruth(estimate);
  std::vector<FrameEvidence> evidence = gathered;
  evidence.resize(std::min(evidence.size(), estimate.frames().size()));
  std::vector<JointErrors17> errors_m;
  for (std::size_t i = 0; i < evidence.size(); ++i)
    errors_m.push_back(ErrorsOf(evidence[i], estimate.frames()[i]));
  const std::vector<FrameState> states = StatesOf(evidence, estimate.frames(), errors_m);
  const std::vector<JointCauses> causes = CausesOf(evidence, states, errors_m);

  Diagnosis diagnosis;
  for (std::size_t i = 0; i < evidence.size(); ++i)
    AddErrors(errors_m[i], causes[i], diagnosis.shares);
  const double total_m = std::accumulate(diagnosis.shares.begin(), diagnosis.shares.end(), 0.0);
  if (total_m > 0.0) {
    for (double& share : diagnosis.shares) share /= total_m;
    diagnosis.events = FindEvents(errors_m, causes, total_m);
  }
  diagnosis.lost_frames = LostFrames(states);
  return diagnosis;
}

}  // namespace vitruvia
