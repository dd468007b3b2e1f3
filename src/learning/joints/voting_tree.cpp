#include "learning/joints/voting_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <type_traits>

namespace vitruvia::joints {
namespace {

constexpr int kBins = 32;  // of a feature's values, between which thresholds lie

struct Split {
  DepthFeature feature;
  float threshold = 0.0f;
  double disorder = 0.0;  // of the two sides together
};

Vector3d OffsetTo(int point, const TrainingPixel& pixel) {
  return (*pixel.points)[point] - pixel.position.cast<double>();
}

// The parts that pixels show; their disorder is count · entropy, nats.
struct PartTally {
  std::array<int, kBoneCount> parts{};
  int count = 0;

  void Add(int part) {
    ++parts[part];
    ++count;
  }
  PartTally& operator+=(const PartTally& other) {
    for (int part = 0; part < kBoneCount; ++part) parts[part] += other.parts[part];
    count += other.count;
    return *this;
  }
  PartTally& operator-=(const PartTally& other) {
    for (int part = 0; part < kBoneCount; ++part) parts[part] -= other.parts[part];
    count -= other.count;
    return *this;
  }
  double Disorder() const {
    if (count == 0) return 0.0;
    double sum = count * std::log(static_cast<double>(count));
    for (const int part : parts) {
      if (part > 0) sum -= part * std::log(static_cast<double>(part));
    }
    return sum;
  }
};

// Offsets to a point; their disorder is the sum of squares about their mean, m².
struct OffsetTally {
  Vector3d sum = Vector3d::Zero();
  double squares = 0.0;
  int count = 0;

  void Add(const Vector3d& offset) {
    sum += offset;
    squares += offset.squaredNorm();
    ++count;
  }
  OffsetTally& operator+=(const OffsetTally& other) {
    sum += other.sum;
    squares += other.squares;
    count += other.count;
    return *this;
  }
  OffsetTally& operator-=(const OffsetTally& other) {
    sum -= other.sum;
    squares -= other.squares;
    count -= other.count;
    return *this;
  }
  double Disorder() const { return count == 0 ? 0.0 : squares - sum.squaredNorm() / count; }
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

// `aim` says what splits are to bring together: it gives a pixel's entry in the tally.
template <class Tally, class Aim>
class Grower {
 public:
  Grower(const TreeSettings& settings, std::span<const int> points, Aim aim, RandomStream& random)
      : settings_(settings), points_(points), aim_(aim), random_(random) {}

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
    entries_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      tried_.push_back(&pixels[i * pixels.size() / count]);
      entries_.push_back(aim_(*tried_.back()));
    }
    values_.resize(count);
    Split best;
    best.disorder = std::numeric_limits<double>::infinity();
    for (int c = 0; c < settings_.candidates; ++c) {
      const Split split = BestThreshold(DrawFeature(settings_.reach_m, random_));
      if (split.disorder < best.disorder) best = split;
    }
    return best;
  }

  Split BestThreshold(const DepthFeature& feature) {
    for (std::size_t i = 0; i < tried_.size(); ++i)
      values_[i] = feature.Of(*tried_[i]->depth, tried_[i]->place);
    const auto [low, high] = std::minmax_element(values_.begin(), values_.end());
    Split best{feature};
    best.disorder = std::numeric_limits<double>::infinity();
    if (!(*high > *low)) return best;
    const float lowest = *low, width = (*high - lowest) / kBins;
    std::array<Tally, kBins> bins{};
    Tally left, right;
    for (std::size_t i = 0; i < tried_.size(); ++i) {
      const int bin = std::min(kBins - 1, static_cast<int>((values_[i] - lowest) / width));
      bins[bin].Add(entries_[i]);
      right.Add(entries_[i]);
    }
    for (int bin = 0; bin + 1 < kBins; ++bin) {
      left += bins[bin];
      right -= bins[bin];
      if (left.count == 0 || right.count == 0) continue;
      const double disorder = left.Disorder() + right.Disorder();
      if (disorder >= best.disorder) continue;
      best.disorder = disorder;
      best.threshold = lowest + width * static_cast<float>(bin + 1);
    }
    return best;
  }

  // The points whose offsets vary least.
  VotingTree::Leaf LeafOf(std::span<const TrainingPixel> pixels) const {
    const auto count = static_cast<double>(pixels.size());
    std::vector<PointVote> votes;
    for (const int p : points_) {
      Vector3d mean = Vector3d::Zero();
      for (const TrainingPixel& pixel : pixels) mean += OffsetTo(p, pixel);
      mean /= count;
      double square = 0.0;
      for (const TrainingPixel& pixel : pixels) square += (OffsetTo(p, pixel) - mean).squaredNorm();
      const Vector3f offset = mean.cast<float>();
      votes.push_back(
          {p, static_cast<float>(std::sqrt(square / count)), {offset.x(), offset.y(), offset.z()}});
    }
    std::stable_sort(votes.begin(), votes.end(), [](const PointVote& a, const PointVote& b) {
      return a.deviation_m < b.deviation_m;
    });
    VotingTree::Leaf leaf;
    std::copy_n(votes.begin(), std::min<std::size_t>(votes.size(), kLeafVotes), leaf.begin());
    return leaf;
  }

  const TreeSettings& settings_;
  std::span<const int> points_;  // that leaves may vote for
  Aim aim_;
  RandomStream& random_;
  VotingTree tree_;
  std::vector<const TrainingPixel*> tried_;
  std::vector<std::invoke_result_t<Aim, const TrainingPixel&>> entries_;  // of those tried
  std::vector<float> values_;
};

}  // namespace

VotingTree GrowTree(std::span<TrainingPixel> pixels, const TreeSettings& settings,
                    RandomStream& random) {
  std::array<int, kBodyPointCount> points;
  std::iota(points.begin(), points.end(), 0);
  const auto part = [](const TrainingPixel& pixel) { return pixel.bone; };
  return Grower<PartTally, decltype(part)>(settings, points, part, random).Grow(pixels);
}

VotingTree GrowWalkTree(std::span<TrainingPixel> pixels, int point, const TreeSettings& settings,
                        RandomStream& random) {
  const auto offset = [point](const TrainingPixel& pixel) { return OffsetTo(point, pixel); };
  return Grower<OffsetTally, decltype(offset)>(settings, std::span(&point, 1), offset, random)
      .Grow(pixels);
}

}  // namespace vitruvia::joints
