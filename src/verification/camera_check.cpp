#include <algorithm>
#include <cmath>

#include "math/angles.h"
#include "verification/checks.h"
#include "verification/limits.h"

namespace vitruvia {
namespace {
using namespace verification_limits;

double FieldOfView_deg(double size_px, double focal_px) {
  return 2.0 * std::atan(size_px / (2.0 * focal_px)) / kRadiansPerDegree;
}

bool IsNear(double value, double expected) {
  return std::abs(value / expected - 1.0) < kOtherResolutionWithin;
}

// How many times larger the image is whose centre the principal point is; 0 if it is none.
double ResolutionOfCenter(const PinholeCamera& c) {
  const double kx = 2.0 * c.cx / (c.width - 1), ky = 2.0 * c.cy / (c.height - 1);
  return kx > 0.0 && ky > 0.0 && IsNear(kx, ky) ? kx : 0.0;
}

bool IsNearCenter(double principal, int size) {
  return std::abs(principal - (size - 1) / 2.0) < (0.5 - kPrincipalPointMargin) * size;
}

std::string CenterCause(const PinholeCamera& c) {
  if (IsNear(2.0 * c.cx / (c.height - 1), 1.0) && IsNear(2.0 * c.cy / (c.width - 1), 1.0))
    return "; are width and height, or cx and cy, swapped?";
  const double k = ResolutionOfCenter(c);
  if (k == 0.0) return "; was the image cropped without moving cx and cy?";
  return fmt::format(
      "; it is the centre of an image of {:.0f}×{:.0f}: intrinsics of another "
      "resolution?",
      k * (c.width - 1) + 1, k * (c.height - 1) + 1);
}

}  // namespace

Findings CheckCamera(const PinholeCamera& c) {
  Findings findings;
  const std::string size = fmt::format("{}×{}", c.width, c.height);
  if (!(c.fx > 0.0) || !(c.fy > 0.0))
    return {Impossible("sequence.json: camera: fx {:g} and fy {:g}, expected both above 0", c.fx,
                       c.fy)};
  const double view = std::max(FieldOfView_deg(c.width, c.fx), FieldOfView_deg(c.height, c.fy));
  if (view < kNarrowestView_deg || view > kWidestView_deg)
    findings.push_back(Warning(
        "sequence.json: camera: a field of view of {:.3g} degrees (fx {:g}, fy {:g}, image of {}), "
        "expected {:g} to {:g}; are fx and fy in pixels of this resolution?",
        view, c.fx, c.fy, size, kNarrowestView_deg, kWidestView_deg));
  if (std::max(c.fx / c.fy, c.fy / c.fx) > kLargestPixelAspect)
    findings.push_back(Warning(
        "sequence.json: camera: fx {:g} and fy {:g} differ by more than a factor of {:g}; is one "
        "of another resolution?",
        c.fx, c.fy, kLargestPixelAspect));
  if (!IsNearCenter(c.cx, c.width) || !IsNearCenter(c.cy, c.height))
    findings.push_back(Warning(
        "sequence.json: camera: the principal point ({:g}, {:g}) is far from the centre ({:g}, "
        "{:g}) of an image of {}{}",
        c.cx, c.cy, (c.width - 1) / 2.0, (c.height - 1) / 2.0, size, CenterCause(c)));
  return findings;
}

}  // namespace vitruvia
