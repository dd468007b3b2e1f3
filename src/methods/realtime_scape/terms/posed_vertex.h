// A posed vertex and its derivatives with respect to the unknowns.
#pragma once

#include "methods/realtime_scape/model.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

// The increment (r, t) of bone j with weight w moves the vertex by w (r × arm_j + t), where arm_j =
// R_j (v̄ − c̄_j) is the vertex moved by this bone alone, relative to the bone's centre.
class PosedVertex {
 public:
  PosedVertex(const Model& model, const BodyPose& pose, int vertex)
      : influences_(model.InfluencesOf(vertex)) {
    const Vector3d rest = model.rest_vertices[vertex].cast<double>();
    for (std::size_t k = 0; k < influences_.size(); ++k) {
      const auto [bone, w] = influences_[k];
      arms_[k] = pose[bone].rotation * (rest - model.rest_centers[bone]);
      position_ += double{w} * (arms_[k] + pose[bone].center);
    }
  }

  const Vector3d& position() const { return position_; }

  // direction · (vertex − target), a length, as one row.
  void AddRow(const Vector3d& direction, double residual_m, double weight, double per_unit,
              BlockNormalEquations& equations) const {
    std::array<BlockNormalEquations::Entry, kMaxInfluences> entries;
    for (std::size_t k = 0; k < influences_.size(); ++k) {
      const auto [bone, w] = influences_[k];
      entries[k].block = bone;
      entries[k].jacobian << double{w} * per_unit * arms_[k].cross(direction),
          double{w} * direction;
    }
    equations.AddRow({entries.data(), influences_.size()}, residual_m * per_unit, weight);
  }

 private:
  std::span<const Influence> influences_;
  std::array<Vector3d, kMaxInfluences> arms_;
  Vector3d position_ = Vector3d::Zero();
};

}  // namespace vitruvia::realtime_scape
