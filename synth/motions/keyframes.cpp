#include "synth/motions/keyframes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/angles.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "synth/motions/keyframes_spline.h"

namespace vitruvia {
namespace {

constexpr double kPlantingStep_s = 1.0 / 120.0;  // of the integral over planted limbs

constexpr double kWeightTransfer_s = 0.1;

using SupportWeights = std::array<double, kSupportCount>;  // sum to 1, or all 0: in the air
using Vector2 = Eigen::Vector2d;                           // on the floor: x (left), z (front)

constexpr std::array<BoneId, kSupportCount> kSupportBones = {BoneId::kLeftFoot, BoneId::kRightFoot,
                                                             BoneId::kLeftHand, BoneId::kRightHand};

// Calls visit(member of a, member of b …) for each quantity that is interpolated.
template <class Visit, class... Keys>
void ForEachQuantity(Visit&& visit, Keys&... keys) {
  for (std::size_t i = 0; i < kMidlineAngleCount; ++i) visit(keys.angles.midline_deg[i]...);
  for (std::size_t side = 0; side < kSideCount; ++side) {
    for (std::size_t i = 0; i < kSideAngleCount; ++i) visit(keys.angles.sides_deg[side][i]...);
  }
  visit(keys.root.left_m...);
  visit(keys.root.forward_m...);
  visit(keys.root.heading_deg...);
  visit(keys.root.pitch_deg...);
  visit(keys.root.roll_deg...);
  visit(keys.root.clearance_m...);
}

Matrix3<double> PelvisRotation(const RootState& root) {
  const auto turn = [](double angle_deg, const Vector3<double>& axis) {
    return ExpSo3<double>(kRadiansPerDegree * angle_deg * axis);
  };
  return turn(root.heading_deg, Vector3<double>::UnitY()) *
         turn(root.pitch_deg, Vector3<double>::UnitX()) *
         turn(-root.roll_deg, Vector3<double>::UnitZ());
}

class KeyframedMotion final : public Motion {
 public:
  KeyframedMotion(const KeyframeSequence& sequence, const Skeleton& skeleton)
      : keys_(sequence.keys), loop_(sequence.loop), skeleton_(skeleton) {
    std::vector<double> times;
    for (const KeyFrame& key : keys_) times.push_back(key.time_s);
    std::vector<std::vector<double>> columns;
    for (const KeyFrame& key : keys_) {
      std::size_t column = 0;
      ForEachQuantity(
          [&](const double& value) {
            if (column == columns.size()) columns.emplace_back();
            columns[column++].push_back(value);
          },
          key);
    }
    for (auto& column : columns) splines_.emplace_back(times, std::move(column), Ends());
    IntegratePlanting();
  }

  double duration_s() const override { return keys_.back().time_s; }
  bool repeats() const override { return loop_; }

  MotionSample At(double time_s) const override {
    const double duration = duration_s();
    const double rounds = loop_ ? std::floor(std::max(time_s, 0.0) / duration) : 0.0;
    const double time = std::clamp(time_s - rounds * duration, 0.0, duration);
    const KeyFrame state = Interpolated(time);
    MotionSample sample;
    sample.pose = PoseOf(state);
    sample.clearance_m = state.root.clearance_m;
    const Vector2 floor = PathAt(time, state.root) + rounds * travel_per_round_;
    sample.pose.pelvis_position = skeleton_.joints[0];
    sample.pose.pelvis_position.x() += floor.x();
    sample.pose.pelvis_position.z() += floor.y();
    return sample;
  }

 private:
  SplineEnds Ends() const { return loop_ ? SplineEnds::kLooped : SplineEnds::kAtRest; }

  KeyFrame Interpolated(double time) const {
    KeyFrame state;
    std::size_t column = 0;
    ForEachQuantity([&](double& value) { value = splines_[column++].At(time); }, state);
    return state;
  }

  // With the pelvis joint at the origin.
  static JointPose PoseOf(const KeyFrame& state) {
    JointPose pose;
    SetRotations(state.angles, pose);
    pose.local_rotations[0] = PelvisRotation(state.root);
    return pose;
  }

