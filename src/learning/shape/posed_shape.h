// A shape of the space in a pose near the T-pose, and the derivatives of its surface with respect
// to all parameters.
//
// x_i = Σ_j w_ij (R_j (v̄_i(θ) − c_j(θ)) + p_j), where c_j are the joints regressed from θ, p_j the
// posed joints down the chain: p_j = p_parent + R_parent (c_j − c_parent), p_pelvis a parameter.
#pragma once

#include "learning/shape/shape_space.h"

namespace vitruvia {

class PosedShape {
 public:
  struct Parameters {
    Eigen::VectorXd theta;
    std::array<Matrix3<double>, kBoneCount> local_rotations;  // parent_from_bone; pelvis: scan_from
    Vector3d pelvis_position = Vector3d::Zero();              // scan frame
  };

  // The space must outlive this. `components`: number of coefficients of θ.
  PosedShape(const ShapeSpace& space, int components);

  // θ, then the pelvis' position, then a rotation vector for each bone.
  int parameter_count() const { return components_ + 3 + 3 * kBoneCount; }
  int rotation_index(int bone) const { return components_ + 3 + 3 * bone; }

  // The mean shape in the T-pose, with the pelvis at its position in the space's centred frame.
  Parameters Start() const;

  // Moves the parameters by a step: θ and position add up; bone b and all below it turn by the
  // rotation vector, given in the scan frame, about the bone's posed joint.
  Parameters Stepped(const Parameters& parameters, const Eigen::VectorXd& step) const;

  void Set(const Parameters& parameters);
  const std::vector<Vector3f>& vertices() const { return vertices_; }  // scan frame

  // For each bone, the gradient of ½ |Log(R_local)|² with respect to the rotation vector of a step:
  // P Log(R_local), P the rotation scan_from_parent, because a step's vector is in the scan frame
  // and Log(R_local) in the parent's.
  static std::array<Vector3d, kBoneCount> BendGradients(const Parameters& parameters);

  // d(n · x_i)/d(parameters) at the parameters last set: parameter_count() floats.
  void Row(std::size_t vertex, const Vector3f& n, float* row) const;

 private:
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  const ShapeSpace& space_;
  int components_;
  RowMajor basis_;                                     // 3V × K, a vertex's three rows together
  std::array<Matrix3<double>, kBoneCount> rotations_;  // scan_from_bone
  std::array<Vector3f, kBoneCount> joints_, posed_joints_;
  std::array<Matrix3<float>, kBoneCount> float_rotations_;
  std::array<Eigen::Matrix<float, 3, Eigen::Dynamic>, kBoneCount> offsets_;  // d(p_j − R_j c_j)/dθ
  std::vector<Vector3f> rest_, vertices_;
};

}  // namespace vitruvia
