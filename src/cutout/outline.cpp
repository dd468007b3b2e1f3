#include "cutout/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include <opencv2/imgproc.hpp>

namespace vitruvia {
namespace {

// Pixels of an image, given by the half-open ranges of their columns and rows; may exceed it.
struct PixelBounds {
  int left = 0, top = 0, right = 0, bottom = 0;

  int width() const { return right - left; }
  int height() const { return bottom - top; }
  PixelBounds Grown(int margin_px) const {
    return {left - margin_px, top - margin_px, right + margin_px, bottom + margin_px};
  }
};

constexpr int kNumbers = 256;  // a byte each in the label images

// The bounds of each person's pixels, by the person's number; empty of numbers that do not occur.
std::array<PixelBounds, kNumbers> BoundsOf(const Image<std::uint8_t>& people) {
  std::array<PixelBounds, kNumbers> bounds{};
  for (int v = 0; v < people.height(); ++v) {
    const std::uint8_t* row = &people(0, v);
    if (std::accumulate(row, row + people.width(), std::uint8_t{0}, std::bit_or<>()) == 0) continue;
    for (int u = 0; u < people.width(); ++u) {
      if (people(u, v) == 0) continue;
      PixelBounds& of = bounds[people(u, v)];
      if (of.right == 0) of = {u, v, u, v};
      of = {std::min(of.left, u), of.top, std::max(of.right, u + 1), v + 1};
    }
  }
  return bounds;
}

// One number per pixel of some bounds.
using Layer = Image<float>;

// Weights of a normal distribution at −reach … reach; their sum is 1.
std::vector<float> KernelOf(const OutlineSettings& settings) {
  std::vector<float> kernel;
  float sum = 0.0f;
  for (int i = -settings.reach_px; i <= settings.reach_px; ++i) {
    const double at = i / settings.spread_px;
    kernel.push_back(static_cast<float>(std::exp(-0.5 * at * at)));
    sum += kernel.back();
  }
  for (float& weight : kernel) weight /= sum;
  return kernel;
}

void AddScaled(const float* from, int count, float scale, float* to) {
  for (int i = 0; i < count; ++i) to[i] += scale * from[i];
}

// Weighted sums over columns and then over rows; 0 within reach of the layer's rim.
Layer Blurred(const Layer& layer, const std::vector<float>& kernel) {
  const int width = layer.width(), height = layer.height();
  const int taps = static_cast<int>(kernel.size()), reach = taps / 2;
  Layer across(width, height), both(width, height);
  for (int v = 0; v < height; ++v) {
    for (int k = 0; k < taps; ++k)
      AddScaled(&layer(k, v), width - 2 * reach, kernel[static_cast<std::size_t>(k)],
                &across(reach, v));
  }
  for (int v = reach; v < height - reach; ++v) {
    for (int k = 0; k < taps; ++k)
      AddScaled(&across(0, v + k - reach), width, kernel[static_cast<std::size_t>(k)], &both(0, v));
  }
  return both;
}

// Grows a part by so many pixels within another one.
cv::Mat Grown(const cv::Mat& part, const cv::Mat& within, int steps) {
  cv::Mat grown = part.clone();
  for (int i = 0; i < steps; ++i) {
    cv::dilate(grown, grown, cv::Mat());  // 3×3
    cv::bitwise_and(grown, within, grown);
  }
  return grown;
}

// Drops parts that are shorter than `least_px` along rows and columns; those that are a pixel
// apart count as one.
void DropShort(int least_px, cv::Mat& parts) {
  cv::Mat wider, labels, stats, centers;
  cv::dilate(parts, wider, cv::Mat());  // 3×3
  cv::connectedComponentsWithStats(wider, labels, stats, centers);
  for (int v = 0; v < parts.rows; ++v) {
    for (int u = 0; u < parts.cols; ++u) {
      const int* box = stats.ptr<int>(labels.at<int>(v, u));
      if (std::max(box[cv::CC_STAT_WIDTH], box[cv::CC_STAT_HEIGHT]) < least_px + 2)
        parts.at<std::uint8_t>(v, u) = 0;
    }
  }
}

// What is thinner than `reach_px`, at least twice as long and leads farther than it away from
// thicker parts, such as an arm at a low resolution, as 255; the roughness of an edge does not.
MaskImage ThinParts(MaskImage person, int reach_px) {
  const cv::Mat all(person.height(), person.width(), CV_8UC1, person.pixels().data());
  cv::Mat thick, thin;
  cv::morphologyEx(all, thick, cv::MORPH_OPEN, cv::Mat::ones(reach_px, reach_px, CV_8UC1));
  cv::subtract(all, Grown(thick, all, reach_px), thin);
  thin = Grown(thin, all - thick, reach_px);
  DropShort(2 * reach_px, thin);
  thin.copyTo(all);
  return person;
}

// The outline of one person.
class PersonOutline {
 public:
  // `bounds`: of the person's pixels.
  PersonOutline(const DepthImage& depth, const Pieces& pieces, const Room& room,
                const CutoutSettings& settings, const Image<std::uint8_t>& people, int person,
                const PixelBounds& bounds)
      : depth_(depth),
        pieces_(pieces),
        room_(room),
        s_(settings),
        people_(people),
        person_(person),
        bounds_(bounds.Grown(2 * settings.outline.reach_px)),
        kernel_(KernelOf(settings.outline)) {}

