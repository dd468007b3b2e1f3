// The body of a person of whom only some of height, weight and sex are known: the most probable
// shape of the space, scaled if the space does not contain that size.
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

// The first `components` coefficients of least norm (in standard deviations) whose regressed
// attributes are the known ones, shrunk to `most_unusual` standard deviations if they exceed it.
// Then the scale is set so that the height measured on the surface is the known one, and θ is
// corrected to reach a known weight within `most_unusual`. Without any attribute: the mean.
SizedShape ShapeOfSize(const ShapeSpace& space, const KnownAttributes& known, int components,
                       double most_unusual);

// PlacedBody(), scaled; with a man's density if the sex is not known.
BodyModel SizedBody(const ShapeSpace& space, const SizedShape& shape, std::optional<Sex> sex);

}  // namespace vitruvia
