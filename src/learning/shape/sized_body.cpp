#include "learning/shape/sized_body.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "core/error.h"
#include "learning/shape/attribute_subspace.h"

namespace vitruvia {
namespace {

constexpr int kCorrections = 20;

// Values and directions of the attributes that are known, of those that vary in the space.
struct KnownRows {
  Eigen::MatrixXd directions;  // N × K, per standard deviation
  Eigen::VectorXd wanted;      // N, against the mean
};

KnownRows RowsOf(const ShapeSpace& space, const KnownAttributes& known, int components) {
  std::vector<std::pair<int, double>> values;
  if (known.height_m) values.emplace_back(0, *known.height_m);
  if (known.weight_kg) values.emplace_back(1, *known.weight_kg);
  if (known.sex) values.emplace_back(2, *known.sex == Sex::kMale ? 1.0 : 0.0);
  KnownRows rows;
  const auto count = static_cast<Eigen::Index>(values.size());
  rows.directions.resize(count, components);
  rows.wanted.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto [attribute, value] = values[static_cast<std::size_t>(i)];
    rows.directions.row(i) = space.attribute_basis.row(attribute).head(components);
    rows.wanted[i] = value - space.attribute_mean[attribute];
  }
  return rows;
}

Eigen::VectorXd Shrunk(const Eigen::VectorXd& theta, double longest) {
  const double norm = theta.norm();
  return norm > longest ? Eigen::VectorXd(theta * (longest / norm)) : theta;
}

}  // namespace

SizedShape ShapeOfSize(const ShapeSpace& space, const KnownAttributes& known, int components,
                       double most_unusual) {
  Require(components <= space.components(), "ShapeOfSize: {} components of {}", components,
          space.components());
  const Sex sex = known.sex.value_or(Sex::kMale);
  SizedShape shape{Eigen::VectorXd::Zero(components), 1.0};
  const KnownRows rows = RowsOf(space, known, components);
  if (rows.wanted.size() == 0 || components == 0) return shape;
  const Eigen::MatrixXd steps = rows.directions.completeOrthogonalDecomposition().pseudoInverse();
  shape.theta = Shrunk(steps * rows.wanted, most_unusual);
  const Eigen::VectorXd heavier =
      space.attribute_basis.row(1).head(components).transpose() /
      std::max(1e-12, space.attribute_basis.row(1).head(components).squaredNorm());
  for (int i = 0; i < kCorrections; ++i) {
    const Eigen::Vector2d measured = MeasuredAttributes(space, shape.theta, sex);
    if (known.height_m) shape.scale = *known.height_m / measured[0];
    if (!known.weight_kg) break;
    const double volume_scale = std::pow(shape.scale, 3);
    const double left_kg = *known.weight_kg / volume_scale - measured[1];
    shape.theta = Shrunk(shape.theta + left_kg * heavier, most_unusual);
  }
  return shape;
}

BodyModel SizedBody(const ShapeSpace& space, const SizedShape& shape, std::optional<Sex> sex) {
  BodyModel body = PlacedBody(space, shape.theta, sex.value_or(Sex::kMale));
  const auto scale = static_cast<float>(shape.scale);
  for (Vector3f& v : body.rest.vertices) v *= scale;
  for (int b = 0; b < kBoneCount; ++b) {
    body.skeleton.joints[b] *= shape.scale;
    body.skeleton.tips[b] *= shape.scale;
  }
  body.attributes.height_m *= shape.scale;
  body.attributes.weight_kg *= std::pow(shape.scale, 3);
  return body;
}

}  // namespace vitruvia
