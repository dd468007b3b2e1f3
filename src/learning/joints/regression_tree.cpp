#include "learning/joints/regression_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vitruvia::joints {
namespace {

constexpr int kBins = 32;  // of a feature's values, between which thresholds lie

struct Split {
  DepthFeature feature;
  float threshold = 0.0f;
  double gain = 0.0;
};

// Even over the disc of radius reach_m.
std::array<float, 2> DrawOffset(double reach_m, RandomStream& random) {
  const double radius = reach_m * std::sqrt(random.Uniform());
  const double angle = random.Uniform(-std::numbers::pi, std::numbers::pi);
  return {static_cast<float>(radius * std::cos(angle)),
          static_cast<float>(radius * std::sin(angle))};
}

DepthFeature DrawFeature(double reach_m, RandomStream& random) {
  DepthFeature feature;
  feature.kind = random.Index(2) == 0 ? FeatureKind::kTwoDepths : FeatureKind::kDepthAgainstPoint;
  const auto [x, y] = DrawOffset(reach_m, random);
  const auto [other_x, other_y] = DrawOffset(reach_m, random);
  feature.x = x;
  feature.y = y;
  feature.other_x = other_x;
  feature.other_y = other_y;
  return feature;
}

// Sums of the offsets of samples whose feature values fall into each of kBins even bins.
struct Histogram {
  std::array<Vector3d, kBins> sums;
  std::array<int, kBins> counts;
};

// The best threshold of one feature: Σ |sum|² / count of the two sides is largest.
Split BestThreshold(const DepthFeature& feature, std::span<const float> values,
                    std::span<const Vector3f> offsets) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  Split best{feature};
  if (!(*high > *low)) return best;
  const float width = (*high - *low) / kBins;
  Histogram histogram;
  histogram.sums.fill(Vector3d::Zero());
  histogram.counts.fill(0);
  Vector3d total = Vector3d::Zero();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int bin = std::min(kBins - 1, static_cast<int>((values[i] - *low) / width));
    histogram.sums[bin] += offsets[i].cast<double>();
    ++histogram.counts[bin];
    total += offsets[i].cast<double>();
  }
  const auto count = static_cast<double>(values.size());
  Vector3d left = Vector3d::Zero();
  int left_count = 0;
  for (int bin = 0; bin + 1 < kBins; ++bin) {
    left += histogram.sums[bin];
    left_count += histogram.counts[bin];
    const double right_count = count - left_count;
    if (left_count == 0 || right_count == 0.0) continue;
    const double gain = left.squaredNorm() / left_count +
                        (total - left).squaredNorm() / right_count - total.squaredNorm() / count;
    if (gain > best.gain) {
      best.gain = gain;
      best.threshold = *low + width * static_cast<float>(bin + 1);
    }
  }
  return best;
}

class Grower {
 public:
  Grower(const TreeSettings& settings, double reach_m, RandomStream& random)
      : settings_(settings), reach_m_(reach_m), random_(random) {}

  RegressionTree Grow(std::span<Sample> samples) {
    RegressionTree tree;
    tree.nodes.emplace_back();
    Grow(samples, 0, 0, tree);
    return tree;
  }

 private:
  void Grow(std::span<Sample> samples, int node, int depth, RegressionTree& tree) {
    const auto least = static_cast<std::size_t>(settings_.least_samples);
    if (depth < settings_.depth && samples.size() >= 2 * least) {
      const Split split = FindSplit(samples);
      const auto middle = std::stable_partition(
          samples.begin(), samples.end(),
          [&](const Sample& s) { return split.feature.Of(*s.depth, s.point) < split.threshold; });
      const auto left = static_cast<std::size_t>(middle - samples.begin());
      if (split.gain > 0.0 && left >= least && samples.size() - left >= least) {
        const auto first = static_cast<int>(tree.nodes.size());
        tree.nodes[node].feature = split.feature;
        tree.nodes[node].threshold = split.threshold;
        tree.nodes[node].left = first;
        tree.nodes.resize(tree.nodes.size() + 2);
        Grow(samples.first(left), first, depth + 1, tree);
        Grow(samples.subspan(left), first + 1, depth + 1, tree);
        return;
      }
    }
    Vector3d sum = Vector3d::Zero();
    for (const Sample& sample : samples) sum += sample.offset.cast<double>();
    sum /= static_cast<double>(samples.size());
    for (int k = 0; k < 3; ++k) tree.nodes[node].offset_m[k] = static_cast<float>(sum[k]);
  }

  // On samples evenly spread over all of the node's.
  Split FindSplit(std::span<const Sample> samples) {
    const std::size_t count =
        std::min(samples.size(), static_cast<std::size_t>(settings_.split_samples));
    tried_.clear();
    offsets_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      tried_.push_back(&samples[i * samples.size() / count]);
      offsets_.push_back(tried_.back()->offset);
    }
    values_.resize(count);
    Split best;
    for (int c = 0; c < settings_.candidates; ++c) {
      const DepthFeature feature = DrawFeature(reach_m_, random_);
      for (std::size_t i = 0; i < count; ++i) {
        values_[i] = feature.Of(*tried_[i]->depth, tried_[i]->point);
      }
      const Split split = BestThreshold(feature, values_, offsets_);
      if (split.gain > best.gain) best = split;
    }
    return best;
  }

  const TreeSettings& settings_;
  double reach_m_;
  RandomStream& random_;
  std::vector<const Sample*> tried_;
  std::vector<float> values_;
  std::vector<Vector3f> offsets_;
};

}  // namespace

RegressionTree GrowTree(std::span<Sample> samples, const TreeSettings& settings, double reach_m,
                        RandomStream& random) {
  return Grower(settings, reach_m, random).Grow(samples);
}

}  // namespace vitruvia::joints
