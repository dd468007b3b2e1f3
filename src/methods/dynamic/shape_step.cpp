#include "methods/dynamic/shape_step.h"

namespace vitruvia::dynamic {
namespace {

constexpr int kShapeSlotsPerRange = 1024;

}  // namespace

ShapeStep::ShapeStep(const SurfaceLayout& layout, const std::vector<Vector3f>& rest_vertices,
                     const NeighborTable& neighbors)
    : warps_(layout.slot_count(), Warp::Zero()),
      next_warps_(layout.slot_count(), Warp::Zero()),
      rest_(layout.slot_count(), Warp::Zero()),
      neighbors_(layout.slot_count()),
      energies_((layout.slot_count() + kShapeSlotsPerRange - 1) / kShapeSlotsPerRange) {
  for (int slot = 0; slot < layout.slot_count(); ++slot) {
    neighbors_[slot].fill(-1);
    const int vertex = layout.vertex_of_slot[slot];
    if (vertex < 0) continue;
    rest_[slot].head<3>() = rest_vertices[vertex];
    for (int k = 0; k < kNeighbors; ++k) {
      const int other = neighbors[vertex][k];
      if (other >= 0) neighbors_[slot][k] = layout.slot_of_vertex[other];
    }
  }
}

ShapeEnergy ShapeStep::Iterate(const Observations<float>& observations, const ShapeWeights& weights,
                               WorkerTeam& team, Surface<float>& surface) {
  team.For(static_cast<int>(warps_.size()), kShapeSlotsPerRange, [&](int begin, int end) {
    energies_[begin / kShapeSlotsPerRange] =
        IterateRange(begin, end, observations, weights, surface);
  });
  warps_.swap(next_warps_);
  ShapeEnergy sum;
  for (const ShapeEnergy& range : energies_) {
    sum.data += range.data;
    sum.magnitude += range.magnitude;
    sum.smoothness += range.smoothness;
  }
  return sum;
}

ShapeEnergy ShapeStep::IterateRange(int begin, int end, const Observations<float>& observations,
                                    const ShapeWeights& weights, Surface<float>& surface) {
  ShapeEnergy energy;
  for (int slot = begin; slot < end; ++slot) {
    if (surface.layout.vertex_of_slot[slot] < 0) continue;
    const Warp& warp = warps_[slot];
    Warp apart = Warp::Zero();  // Σ_j (ω_i − ω_j)
    float apart_squared = 0.0f;
    int neighbors = 0;
    for (const int other : neighbors_[slot]) {
      if (other < 0) continue;
      const Warp difference = warp - warps_[other];
      apart += difference;
      apart_squared += difference.squaredNorm();
      ++neighbors;
    }
    Warp h = weights.magnitude * warp + weights.neighbors * apart;
    Vector3f g = Vector3f::Zero();
    float residual = 0.0f;
    if (observations.IsObserved(slot)) {
      residual =
          surface.normals.At(slot).dot(surface.posed.At(slot) - observations.Mean(slot));  // eq. 6
      g = surface.rest_normals.At(slot);  // R_iᵀ n_i: the normal was turned by R_i
      h.head<3>() += residual * g;
    }
    const float alpha = weights.magnitude + weights.neighbors * static_cast<float>(neighbors);
    Warp& next = next_warps_[slot];
    next.head<3>() = warp.head<3>() - SolveWarp<float>(g, h.head<3>(), alpha);
    surface.rest.Set(slot, rest_[slot].head<3>() + next.head<3>());
    energy.data += residual * residual;
    energy.magnitude += weights.magnitude * warp.squaredNorm();
    energy.smoothness += weights.neighbors * apart_squared;
  }
  return energy;
}

}  // namespace vitruvia::dynamic