  // Between two key frames rests what is planted at both.
  SupportWeights SupportBetween(std::size_t key) const {
    SupportWeights weights;
    for (std::size_t i = 0; i < kSupportCount; ++i) {
      weights[i] = keys_[key].planted[i] && keys_[key + 1].planted[i] ? 1.0 : 0.0;
    }
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights) weight /= std::max(sum, 1.0);
    return weights;
  }

  // Around a key frame the weight goes over from one limb to another.
  SupportWeights SupportAt(double time) const {
    const std::size_t intervals = keys_.size() - 1;
    std::size_t i = 0;
    while (i + 1 < intervals && time >= keys_[i + 1].time_s) ++i;
    const double after = time - keys_[i].time_s, before = keys_[i + 1].time_s - time;
    const bool at_start = after < before;
    std::size_t other = i;
    if (at_start && (i > 0 || loop_)) other = (i + intervals - 1) % intervals;
    if (!at_start && (i + 1 < intervals || loop_)) other = (i + 1) % intervals;
    const double other_width = keys_[other + 1].time_s - keys_[other].time_s;
    const double half_transfer = 0.5 * std::min({kWeightTransfer_s, after + before, other_width});
    const double share = std::max(0.0, 0.5 - 0.5 * std::min(after, before) / half_transfer);
    const SupportWeights here = SupportBetween(i), there = SupportBetween(other);
    SupportWeights weights;
    for (std::size_t k = 0; k < kSupportCount; ++k) {
      weights[k] = (1.0 - share) * here[k] + share * there[k];
    }
    return weights;
  }

  // The middles of hands and feet on the floor, relative to the pelvis.
  std::array<Vector2, kSupportCount> SupportPoints(double time) const {
    const BoneTransforms posed_from_rest = ForwardKinematics(skeleton_, PoseOf(Interpolated(time)));
    std::array<Vector2, kSupportCount> points;
    for (std::size_t i = 0; i < kSupportCount; ++i) {
      const std::size_t bone = static_cast<std::size_t>(kSupportBones[i]);
      const Vector3<double> middle = 0.5 * (skeleton_.joints[bone] + skeleton_.tips[bone]);
      const Vector3<double> posed = posed_from_rest[bone] * middle;
      points[i] = {posed.x(), posed.z()};
    }
    return points;
  }

  void IntegratePlanting() {
    const int steps = std::max(1, static_cast<int>(std::ceil(duration_s() / kPlantingStep_s)));
    Vector2 shift = Vector2::Zero();
    std::vector<double> times{0.0}, left{0.0}, forward{0.0};
    std::array<Vector2, kSupportCount> before = SupportPoints(0.0);
    for (int step = 1; step <= steps && duration_s() > 0.0; ++step) {
      const double time = duration_s() * step / steps;
      const auto weights = SupportAt(0.5 * (times.back() + time));
      const auto now = SupportPoints(time);
      for (std::size_t i = 0; i < kSupportCount; ++i) shift -= weights[i] * (now[i] - before[i]);
      before = now;
      times.push_back(time);
      left.push_back(shift.x());
      forward.push_back(shift.y());
    }
    planted_left_ = MonotoneSpline(times, left, Ends());
    planted_forward_ = MonotoneSpline(times, forward, Ends());
    const RootState &first = keys_.front().root, &last = keys_.back().root;
    travel_per_round_ =
        shift + Vector2(last.left_m - first.left_m, last.forward_m - first.forward_m);
  }

  Vector2 PathAt(double time, const RootState& root) const {
    return {root.left_m + planted_left_.At(time), root.forward_m + planted_forward_.At(time)};
  }

  std::vector<KeyFrame> keys_;
  bool loop_;
  Skeleton skeleton_;
  std::vector<MonotoneSpline> splines_;  // in the order of ForEachQuantity
  MonotoneSpline planted_left_{{0.0}, {0.0}, SplineEnds::kAtRest};
  MonotoneSpline planted_forward_{{0.0}, {0.0}, SplineEnds::kAtRest};
  Vector2 travel_per_round_ = Vector2::Zero();
};

}  // namespace

std::unique_ptr<Motion> MakeKeyframedMotion(const KeyframeSequence& sequence,
                                            const Skeleton& skeleton) {
  return std::make_unique<KeyframedMotion>(sequence, skeleton);
}

}  // namespace vitruvia
