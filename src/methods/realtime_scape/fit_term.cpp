#include "methods/realtime_scape/fit_term.h"

namespace vitruvia::realtime_scape {
namespace {

class RowWriter {
 public:
  RowWriter(const Model& model, const BodyPose& pose, const PosedSurface& surface,
            double length_unit_m, BlockNormalEquations& equations)
      : model_(model),
        pose_(pose),
        surface_(surface),
        per_unit_(1.0 / length_unit_m),
        equations_(equations) {}

  // direction · (vertex − target), a length, as one row. For bone j of weight w the vertex moves by
  // w (r × (x_j − c_j) + t), x_j its place under bone j alone and c_j the bone's centre.
  void Add(int vertex, const Vector3d& direction, double residual_m, double weight) {
    std::array<BlockNormalEquations::Entry, kMaxInfluences> entries;
    const auto influences = model_.InfluencesOf(vertex);
    const Vector3d rest = model_.rest_vertices[vertex].cast<double>();
    for (std::size_t k = 0; k < influences.size(); ++k) {
      const auto [bone, w] = influences[k];
      const Vector3d arm = pose_[bone].rotation * (rest - model_.rest_centers[bone]);
      entries[k].block = bone;
      entries[k].jacobian << double{w} * per_unit_ * arm.cross(direction), double{w} * direction;
    }
    equations_.AddRow({entries.data(), influences.size()}, residual_m * per_unit_, weight);
  }

  // The vertex's normal as its bones have turned it.
  Vector3d Normal(int vertex) const {
    Matrix3<double> blend = Matrix3<double>::Zero();
    for (const auto& [bone, w] : model_.InfluencesOf(vertex))
      blend += double{w} * pose_[bone].rotation;
    return (blend * model_.rest_normals[vertex].cast<double>()).normalized();
  }

  Vector3d Position(int vertex) const { return surface_.vertices[vertex].cast<double>(); }

 private:
  const Model& model_;
  const BodyPose& pose_;
  const PosedSurface& surface_;
  double per_unit_;
  BlockNormalEquations& equations_;
};

}  // namespace

double AddFitTerm(const Model& model, const BodyPose& pose, const PosedSurface& surface,
                  const PinholeCamera& camera, const FitData& data, const FitSettings& settings,
                  double length_unit_m, BlockNormalEquations& equations) {
  const double energy_before = equations.energy();
  RowWriter rows(model, pose, surface, length_unit_m, equations);

  for (std::size_t k = 0; k < data.classes.near_surface.size(); ++k) {
    const int vertex = data.classes.near_surface[k];
    const Vector3d position = rows.Position(vertex);
    const double observed_depth = data.classes.observed_depth[k];
    if (settings.surface_residual == SurfaceResidual::kDepth) {
      rows.Add(vertex, Vector3d::UnitZ(), position.z() - observed_depth, settings.surface_weight);
    } else {
      const auto pixel = camera.Project(position);
      const Vector3d observed = camera.Unproject(pixel.x(), pixel.y(), observed_depth);
      const Vector3d normal = rows.Normal(vertex);
      rows.Add(vertex, normal, normal.dot(position - observed), settings.surface_weight);
    }
  }
  for (const Pair& pair : data.pairs) {
    const Vector3d offset = rows.Position(pair.vertex) - pair.target.cast<double>();
    for (int axis = 0; axis < 3; ++axis) {
      rows.Add(pair.vertex, Vector3d::Unit(axis), offset[axis], settings.pair_weight);
    }
  }
  return equations.energy() - energy_before;
}

}  // namespace vitruvia::realtime_scape
