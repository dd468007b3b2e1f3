#include "learning/joints/voting_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vitruvia::joints {
namespace {

constexpr int kBins = 32;  // of a feature's values, between which thresholds lie

using PartCounts = std::array<int, kBoneCount>;

struct Split {
  DepthFeature feature;
  float threshold = 0.0f;
  double entropy = 0.0;  // of the two sides, times their numbers of pixels
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

// count · entropy, nats.
double EntropyOf(const PartCounts& counts, int count) {
  if (count == 0) return 0.0;
  double sum = count * std::log(static_cast<double>(count));
  for (const int part : counts) {
    if (part > 0) sum -= part * std::log(static_cast<double>(part));
  }
  return sum;
}

class Grower {
 public:
  Grower(const TreeSettings& settings, RandomStream& random)
      : settings_(settings), random_(random) {}

  VotingTree Grow(std::span<TrainingPixel> pixels) {
    tree_.nodes.emplace_back();
    Grow(pixels, 0, 0);
    return std::move(tree_);
  }

 private:
  void Grow(std::span<TrainingPixel> pixels, int node, int depth) {
    const auto least = static_cast<std::size_t>(settings_.least_pixels);
    if (depth < settings_.depth && pixels.size() >= 2 * least) {
      const Split split = FindSplit(pixels);
      const auto middle =
          std::stable_partition(pixels.begin(), pixels.end(), [&](const TrainingPixel& p) {
            return split.feature.Of(*p.depth, p.place) < split.threshold;
          });
      const auto left = static_cast<std::size_t>(middle - pixels.begin());
      if (left >= least && pixels.size() - left >= least) {
        const auto first = static_cast<int>(tree_.nodes.size());
        tree_.nodes[node].feature = split.feature;
        tree_.nodes[node].threshold = split.threshold;
        tree_.nodes[node].left = first;
        tree_.nodes.resize(tree_.nodes.size() + 2);
        Grow(pixels.first(left), first, depth + 1);
        Grow(pixels.subspan(left), first + 1, depth + 1);
        return;
      }
    }
    tree_.nodes[node].leaf = static_cast<std::int32_t>(tree_.leaves.size());
    tree_.leaves.push_back(LeafOf(pixels));
  }

  // On pixels evenly spread over all of the node's.
  Split FindSplit(std::span<const TrainingPixel> pixels) {
    const std::size_t count =
        std::min(pixels.size(), static_cast<std::size_t>(settings_.split_pixels));
    tried_.clear();
    for (std::size_t i = 0; i < count; ++i) tried_.push_back(&pixels[i * pixels.size() / count]);
    values_.resize(count);
    Split best;
    best.entropy = std::numeric_limits<double>::infinity();
    for (int c = 0; c < settings_.candidates; ++c) {
      const Split split = BestThreshold(DrawFeature(settings_.reach_m, random_));
      if (split.entropy < best.entropy) best = split;
    }
    return best;
  }

  Split BestThreshold(const DepthFeature& feature) {
    for (std::size_t i = 0; i < tried_.size(); ++i)
      values_[i] = feature.Of(*tried_[i]->depth, tried_[i]->place);
    const auto [low, high] = std::minmax_element(values_.begin(), values_.end());
    Split best{feature};
    best.entropy = std::numeric_limits<double>::infinity();
    if (!(*high > *low)) return best;
    const float lowest = *low, width = (*high - lowest) / kBins;
    std::array<PartCounts, kBins> bins{};
    PartCounts right{};
    for (std::size_t i = 0; i < tried_.size(); ++i) {
      const int bin = std::min(kBins - 1, static_cast<int>((values_[i] - lowest) / width));
      ++bins[bin][tried_[i]->bone];
      ++right[tried_[i]->bone];
    }
    PartCounts left{};
    int left_count = 0;
    const auto count = static_cast<int>(tried_.size());
    for (int bin = 0; bin + 1 < kBins; ++bin) {
      for (int part = 0; part < kBoneCount; ++part) {
        left[part] += bins[bin][part];
        right[part] -= bins[bin][part];
        left_count += bins[bin][part];
      }
      if (left_count == 0 || left_count == count) continue;
      const double entropy = EntropyOf(left, left_count) + EntropyOf(right, count - left_count);
      if (entropy >= best.entropy) continue;
      best.entropy = entropy;
      best.threshold = lowest + width * static_cast<float>(bin + 1);
    }
    return best;
  }

  // The points whose offsets vary least.
  static VotingTree::Leaf LeafOf(std::span<const TrainingPixel> pixels) {
    const auto count = static_cast<double>(pixels.size());
    std::array<PointVote, kBodyPointCount> votes;
    for (int p = 0; p < kBodyPointCount; ++p) {
      Vector3d mean = Vector3d::Zero();
      for (const TrainingPixel& pixel : pixels)
        mean += (*pixel.points)[p] - pixel.position.cast<double>();
      mean /= count;
      double square = 0.0;
      for (const TrainingPixel& pixel : pixels)
        square += ((*pixel.points)[p] - pixel.position.cast<double>() - mean).squaredNorm();
      votes[p].point = p;
      votes[p].deviation_m = static_cast<float>(std::sqrt(square / count));
      for (int k = 0; k < 3; ++k) votes[p].offset_m[k] = static_cast<float>(mean[k]);
    }
    std::stable_sort(votes.begin(), votes.end(), [](const PointVote& a, const PointVote& b) {
      return a.deviation_m < b.deviation_m;
    });
    VotingTree::Leaf leaf;
    std::copy_n(votes.begin(), kLeafVotes, leaf.begin());
    return leaf;
  }

  const TreeSettings& settings_;
  RandomStream& random_;
  VotingTree tree_;
  std::vector<const TrainingPixel*> tried_;
  std::vector<float> values_;
};

}  // namespace

VotingTree GrowTree(std::span<TrainingPixel> pixels, const TreeSettings& settings,
                    RandomStream& random) {
  return Grower(settings, random).Grow(pixels);
}

}  // namespace vitruvia::joints
