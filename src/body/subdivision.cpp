#include "body/subdivision.h"

#include <fmt/format.h>

#include "core/error.h"
#include "geometry/half_edges.h"

namespace vitruvia {
namespace {

constexpr int kCorners = 4;

int Next(int half_edge) { return half_edge % kCorners < 3 ? half_edge + 1 : half_edge - 3; }
int Previous(int half_edge) { return half_edge % kCorners > 0 ? half_edge - 1 : half_edge + 3; }

// New vertices: one for each old vertex, then each edge, then each face. Weights are summed in
// double and rounded once, so that a row of floats sums to 1 as nearly as floats can.
class Rule {
 public:
  Rule(const std::vector<Quad>& quads, int vertex_count, const HalfEdges& half_edges)
      : quads_(quads), vertex_count_(vertex_count), half_edges_(half_edges) {}

  int EdgePoint(int half_edge) const { return vertex_count_ + half_edges_.edge[half_edge]; }
  int FacePoint(int face) const { return vertex_count_ + half_edges_.edge_count + face; }
  int new_vertex_count() const { return FacePoint(static_cast<int>(quads_.size())); }

  Eigen::SparseMatrix<float, Eigen::RowMajor> NewFromOld() {
    const int half_edge_count = static_cast<int>(half_edges_.edge.size());
    for (int face = 0; face < static_cast<int>(quads_.size()); ++face) {
      AddFace(FacePoint(face), face, 1.0);
    }
    std::vector<int> valence(vertex_count_, 0);
    for (int h = 0; h < half_edge_count; ++h) ++valence[Corner(h)];
    for (int h = 0; h < half_edge_count; ++h) {
      // e = (v₁ + v₂ + f₁ + f₂) / 4; the twin adds the other half.
      Add(EdgePoint(h), Corner(h), 0.25);
      AddFace(EdgePoint(h), h / kCorners, 0.25);
      // v' = (F + 2R + (n − 3) v) / n, F and R the means of the n face points and edge midpoints:
      // this corner's share.
      const int v = Corner(h);
      const double n = valence[v];
      AddFace(v, h / kCorners, 1.0 / (n * n));
      Add(v, Corner(Next(h)), 1.0 / (n * n));
      Add(v, v, 1.0 / (n * n) + (n - 3.0) / (n * n));
    }
    Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(new_vertex_count(), vertex_count_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return matrix.cast<float>();
  }

  std::vector<Quad> NewQuads() const {
    std::vector<Quad> result;
    result.reserve(half_edges_.edge.size());
    for (int h = 0; h < static_cast<int>(half_edges_.edge.size()); ++h) {
      result.push_back({Corner(h), EdgePoint(h), FacePoint(h / kCorners), EdgePoint(Previous(h))});
    }
    return result;
  }

 private:
  int Corner(int half_edge) const { return quads_[half_edge / kCorners][half_edge % kCorners]; }
  void Add(int row, int column, double weight) { entries_.emplace_back(row, column, weight); }
  void AddFace(int row, int face, double weight) {
    for (const int v : quads_[face]) Add(row, v, weight / kCorners);
  }

  const std::vector<Quad>& quads_;
  int vertex_count_;
  const HalfEdges& half_edges_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

SubdivisionStep CatmullClark(const std::vector<Quad>& quads, int vertex_count) {
  Require(vertex_count >= 0, "CatmullClark: vertex_count = {}, expected 0 or more", vertex_count);
  const HalfEdges half_edges = FindHalfEdges(quads, static_cast<std::size_t>(vertex_count));
  if (!half_edges.problem.empty()) {
    throw DataError(fmt::format("mesh cannot be subdivided: {}", half_edges.problem));
  }
  Rule rule(quads, vertex_count, half_edges);
  return {rule.NewFromOld(), rule.NewQuads()};
}

}  // namespace vitruvia
