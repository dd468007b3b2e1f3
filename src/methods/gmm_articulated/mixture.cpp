#include "methods/gmm_articulated/mixture.h"

#include <array>
#include <cmath>
#include <numbers>

#include "math/lanes.h"

namespace vitruvia::gmm_articulated {
namespace {

using Lanes = Eigen::Array<float, kLanes, 1>;

// Calls use(kernel, at, count) for the points near a place, a register at a time: kernel holds
// exp(−d²/2σ²), 0 beyond the reach and beyond count; `at` is the first point's place in the grid.
struct Kernel {
  float half_precision;  // 1/2σ²
  float squared_reach_m2;

  template <class Use>
  void ForAllNear(const PointGrid& grid, const Vector3f& place, const Use& use) const {
    grid.ForRunsNear(place, [&](int begin, int end) {
      for (int at = begin; at < end; at += kLanes) {
        const int count = std::min(kLanes, end - at);
        Lanes squared = Lanes::Constant(squared_reach_m2);
        for (int k = 0; k < count; ++k) {
          const float dx = grid.x()[at + k] - place.x(), dy = grid.y()[at + k] - place.y(),
                      dz = grid.z()[at + k] - place.z();
          squared[k] = dx * dx + dy * dy + dz * dz;
        }
        if (!(squared < squared_reach_m2).any()) continue;
        const Lanes kernel =
            (squared < squared_reach_m2).select((-half_precision * squared).exp(), 0.0f);
        use(kernel, squared, at, count);
      }
    });
  }
};

Kernel KernelOf(double sigma_m, double reach_m) {
  return {static_cast<float>(0.5 / (sigma_m * sigma_m)), static_cast<float>(reach_m * reach_m)};
}

}  // namespace

void Mixture::Expect(const std::vector<Vector3f>& data, const std::vector<Vector3f>& vertices,
                     double sigma_m, const MixtureSettings& settings, WorkerTeam& team) {
  const double reach_m = settings.reach_sigmas * sigma_m, u = settings.outlier_share;
  outlier_ =
      static_cast<float>(std::pow(2.0 * std::numbers::pi * sigma_m * sigma_m, 1.5) * u *
                         static_cast<double>(vertices.size()) / ((1.0 - u) * settings.volume_m3));
  data_grid_.Build(data, static_cast<float>(reach_m));
  vertex_grid_.Build(vertices, static_cast<float>(reach_m));
  SumOverVertices(data, sigma_m, reach_m, team);
  SumOverData(vertices, sigma_m, reach_m, team);
  mass_ = 0.0;
  for (const VertexShare& share : shares_) mass_ += double{share.mass};
}

void Mixture::SumOverVertices(const std::vector<Vector3f>& data, double sigma_m, double reach_m,
                              WorkerTeam& team) {
  const Kernel kernel = KernelOf(sigma_m, reach_m);
  sums_.resize(data.size());
  team.For(static_cast<int>(data.size()), [&](int begin, int end) {
    for (int n = begin; n < end; ++n) {
      Lanes sum = Lanes::Zero();
      kernel.ForAllNear(vertex_grid_, data[n],
                        [&](const Lanes& e, const Lanes&, int, int) { sum += e; });
      sums_[n] = sum.sum();
    }
  });
}

void Mixture::SumOverData(const std::vector<Vector3f>& vertices, double sigma_m, double reach_m,
                          WorkerTeam& team) {
  const Kernel kernel = KernelOf(sigma_m, reach_m);
  shares_.resize(vertices.size());
  team.For(static_cast<int>(vertices.size()), [&](int begin, int end) {
    for (int m = begin; m < end; ++m) {
      const Vector3f& v = vertices[m];
      float mass = 0.0f, squares = 0.0f;
      Vector3f moment = Vector3f::Zero();
      kernel.ForAllNear(
          data_grid_, v, [&](const Lanes& e, const Lanes& squared, int at, int count) {
            for (int k = 0; k < count; ++k) {
              if (e[k] == 0.0f) continue;
              const float p = e[k] / (sums_[data_grid_.indices()[at + k]] + outlier_);
              mass += p;
              squares += p * squared[k];
              moment += p * Vector3f(data_grid_.x()[at + k] - v.x(), data_grid_.y()[at + k] - v.y(),
                                     data_grid_.z()[at + k] - v.z());
            }
          });
      VertexShare& share = shares_[m];
      share = {};
      if (!(mass > 0.0f)) continue;
      share.mass = mass;
      share.offset = moment / mass;
      share.spread_m2 = std::max(0.0f, squares / mass - share.offset.squaredNorm());
    }
  });
}

std::vector<float> Mixture::Explained() const {
  std::vector<float> explained;
  for (const float sum : sums_) explained.push_back(sum / (sum + outlier_));
  return explained;
}

double Mixture::Variance(const std::vector<Vector3f>& moves) const {
  double sum = 0.0;
  for (std::size_t m = 0; m < shares_.size(); ++m) {
    const VertexShare& share = shares_[m];
    sum += double{share.mass} * double{share.spread_m2 + (share.offset - moves[m]).squaredNorm()};
  }
  return sum / (3.0 * mass_);
}

}  // namespace vitruvia::gmm_articulated
