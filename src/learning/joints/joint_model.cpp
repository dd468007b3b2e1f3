#include "learning/joints/joint_model.h"

#include <algorithm>
#include <cmath>

namespace vitruvia::joints {
namespace {

struct WeightedPlace {
  Vector3f place;
  float weight;
};
using Votes = std::array<std::vector<WeightedPlace>, kBodyPointCount>;

constexpr std::size_t kStarts = 8;  // votes from which the densest place is looked for

// Density of votes with a Gaussian kernel; `shifted` is the mean-shift update of the position.
float Density(const std::vector<WeightedPlace>& votes, const Vector3f& place, float bandwidth_m,
              Vector3f& shifted) {
  const float scale = -0.5f / (bandwidth_m * bandwidth_m);
  float sum = 0.0f;
  shifted.setZero();
  for (const WeightedPlace& vote : votes) {
    const float squared = (vote.place - place).squaredNorm();
    if (squared > 9.0f * bandwidth_m * bandwidth_m) continue;
    const float weight = vote.weight * std::exp(scale * squared);
    sum += weight;
    shifted += weight * vote.place;
  }
  if (sum > 0.0f) shifted /= sum;
  return sum;
}

std::optional<Vector3d> ModeOf(const std::vector<WeightedPlace>& votes,
                               const VoteSettings& settings) {
  if (votes.empty()) return {};
  const auto bandwidth_m = static_cast<float>(settings.bandwidth_m);
  Vector3f best = votes.front().place, shifted;
  float most = -1.0f;
  const std::size_t starts = std::min(kStarts, votes.size());
  for (std::size_t i = 0; i < starts; ++i) {
    const Vector3f& start = votes[i * votes.size() / starts].place;
    const float density = Density(votes, start, bandwidth_m, shifted);
    if (density > most) {
      most = density;
      best = shifted;
    }
  }
  for (int i = 0; i < settings.shifts; ++i) {
    if (Density(votes, best, bandwidth_m, shifted) <= 0.0f) break;
    best = shifted;
  }
  return best.cast<double>();
}

// From a place to where the trees lead: the mean of the last half of the steps' places.
Vector3d Walk(const std::vector<VotingTree>& trees, int steps, const WholeDepth& view,
              const PinholeCamera& camera, const Vector3d& start) {
  if (steps == 0 || trees.empty()) return start;
  Vector3f place = start.cast<float>(), sum_of_last = Vector3f::Zero();
  const int first_counted = steps / 2;
  for (int i = 0; i < steps; ++i) {
    const FeaturePoint here(camera, place);
    Vector3f offsets = Vector3f::Zero();
    for (const VotingTree& tree : trees)
      offsets += Eigen::Map<const Vector3f>(tree.LeafOf(view, here).front().offset_m.data());
    place += offsets / static_cast<float>(trees.size());
    if (i >= first_counted) sum_of_last += place;
  }
  return (sum_of_last / static_cast<float>(steps - first_counted)).cast<double>();
}

}  // namespace

void VoteSettings::Describe(Fields& f) {
  f.Integer("stride_px", stride_px,
            {.meaning = "stride in columns and rows of the pixels that vote for joints",
             .unit = "px",
             .min = 1,
             .max = 16,
             .origin = Origin::kGuessed});
  f.Number("deviation_m", deviation_m,
           {.meaning = "a vote's weight is 1 / (deviation_m² + its leaf's deviation²)²",
            .unit = "m",
            .min = 1e-3,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("bandwidth_m", bandwidth_m,
           {.meaning = "bandwidth of the mean shift over votes",
            .unit = "m",
            .min = 1e-3,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "Shotton et al. 2011: for each joint by a grid search"});
  f.Integer("shifts", shifts,
            {.meaning = "maximum number of mean shift steps over votes",
             .min = 0,
             .max = 1000,
             .origin = Origin::kGuessed});
  f.Integer("steps", steps,
            {.meaning = "steps of the walk from the votes' mode to a joint",
             .min = 0,
             .max = 1000,
             .origin = Origin::kGuessed});
}

DetectedPoints JointDetector::Detect(const DepthImage& depth, const PinholeCamera& camera,
                                     double max_depth_m, double size) const {
  const WholeDepth view{depth, static_cast<float>(max_depth_m), static_cast<float>(size)};
  const auto least_variance = static_cast<float>(settings_.deviation_m * settings_.deviation_m);
  Votes votes;
  for (int v = 0; v < depth.height(); v += settings_.stride_px) {
    for (int u = 0; u < depth.width(); u += settings_.stride_px) {
      const float z = view.At(u, v);
      if (z == 0.0f) continue;
      const Vector3f position =
          camera.Unproject<float>(static_cast<float>(u), static_cast<float>(v), z);
      const FeaturePoint place(camera, position);
      for (const VotingTree& tree : model_.trees) {
        for (const PointVote& vote : tree.LeafOf(view, place)) {
          if (vote.point < 0) continue;
          const float variance = least_variance + vote.deviation_m * vote.deviation_m;
          votes[vote.point].push_back(
              {position + Vector3f(vote.offset_m[0], vote.offset_m[1], vote.offset_m[2]),
               z * z / (variance * variance)});
        }
      }
    }
  }
  DetectedPoints found;
  for (int p = 0; p < kBodyPointCount; ++p) {
    found[p] = ModeOf(votes[p], settings_);
    if (found[p]) found[p] = size * Walk(model_.walks[p], settings_.steps, view, camera, *found[p]);
  }
  return found;
}

}  // namespace vitruvia::joints
