// SCAPE's mesh solve (paper A, eq. 1; Anguelov et al. 2005): the surface whose triangles best match
// given deformations of a template's triangles.
//
// For triangle k with edges e_kn = v_kn − v_k1 (n = 2, 3) of the template it minimises
// Σ_k Σ_n ‖Q_k Θ_k e_kn − (v_kn − v_k1)‖². The system's matrix depends on the topology alone: it is
// factorised once. A surface's position is not determined by its edges; all surfaces here have
// their vertices' mean at the origin unless said otherwise.
#pragma once

#include <memory>
#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

class ScapeMesh {
 public:
  // DataError if the mesh is not connected or has degenerate triangles.
  explicit ScapeMesh(const TriangleMesh& rest);
  ~ScapeMesh();

  std::size_t triangle_count() const;

  // One Q and one Θ per triangle; the vertices' mean is the template's. With identities the result
  // is the template.
  std::vector<Vector3d> Solve(const std::vector<Matrix3<double>>& pose,
                              const std::vector<Matrix3<double>>& shape) const;

  // 3V × N from 9T × N: each column holds the triangles' deformations D_k = Q_k Θ_k one after the
  // other, column by column. Linear in D.
  Eigen::MatrixXd Integrate(const Eigen::Ref<const Eigen::MatrixXf>& deformations) const;

  // The deformations of a surface of the same topology: 9T. The edges do not determine D_k along
  // the triangle's normal; there D_k scales by the square root of the triangle's area (Sumner &
  // Popović 2004), which does not affect Solve.
  Eigen::VectorXf Deformations(const std::vector<Vector3f>& vertices) const;

 private:
  struct Factorization;
  std::unique_ptr<Factorization> factorization_;
};

}  // namespace vitruvia
