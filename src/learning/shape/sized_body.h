// The body of a person of whom no more is known than some of height, weight and sex: the most
// probable shape of the space, scaled where the space has nobody of that size.
#pragma once

#include <optional>

#include "learning/shape/shape_space.h"

namespace vitruvia {

struct KnownAttributes {
  std::optional<double> height_m, weight_kg;
  std::optional<Sex> sex;
};

// A shape of the space, and a uniform scale of all its lengths.
struct SizedShape {
  Eigen::VectorXd theta;
  double scale = 1.0;
};

// Of the first `components` coefficients the least ones (in standard deviations) whose regressed
// attributes are the known ones, shrunk to `most_unusual` deviations if they are more. Then the
// scale gives the known height as measured on the surface, and θ is corrected until a known weight
// is reached within `most_unusual`. Without any attribute: the mean.
SizedShape ShapeOfSize(const ShapeSpace& space, const KnownAttributes& known, int components,
                       double most_unusual);

// PlacedBody(), scaled; without a known sex with a man's density.
BodyModel SizedBody(const ShapeSpace& space, const SizedShape& shape, std::optional<Sex> sex);

}  // namespace vitruvia
