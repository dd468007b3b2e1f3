// The mixture of Ye & Yang 2014 and its E-step: every model vertex is the centre of a Gaussian of
// the same width, and a uniform component explains outliers.
//
//   p(x) = (1 − u) Σ_m (1/M) N(x; v_m, σ²I) + u / V
#pragma once

#include <vector>

#include "core/worker_team.h"
#include "methods/gmm_articulated/point_grid.h"

namespace vitruvia::gmm_articulated {

struct MixtureSettings {
  double outlier_share = 0.05;  // u
  double volume_m3 = 1.0;       // V
  double reach_sigmas = 3.0;    // truncation radius of the Gaussians
};

// Statistics of the data assigned to one vertex.
struct VertexShare {
  float mass = 0.0f;                   // p_m = Σ_n p_mn
  Vector3f offset = Vector3f::Zero();  // x̄_m − v_m
  float spread_m2 = 0.0f;              // Σ_n p_mn ‖x_n − x̄_m‖² / p_m
};

class Mixture {
 public:
  // p_mn for these data and vertices. Pairs beyond the reach count as 0.
  void Expect(const std::vector<Vector3f>& data, const std::vector<Vector3f>& vertices,
              double sigma_m, const MixtureSettings& settings, WorkerTeam& team);

  const std::vector<VertexShare>& shares() const { return shares_; }  // of each vertex
  double mass() const { return mass_; }                               // P = Σ p_m
  // Σ_m p_mn of each datum; the rest to 1 belongs to the uniform component.
  std::vector<float> Explained() const;
  // σ² that maximises the expected likelihood once each vertex has moved by moves[m]:
  // Σ_m p_m (spread_m + ‖offset_m − move_m‖²) / 3P. Some vertex must have mass.
  double Variance(const std::vector<Vector3f>& moves) const;

 private:
  void SumOverVertices(const std::vector<Vector3f>& data, double sigma_m, double reach_m,
                       WorkerTeam& team);
  void SumOverData(const std::vector<Vector3f>& vertices, double sigma_m, double reach_m,
                   WorkerTeam& team);

  PointGrid data_grid_, vertex_grid_;
  std::vector<float> sums_;  // Σ_m exp(−d²/2σ²), of each datum
  float outlier_ = 0.0f;     // c: the uniform component in the same units
  std::vector<VertexShare> shares_;
  double mass_ = 0.0;
};

}  // namespace vitruvia::gmm_articulated
