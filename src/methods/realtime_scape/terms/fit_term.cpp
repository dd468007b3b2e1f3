#include "methods/realtime_scape/terms/fit_term.h"

#include <cmath>

namespace vitruvia::realtime_scape {
namespace {

// A posed vertex and its derivative by the bones' increments: bone j with weight w moves it by
// w (r × arm_j + t), where arm_j = R_j (v̄ − c̄_j) is the vertex under that bone alone, relative to
// the bone's centre.
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

// The vertex's normal, rotated by its bones and blended by their weights.
Vector3d PosedNormal(const Model& model, const BodyPose& pose, int vertex) {
  const Vector3d rest = model.rest_normals[vertex].cast<double>();
  Vector3d normal = Vector3d::Zero();
  for (const auto& [bone, w] : model.InfluencesOf(vertex)) {
    normal += double{w} * (pose[bone].rotation * rest);
  }
  return normal.normalized();
}

}  // namespace

double RobustWeight(RobustKernel kernel, double residual_m, double scale_m) {
  const double size = std::abs(residual_m);
  switch (kernel) {
    case RobustKernel::kNone:
      return 1.0;
    case RobustKernel::kHuber:
      return size <= scale_m ? 1.0 : scale_m / size;
    case RobustKernel::kTukey: {
      const double share = size / scale_m;
      const double inside = 1.0 - share * share;
      return share < 1.0 ? inside * inside : 0.0;
    }
  }
  return 1.0;
}

void AddFitTerm(const Model& model, const BodyPose& pose, const PinholeCamera& camera,
                const VertexClasses& classes, const std::vector<Pair>& pairs,
                const FitSettings& settings, double length_unit_m,
                BlockNormalEquations& equations) {
  const double per_unit = 1.0 / length_unit_m;
  const auto robust = [&](double residual_m) {
    return RobustWeight(settings.kernel, residual_m, settings.kernel_scale_m);
  };

  const auto stride = static_cast<std::size_t>(settings.surface_stride);
  const double surface_weight = settings.surface_weight * settings.surface_stride;
  for (std::size_t k = 0; k < classes.near_surface.size(); k += stride) {
    const int index = classes.near_surface[k];
    const PosedVertex vertex(model, pose, index);
    const double observed_depth = classes.observed_depth[k];
    if (settings.surface_residual == SurfaceResidual::kDepth) {
      const double residual_m = vertex.position().z() - observed_depth;
      vertex.AddRow(Vector3d::UnitZ(), residual_m, surface_weight * robust(residual_m), per_unit,
                    equations);
    } else {
      const auto pixel = camera.Project(vertex.position());
      const Vector3d observed = camera.Unproject(pixel.x(), pixel.y(), observed_depth);
      const Vector3d normal = PosedNormal(model, pose, index);
      const double residual_m = normal.dot(vertex.position() - observed);
      vertex.AddRow(normal, residual_m, surface_weight * robust(residual_m), per_unit, equations);
    }
  }
  for (const Pair& pair : pairs) {
    const PosedVertex vertex(model, pose, pair.vertex);
    const Vector3d offset = vertex.position() - pair.target.cast<double>();
    if (settings.pair_residual == PairResidual::kPlane) {
      const Vector3d normal = PosedNormal(model, pose, pair.vertex);
      const double residual_m = normal.dot(offset);
      vertex.AddRow(normal, residual_m, settings.pair_weight * robust(residual_m), per_unit,
                    equations);
      continue;
    }
    const double weight = settings.pair_weight * robust(offset.norm());
    for (int axis = 0; axis < 3; ++axis) {
      vertex.AddRow(Vector3d::Unit(axis), offset[axis], weight, per_unit, equations);
    }
  }
}

}  // namespace vitruvia::realtime_scape
