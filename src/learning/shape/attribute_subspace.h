// The subspace of shapes with given height, weight and sex (paper A, sec. 5, after Guan et al.
// 2009).
//
// The attributes' directions are learnt by regression on the database's people. Moving along them
// reaches given attributes; moving in the subspace orthogonal to them keeps the regressed
// attributes. Because volume is not linear in the shape, height and weight are then corrected along
// their directions until the values measured on the surface are the given ones.
#pragma once

#include "learning/shape/shape_space.h"

namespace vitruvia {

// Height (m) and weight (kg) of a shape, measured on its surface.
Eigen::Vector2d MeasuredAttributes(const ShapeSpace& space, const Eigen::VectorXd& theta, Sex sex);

class AttributeSubspace {
 public:
  AttributeSubspace(const ShapeSpace& space, int components);

  // The shape nearest to the mean whose regressed attributes are these.
  Eigen::VectorXd Nearest(const BodyAttributes& attributes) const;
  // How unusual attributes are for the database: standard deviations from its mean.
  double Deviation(const BodyAttributes& attributes) const;
  // θ moved along the attributes' directions until height and weight as measured are the given
  // ones.
  Eigen::VectorXd Corrected(Eigen::VectorXd theta, const BodyAttributes& attributes) const;
  // K × (K − 3), orthonormal: directions in which no regressed attribute changes.
  const Eigen::MatrixXd& orthogonal() const { return orthogonal_; }

 private:
  const ShapeSpace& space_;
  Eigen::MatrixXd directions_;  // K × 3: the shortest step for one unit of each attribute
  Eigen::MatrixXd orthogonal_;
};

}  // namespace vitruvia
