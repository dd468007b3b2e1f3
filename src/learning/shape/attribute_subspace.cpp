#include "learning/shape/attribute_subspace.h"

#include <algorithm>

#include <Eigen/QR>

#include "core/error.h"

namespace vitruvia {
namespace {

constexpr int kMaxCorrections = 20;
constexpr double kHeightTolerance_m = 1e-5, kWeightTolerance_kg = 1e-3;

}  // namespace

Eigen::Vector2d MeasuredAttributes(const ShapeSpace& space, const Eigen::VectorXd& theta, Sex sex) {
  const TriangleMesh mesh{Shape(space, theta), space.reference.rest.triangles};
  const auto [lowest, highest] =
      std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                          [](const Vector3f& a, const Vector3f& b) { return a.y() < b.y(); });
  return {highest->y() - lowest->y(), EnclosedVolume(mesh) * space.density_kg_m3[SexIndex(sex)]};
}

AttributeSubspace::AttributeSubspace(const ShapeSpace& space, int components) : space_(space) {
  Require(components > kAttributeCount && components <= space.components(),
          "AttributeSubspace: {} components, expected {} … {}", components, kAttributeCount + 1,
          space.components());
  const Eigen::MatrixXd basis = space.attribute_basis.leftCols(components);
  directions_ = basis.completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::MatrixXd q = basis.transpose().householderQr().householderQ();
  orthogonal_ = q.rightCols(components - kAttributeCount);
}

Eigen::VectorXd AttributeSubspace::Nearest(const BodyAttributes& attributes) const {
  return directions_ * (AttributeVector(attributes) - space_.attribute_mean);
}

double AttributeSubspace::Deviation(const BodyAttributes& attributes) const {
  return Nearest(attributes).norm();  // the least-norm θ: Mahalanobis distance, θ being whitened
}

Eigen::VectorXd AttributeSubspace::Corrected(Eigen::VectorXd theta,
                                             const BodyAttributes& attributes) const {
  for (int step = 0; step < kMaxCorrections; ++step) {
    const Eigen::Vector2d measured = MeasuredAttributes(space_, theta, attributes.sex);
    const double height_left_m = attributes.height_m - measured[0];
    const double weight_left_kg = attributes.weight_kg - measured[1];
    if (std::abs(height_left_m) < kHeightTolerance_m &&
        std::abs(weight_left_kg) < kWeightTolerance_kg) {
      break;
    }
    theta += directions_ * Eigen::Vector3d(height_left_m, weight_left_kg, 0.0);
  }
  return theta;
}

}  // namespace vitruvia
