// The shape step (paper B, sec. 4.3, eq. 9): a warp ω_i for every vertex.
//
//   Σ_i { r_i² + λ_d ‖ω_i‖² + λ_s Σ_{j∈N(i)} ‖ω_i − ω_j‖² }
//
// Each vertex is solved separately with its neighbours fixed (Jacobi): with g_i = R_iᵀ n_i,
//   A_i = g_i g_iᵀ + α I,  α = λ_d + λ_s |N|,
//   h_i = g_i r_i + λ_d ω_i + λ_s Σ_j (ω_i − ω_j),
//   ω_i ← ω_i − A_i⁻¹ h_i,  A_i⁻¹ h = (h − g (g·h) / (α + g·g)) / α  (Sherman & Morrison 1950).
// A vertex without a paired point has no r_i: g_i = 0. Then ω_i becomes the mean of its neighbours'
// warps shrunk towards 0, so warps do not grow where data are missing.
#pragma once

#include <vector>

#include "core/worker_team.h"
#include "methods/dynamic/association.h"
#include "methods/dynamic/rest_mesh.h"
#include "methods/dynamic/surface.h"

namespace vitruvia::dynamic {

struct ShapeWeights {
  float magnitude = 0.01f;  // λ_d
  float neighbors = 0.2f;   // λ_s
};

// The three sums of eq. 9, weighted.
struct ShapeEnergy {
  double data = 0.0;        // Σ r_i²
  double magnitude = 0.0;   // λ_d Σ ‖ω_i‖²
  double smoothness = 0.0;  // λ_s Σ_i Σ_{j∈N(i)} ‖ω_i − ω_j‖²

  double Total() const { return data + magnitude + smoothness; }
};

// A⁻¹ h as above.
template <class Scalar>
[[gnu::always_inline]] inline Vector3<Scalar> SolveWarp(const Vector3<Scalar>& g,
                                                        const Vector3<Scalar>& h, Scalar alpha) {
  return (h - g * (g.dot(h) / (alpha + g.dot(g)))) / alpha;
}

class ShapeStep {
 public:
  ShapeStep(const SurfaceLayout& layout, const std::vector<Vector3f>& rest_vertices,
            const NeighborTable& neighbors);

  // One iteration for all vertices from the observations of the posed surface; moves
  // surface.rest to v̄ + ω. Returns the energy before the step. The same for any number of threads.
  ShapeEnergy Iterate(const Observations<float>& observations, const ShapeWeights& weights,
                      WorkerTeam& team, Surface<float>& surface);

  Vector3f WarpOf(int slot) const { return warps_[slot].head<3>(); }

 private:
  using Warp = Eigen::Vector4f;  // the fourth is 0: a neighbour is one load
  ShapeEnergy IterateRange(int begin, int end, const Observations<float>& observations,
                           const ShapeWeights& weights, Surface<float>& surface);

  std::vector<Warp> warps_, next_warps_;  // per slot; read and written
  std::vector<Warp> rest_;                // v̄
  NeighborTable neighbors_;               // of slots
  std::vector<ShapeEnergy> energies_;     // per range
};

}  // namespace vitruvia::dynamic
