// Term 2, joints stay connected (paper A, eq. 7; Chang & Zwicker 2009).
#pragma once

#include <vector>

#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/settings.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

// For neighbouring bones j and l: Σ_i w_ij w_il / τ_jl ‖(R_j v̄_i + T_j) − (R_l v̄_i + T_l)‖².
//
// The sum over a joint's vertices is a quadratic in (R, T) whose 4×4 moment Σ_i w_ij w_il ṽ_i ṽ_iᵀ
// is a constant of the rest pose. Its eigenvectors give four virtual points (x, h) with exactly the
// same energy, so the exact term costs as much as four vertices instead of hundreds. The paper's
// count of 3 rows per joint suggests another reading: only the vertices' weighted mean, about which
// the joint rotates freely.
//
// Readings: τ_jl = Σ_i w_ij w_il over vertices (the paper prints a sum over bones), so each joint's
// weights sum to 1; each joint counts once; joints are the edges of the bone tree. If the bones of
// an edge share no vertex, its joint position is used.
//
// Departure (default): the joint's position in the skeleton instead of the mean of its vertices.
// The mean may lie 3 cm from the joint; a limb that swings by 70 degrees about its joint then
// separates from the mean by a similar distance.
class JointTerm {
 public:
  JointTerm(const Model& model, JointRows rows);

  // Adds α₁ times the term, lengths in units of length_unit_m.
  void Add(const Model& model, const BodyPose& pose, double weight, double length_unit_m,
           BlockNormalEquations& equations) const;

 private:
  struct VirtualPoint {
    int bone, parent;
    Vector3d x;  // Σ of rest positions, scaled by the square root of the eigenvalue
    double h;    // homogeneous coordinate, scaled likewise
  };
  std::vector<VirtualPoint> points_;
};

}  // namespace vitruvia::realtime_scape