  void Smooth(OutlinedPeople& smoothed) const {
    const Surroundings near = FindSurroundings();
    Votes votes{NewLayer(), NewLayer(), NewLayer()};
    ForEachPixel([&](int x, int y, int u, int v) {
      const Vote vote = VoteOf(u, v, near.weight(x, y), near.depth(x, y));
      votes.share(x, y) = vote.share;
      votes.weighted_share(x, y) = vote.weight * vote.share;
      votes.weight(x, y) = vote.weight;
    });
    const Layer weighted_share = Blurred(votes.weighted_share, kernel_);
    const Layer weight = Blurred(votes.weight, kernel_);
    const MaskImage thin = FindThinParts();
    ForEachPixel([&](int x, int y, int u, int v) {
      if (!MayChange(u, v) || near.weight(x, y) == 0.0f) return;
      const bool belongs = thin(x, y) != 0 || weighted_share(x, y) >= 0.5f * weight(x, y);
      if (people_(u, v) != person_ && !belongs) return;
      smoothed.people(u, v) = static_cast<std::uint8_t>(belongs ? person_ : 0);
      if (depth_(u, v) > 0.0f && belongs && votes.share(x, y) < 0.5f)
        smoothed.foreign_depth.push_back(v * depth_.width() + u);
    });
  }

 private:
  struct Surroundings {
    Layer weight;  // of the person's pixels in the window round each pixel
    Layer depth;   // their mean, where the weight is not 0
  };

  // `share`: of the pixel that is the person's.
  struct Vote {
    float share = 0.0f, weight = 0.0f;
  };
  struct Votes {
    Layer share, weighted_share, weight;
  };

  Layer NewLayer() const { return {bounds_.width(), bounds_.height()}; }

  // Pixels of the image: their place in a layer and in the image.
  template <class Visit>
  void ForEachPixel(const Visit& visit) const {
    const int right = std::min(bounds_.right, depth_.width());
    const int bottom = std::min(bounds_.bottom, depth_.height());
    for (int v = std::max(bounds_.top, 0); v < bottom; ++v) {
      for (int u = std::max(bounds_.left, 0); u < right; ++u)
        visit(u - bounds_.left, v - bounds_.top, u, v);
    }
  }

  Surroundings FindSurroundings() const {
    Layer is_person = NewLayer(), person_depth = NewLayer();
    ForEachPixel([&](int x, int y, int u, int v) {
      if (people_(u, v) != person_) return;
      is_person(x, y) = 1.0f;
      person_depth(x, y) = depth_(u, v);
    });
    Surroundings near{Blurred(is_person, kernel_), Blurred(person_depth, kernel_)};
    for (std::size_t i = 0; i < near.depth.pixels().size(); ++i) {
      if (near.weight.pixels()[i] > 0.0f) near.depth.pixels()[i] /= near.weight.pixels()[i];
    }
    return near;
  }

  MaskImage FindThinParts() const {
    MaskImage person(bounds_.width(), bounds_.height());
    ForEachPixel([&](int x, int y, int u, int v) {
      if (people_(u, v) == person_) person(x, y) = 255;
    });
    return ThinParts(std::move(person), s_.outline.reach_px);
  }

  // Pixels of other people and of other pieces stay what they are.
  bool MayChange(int u, int v) const {
    return people_(u, v) == person_ || (people_(u, v) == 0 && pieces_.labels(u, v) == 0);
  }

  Vote VoteOf(int u, int v, float near_weight, float person_m) const {
    const auto doubtful = static_cast<float>(s_.outline.doubtful_weight);
    const float z = depth_(u, v);
    if (people_(u, v) == person_) return {1.0f, 1.0f};
    if (people_(u, v) != 0) return {0.0f, 0.0f};
    if (!(z > 0.0f)) return {0.0f, doubtful};
    if (near_weight == 0.0f || pieces_.labels(u, v) != 0 || z < s_.near_m || z > s_.far_m)
      return {0.0f, 1.0f};
    const RoomDepth behind = RoomDepthAt(room_, s_, u, v);
    if (behind.IsInFront(z)) return {0.0f, doubtful};
    return {ShareOfPerson(z, behind.depth_m, person_m), 1.0f};
  }

  // The share of the way from the room's depth to the person's at which a pixel's depth lies.
  float ShareOfPerson(float z, float behind_m, float person_m) const {
    const auto share = static_cast<float>(s_.outline.depth_share);
    const float noise_m = static_cast<float>(s_.outline.least_sigmas) * room_.NoiseAt(behind_m);
    const float way_m = std::max(share * (behind_m - person_m), noise_m);
    return way_m > 0.0f ? std::clamp((behind_m - z) / way_m, 0.0f, 1.0f) : 0.0f;
  }

  const DepthImage& depth_;
  const Pieces& pieces_;
  const Room& room_;
  const CutoutSettings& s_;
  const Image<std::uint8_t>& people_;
  int person_;
  PixelBounds bounds_;
  std::vector<float> kernel_;
};

}  // namespace

OutlinedPeople SmoothOutlines(const DepthImage& depth, const Pieces& pieces, const Room& room,
                              const CutoutSettings& settings, const Image<std::uint8_t>& people) {
  OutlinedPeople smoothed{people, {}};
  if (settings.outline.reach_px == 0) return smoothed;
  const std::array<PixelBounds, kNumbers> bounds = BoundsOf(people);
  for (int person = 1; person < kNumbers; ++person) {
    const PixelBounds& of = bounds[static_cast<std::size_t>(person)];
    if (of.width() > 0)
      PersonOutline(depth, pieces, room, settings, people, person, of).Smooth(smoothed);
  }
  std::sort(smoothed.foreign_depth.begin(), smoothed.foreign_depth.end());
  return smoothed;
}

}  // namespace vitruvia
