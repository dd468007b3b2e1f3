#include "verification/depth_agreement.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "math/share.h"
#include "math/statistics.h"
#include "verification/depth_changes.h"
#include "verification/limits.h"

namespace vitruvia {
namespace {
using namespace verification_limits;

constexpr long kRatioEvery = 7;  // of the pixels that both have

// Both see nothing there, or the same surface.
bool IsSame(float a, float b) {
  if (!(a > 0.0f) || !(b > 0.0f)) return !(a > 0.0f) && !(b > 0.0f);
  return std::abs(a - b) <= kAgreeWithin_m;
}

struct Outline {
  Eigen::Vector2d center, spread;  // pixels
};

Outline OutlineOf(const DepthImage& depth) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero(), squares = Eigen::Vector2d::Zero();
  double count = 0.0;
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (!(depth(u, v) > 0.0f)) continue;
      const Eigen::Vector2d p(u, v);
      sum += p;
      squares += p.cwiseAbs2();
      count += 1.0;
    }
  }
  const Eigen::Vector2d mean = sum / count;
  return {mean, (squares / count - mean.cwiseAbs2()).cwiseMax(1e-9).cwiseSqrt()};
}

}  // namespace

double DepthAgreement::AgreeingShare() const { return ShareOr(agreeing, both, 0.0); }
double DepthAgreement::CoveredShare() const { return ShareOr(both, rendered, 1.0); }
double DepthAgreement::Silhouette() const { return ShareOr(both, rendered + measured - both, 1.0); }
double DepthAgreement::Score() const { return ShareOr(agreeing, rendered, 0.0); }
double DepthAgreement::DepthRatio() const { return ratios.empty() ? 1.0 : Quantile(ratios, 0.5); }

DepthAgreement Compare(const DepthImage& measured, const DepthImage& rendered) {
  DepthAgreement a;
  for (std::size_t i = 0; i < rendered.pixels().size(); ++i) {
    const float z = measured.pixels()[i], truth = rendered.pixels()[i];
    a.rendered += truth > 0.0f ? 1 : 0;
    a.measured += z > 0.0f ? 1 : 0;
    if (!(z > 0.0f) || !(truth > 0.0f)) continue;
    if (a.both++ % kRatioEvery == 0) a.ratios.push_back(z / truth);
    a.agreeing += std::abs(z - truth) <= kAgreeWithin_m ? 1 : 0;
  }
  return a;
}

void Add(const DepthAgreement& frame, DepthAgreement& sum) {
  sum.rendered += frame.rendered;
  sum.measured += frame.measured;
  sum.both += frame.both;
  sum.agreeing += frame.agreeing;
  sum.ratios.insert(sum.ratios.end(), frame.ratios.begin(), frame.ratios.end());
}

void Vote(const DepthImage& measured, const DepthImage& rendered, const DepthImage& mirrored,
          MirrorVotes& votes) {
  for (std::size_t i = 0; i < rendered.pixels().size(); ++i) {
    const float truth = rendered.pixels()[i], mirror = mirrored.pixels()[i];
    if (IsSame(truth, mirror)) continue;
    const float z = measured.pixels()[i];
    votes.for_truth += IsSame(z, truth) ? 1 : 0;
    votes.for_mirror += IsSame(z, mirror) ? 1 : 0;
  }
}

OutlineDifference CompareOutlines(const DepthImage& measured, const DepthImage& rendered) {
  const Outline a = OutlineOf(measured), b = OutlineOf(rendered);
  const Eigen::Vector2d scale = a.spread.cwiseQuotient(b.spread), shift = a.center - b.center;
  const Eigen::Vector2d edges = std::sqrt(3.0) * (a.spread - b.spread).cwiseAbs();
  return {scale.x(), scale.y(), edges.x(), edges.y(), shift.x(), shift.y()};
}

}  // namespace vitruvia
