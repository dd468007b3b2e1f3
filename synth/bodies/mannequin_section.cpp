#include "synth/bodies/mannequin_section.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace vitruvia::mannequin {

double GirthOf(const Section& points) {
  Eigen::Matrix<double, kRingPoints, kRingPoints> basis;
  basis.setZero();
  for (int i = 0; i < kRingPoints; ++i) {
    basis(i, i) = 4.0 / 6.0;
    basis(i, (i + 1) % kRingPoints) = basis(i, (i + kRingPoints - 1) % kRingPoints) = 1.0 / 6.0;
  }
  const Section control = basis.inverse() * points;
  constexpr int kSamples = 16;  // a span's chords fall short of its arc by less than 1e-4
  double length = 0.0;
  Eigen::RowVector2d last = points.row(0);
  for (int i = 0; i < kRingPoints; ++i) {
    for (int s = 1; s <= kSamples; ++s) {
      const double t = s / static_cast<double>(kSamples), u = 1.0 - t;
      const Eigen::RowVector2d p =
          (u * u * u * control.row((i + kRingPoints - 1) % kRingPoints) +
           (3 * t * t * t - 6 * t * t + 4) * control.row(i) +
           (3 * u * u * u - 6 * u * u + 4) * control.row((i + 1) % kRingPoints) +
           t * t * t * control.row((i + 2) % kRingPoints)) /
          6.0;
      length += (p - last).norm();
      last = p;
    }
  }
  return length;
}

Section SectionOfGirth(const SectionShape& shape, double first_deg, double step_deg,
                       double girth_m) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  Section points;
  for (int k = 0; k < kRingPoints; ++k) {
    const double angle = kDegree * (first_deg + step_deg * k);
    points.row(k) << shape.width * shape.radii[k] * std::cos(angle),
        shape.depth * shape.radii[k] * std::sin(angle);
  }
  return points * (girth_m / GirthOf(points));
}

double At(const Girth& girth, double girth_score) {
  return girth.mean_m * Growth(girth, girth_score);
}
Girth Scaled(const Girth& girth, double factor) {
  return {factor * girth.mean_m, factor * girth.deviation_m};
}
Girth Between(const Girth& a, const Girth& b, double share_of_b) {
  return {(1.0 - share_of_b) * a.mean_m + share_of_b * b.mean_m,
          (1.0 - share_of_b) * a.deviation_m + share_of_b * b.deviation_m};
}

}  // namespace vitruvia::mannequin
