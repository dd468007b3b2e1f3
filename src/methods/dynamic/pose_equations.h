// The normal equations of the pose step (paper B, sec. 4.2, eqs. 7 and 8).
//
// ∂r_i/∂θ = n_iᵀ ∂v_i/∂b_i ∂b_i/∂T ∂T/∂θ is evaluated in two parts. A change of link k is a twist
// (φ, τ), T_k ← (1 + ½(φ + ε τ)) T_k, so a vertex contributes one row of 6 numbers for each of its
// at most four links. JᵀJ and Jᵀr are summed over these rows, 6 unknowns for each bone, and then
// reduced to the joints by S, which holds the joints' twists: J = J_links S. The cost of a vertex
// does not depend on the number of joints.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/dynamic/association.h"
#include "methods/dynamic/surface.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::dynamic {

inline constexpr int kTwistSize = kBlockSize;
inline constexpr int kLinkUnknowns = kTwistSize * kBoneCount;

struct PoseEquations {
  Eigen::MatrixXd hessian;                 // JᵀJ, joints × joints
  Eigen::VectorXd gradient;                // Jᵀr
  double energy = 0.0;                     // Σ r²
  int residuals = 0;                       // number of vertices that are paired with a point
  std::array<int, kBoneCount> observed{};  // number of these vertices by the bone of their largest
                                           // weight
};

// The bones' motions as the equations need them: about the twists' origin instead of the camera's.
template <class Scalar>
struct LinkMotions {
  Vector3<Scalar> origin;                // camera frame
  BoneMotions<Scalar> origin_from_rest;  // Translation(−origin) camera_from_rest
};
template <class Scalar>
LinkMotions<Scalar> LinkMotionsOf(const TreePose& pose);

template <class Scalar>
class LinkEquations {
 public:
  explicit LinkEquations(const SurfaceLayout& layout);

  // r_i = n_iᵀ (v_i − p̄_i) (eq. 6) of the observed vertices of one patch. Patches may be added on
  // different threads.
  void AddPatch(int patch, const Surface<Scalar>& surface, const LinkMotions<Scalar>& motions,
                const Observations<Scalar>& observations);
  // Adds up all patches, in order, and reduces the sums to the joints.
  void ReduceToJoints(const SurfaceLayout& layout, const KinematicTree& tree, const TreePose& pose,
                      PoseEquations& equations);

 private:
  struct PatchSums {
    RowSums rows;  // of the patch's bones in its order
    int residuals = 0;
  };
  template <int N>
  void AddLanes(const Patch& patch, const Surface<Scalar>& surface,
                const LinkMotions<Scalar>& motions, const Observations<Scalar>& observations,
                PatchSums& sums) const;

  std::vector<PatchSums> sums_;
  BlockNormalEquations links_;
  Eigen::MatrixXd twists_;          // S: kLinkUnknowns × joints
  Eigen::MatrixXd hessian_twists_;  // JᵀJ of the links, times S
};

}  // namespace vitruvia::dynamic
