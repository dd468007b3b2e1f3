#include "methods/realtime_scape/terms/fit_term.h"

#include <cmath>

#include "methods/realtime_scape/terms/posed_vertex.h"

namespace vitruvia::realtime_scape {
namespace {

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

double NoiseWeight(const NoiseSettings& noise, const Vector3d& point, const Vector3d& direction) {
  if (noise.sensor.IsZero()) return 1.0;
  const double model_m2 = noise.model_deviation_m * noise.model_deviation_m;
  const double cosine = direction.dot(point.normalized());
  return model_m2 / (model_m2 + noise.sensor.Variance_m2(point.z(), cosine));
}

void AddFitTerm(const Model& model, const BodyPose& pose, const PinholeCamera& camera,
                const VertexClasses& classes, const std::vector<Pair>& pairs,
                const FitSettings& settings, double length_unit_m,
                BlockNormalEquations& equations) {
  const double per_unit = 1.0 / length_unit_m;
  // The kernel's scale grows with the deviation that is expected of the row.
  const auto robust = [&](double residual_m, double noise_weight) {
    return noise_weight * RobustWeight(settings.kernel, residual_m * std::sqrt(noise_weight),
                                       settings.kernel_scale_m);
  };

  const auto stride = static_cast<std::size_t>(settings.surface_stride);
  const double surface_weight = settings.surface_weight * settings.surface_stride;
  for (std::size_t k = 0; k < classes.near_surface.size(); k += stride) {
    const int index = classes.near_surface[k];
    const PosedVertex vertex(model, pose, index);
    const double observed_depth = classes.observed_depth[k];
    const auto pixel = camera.Project(vertex.position());
    const Vector3d observed = camera.Unproject(pixel.x(), pixel.y(), observed_depth);
    const Vector3d direction = settings.surface_residual == SurfaceResidual::kDepth
                                   ? Vector3d::UnitZ()
                                   : PosedNormal(model, pose, index);
    const double residual_m = settings.surface_residual == SurfaceResidual::kDepth
                                  ? vertex.position().z() - observed_depth
                                  : direction.dot(vertex.position() - observed);
    const double noise_weight = NoiseWeight(settings.noise, observed, direction);
    const double weight = surface_weight * double{classes.weight[k]};
    vertex.AddRow(direction, residual_m, weight * robust(residual_m, noise_weight), per_unit,
                  equations);
  }
  for (const Pair& pair : pairs) {
    const PosedVertex vertex(model, pose, pair.vertex);
    const Vector3d target = pair.target.cast<double>();
    const Vector3d offset = vertex.position() - target;
    if (settings.pair_residual == PairResidual::kPlane) {
      const Vector3d normal = PosedNormal(model, pose, pair.vertex);
      const double residual_m = normal.dot(offset);
      const double noise_weight = NoiseWeight(settings.noise, target, normal);
      vertex.AddRow(normal, residual_m, settings.pair_weight * robust(residual_m, noise_weight),
                    per_unit, equations);
      continue;
    }
    const double noise_weight = NoiseWeight(settings.noise, target, target.normalized());
    const double weight = settings.pair_weight * robust(offset.norm(), noise_weight);
    for (int axis = 0; axis < 3; ++axis) {
      vertex.AddRow(Vector3d::Unit(axis), offset[axis], weight, per_unit, equations);
    }
  }
}

}  // namespace vitruvia::realtime_scape
