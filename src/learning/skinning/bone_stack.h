// The transforms of all bones in all poses, and the moments of the vertices that their fit needs.
#pragma once

#include <Eigen/Core>

#include "body/skeleton.h"

namespace vitruvia::skinning {

// The transforms posed_from_rest of B bones in P poses, stacked: rows 4j … 4j + 3 belong to bone j,
// columns 3p … 3p + 2 to pose p, and that block is [R | T]ᵀ. A vertex with rest point (x, y, z, 1)
// and weights w lies at Σ_j w_j (x, y, z, 1) · block_j.
using BoneStack = Eigen::MatrixXd;

inline int BoneCount(const BoneStack& stack) { return static_cast<int>(stack.rows() / 4); }
inline int PoseCount(const BoneStack& stack) { return static_cast<int>(stack.cols() / 3); }

// With u_i the vector of all w_ij (x, y, z, 1) of vertex i (4B long) and e_i its residual, observed
// less modelled position (3P long). They determine the energy as a function of the transforms
// alone: after a change D of the stack it is energy − 2 ⟨cross, D⟩ + ⟨D, second D⟩.
struct SkinMoments {
  Eigen::MatrixXd second;  // Σ u uᵀ, 4B × 4B
  Eigen::MatrixXd cross;   // Σ u eᵀ, 4B × 3P
  double energy = 0.0;     // Σ |e|², m²

  SkinMoments(int bones, int poses) : second(4 * bones, 4 * bones), cross(4 * bones, 3 * poses) {
    SetZero();
  }
  void SetZero() {
    second.setZero();
    cross.setZero();
    energy = 0.0;
  }
};

}  // namespace vitruvia::skinning
