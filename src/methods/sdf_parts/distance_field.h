// The signed distance from a closed surface, on a grid.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace vitruvia::sdf_parts {

class DistanceField {
 public:
  // The grid covers the mesh and margin_m round it. Near the surface distances are exact at the
  // grid's nodes; elsewhere they are those from the nearest surface points of nodes near it.
  DistanceField(const TriangleMesh& closed, double cell_m, double margin_m);

  struct Sample {
    float distance_m;   // negative inside
    Vector3f gradient;  // of the trilinear interpolation: approximately of unit length
  };
  bool Covers(const Vector3f& x) const {
    const Vector3f cell = (x - origin_) * inverse_cell_;
    return (cell.array() >= 0.0f).all() && (cell.array() < last_.array()).all();
  }
  // Trilinear. The grid must cover x.
  Sample At(const Vector3f& x) const;
  float DistanceAt(const Vector3f& x) const;

 private:
  struct Builder;
  struct Cell;

  std::size_t Index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * size_[1] + j) * size_[0] + i;
  }

  Vector3f origin_, last_;  // the first node's place; the last node's number along each axis
  float inverse_cell_;
  std::array<int, 3> size_{};  // nodes
  std::vector<float> values_;
};

}  // namespace vitruvia::sdf_parts
