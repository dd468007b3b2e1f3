#include "learning/joints/voting_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vitruvia::joints {
namespace {

constexpr int kBins = 32;  // of a feature's values, between which thresholds lie

struct Split {
  DepthFeature feature;
  float threshold = 0.0f;
  double cost = std::numeric_limits<double>::infinity();  // of both sides
};

// What the pixels of one side of a split cost: count · entropy of their parts, nats.
class PartCost {
 public:
  void Add(const TrainingPixel& pixel) {
    ++counts_[pixel.bone];
    ++count_;
  }
  void Add(const PartCost& other) {
    for (int part = 0; part < kBoneCount; ++part) counts_[part] += other.counts_[part];
    count_ += other.count_;
  }
  void Remove(const PartCost& other) {
    for (int part = 0; part < kBoneCount; ++part) counts_[part] -= other.counts_[part];
    count_ -= other.count_;
  }
  int count() const { return count_; }
  double Cost() const {
    if (count_ == 0) return 0.0;
    double sum = count_ * std::log(static_cast<double>(count_));
    for (const int part : counts_) {
      if (part > 0) sum -= part * std::log(static_cast<double>(part));
    }
    return sum;
  }

 private:
  std::array<int, kBoneCount> counts_{};
  int count_ = 0;
};

// The far end of each bone: its tip, or the joint of the last bone that hangs on it.
std::array<int, kBoneCount> FarEnds() {
  std::array<int, kBoneCount> ends{};
  const auto& points = BodyPoints();
  for (int p = 0; p < kBodyPointCount; ++p) {
    if (points[p].parent >= 0) ends[points[p].parent] = p;
  }
  return ends;
}

// What they cost: squared deviations of the offsets to both ends of their bone from the mean, m².
class OffsetCost {
 public:
  void Add(const TrainingPixel& pixel) {
    static const std::array<int, kBoneCount> ends = FarEnds();
    Eigen::Vector<double, 6> offset;
    offset << (*pixel.points)[pixel.bone] - pixel.position.cast<double>(),
        (*pixel.points)[ends[pixel.bone]] - pixel.position.cast<double>();
    sum_ += offset;
    square_ += offset.squaredNorm();
    ++count_;
  }
  void Add(const OffsetCost& other) {
    sum_ += other.sum_;
    square_ += other.square_;
    count_ += other.count_;
  }
  void Remove(const OffsetCost& other) {
    sum_ -= other.sum_;
    square_ -= other.square_;
    count_ -= other.count_;
  }
  int count() const { return count_; }
  double Cost() const { return count_ == 0 ? 0.0 : square_ - sum_.squaredNorm() / count_; }

 private:
  Eigen::Vector<double, 6> sum_ = Eigen::Vector<double, 6>::Zero();
  double square_ = 0.0;
  int count_ = 0;
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
    return ArePartsApart() ? BestSplit<OffsetCost>() : BestSplit<PartCost>();
  }

  bool ArePartsApart() const {
    PartCost parts;
    for (const TrainingPixel* pixel : tried_) parts.Add(*pixel);
    return parts.Cost() < settings_.parts_apart_nats * parts.count();
  }

  template <class Cost>
  Split BestSplit() {
    Split best;
    for (int c = 0; c < settings_.candidates; ++c) {
      const Split split = BestThreshold<Cost>(DrawFeature(settings_.reach_m, random_));
      if (split.cost < best.cost) best = split;
    }
    return best;
  }

  template <class Cost>
  Split BestThreshold(const DepthFeature& feature) {
    for (std::size_t i = 0; i < tried_.size(); ++i)
      values_[i] = feature.Of(*tried_[i]->depth, tried_[i]->place);
    const auto [low, high] = std::minmax_element(values_.begin(), values_.end());
    Split best{feature};
    if (!(*high > *low)) return best;
    const float lowest = *low, width = (*high - lowest) / kBins;
    std::array<Cost, kBins> bins{};
    Cost left, right;
    for (std::size_t i = 0; i < tried_.size(); ++i) {
      const int bin = std::min(kBins - 1, static_cast<int>((values_[i] - lowest) / width));
      bins[bin].Add(*tried_[i]);
    }
    for (const Cost& bin : bins) right.Add(bin);
    for (int bin = 0; bin + 1 < kBins; ++bin) {
      left.Add(bins[bin]);
      right.Remove(bins[bin]);
      if (left.count() == 0 || right.count() == 0) continue;
      const double cost = left.Cost() + right.Cost();
      if (cost >= best.cost) continue;
      best.cost = cost;
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
