#include "learning/shape/tracking_template.h"

#include "core/error.h"
#include "geometry/decimation.h"

namespace vitruvia {

TrackingTemplate MakeTrackingTemplate(const TriangleMesh& learning_mesh, int target_vertices) {
  Decimation decimation = Decimate(learning_mesh, target_vertices);
  TrackingTemplate tracking;
  TriangleMesh mesh;
  for (const int v : decimation.kept)
    mesh.vertices.push_back(learning_mesh.vertices[static_cast<std::size_t>(v)]);
  mesh.triangles = decimation.triangles;
  tracking.learning_on_tracking = ClosestSurfacePoints(learning_mesh.vertices, mesh);
  tracking.kept = std::move(decimation.kept);
  tracking.triangles = std::move(decimation.triangles);
  return tracking;
}

BodyModel OnTrackingMesh(const BodyModel& learning_body, const TrackingTemplate& tracking) {
  Require(learning_body.rest.vertices.size() == tracking.learning_on_tracking.size(),
          "OnTrackingMesh: a body of {} vertices, the learning mesh has {}",
          learning_body.rest.vertices.size(), tracking.learning_on_tracking.size());
  BodyModel body;
  body.name = learning_body.name;
  body.skeleton = learning_body.skeleton;
  body.attributes = learning_body.attributes;
  body.rest.triangles = tracking.triangles;
  for (const int kept : tracking.kept) {
    const auto v = static_cast<std::size_t>(kept);
    body.rest.vertices.push_back(learning_body.rest.vertices[v]);
    body.weights.bones.push_back(learning_body.weights.bones[v]);
    body.weights.weights.push_back(learning_body.weights.weights[v]);
  }
  return body;
}

ShapeSpace OnTrackingMesh(const ShapeSpace& space, const TrackingTemplate& tracking) {
  ShapeSpace small = space;
  small.reference = OnTrackingMesh(space.reference, tracking);
  const auto rows = static_cast<Eigen::Index>(3 * tracking.kept.size());
  small.mean.resize(rows);
  small.basis.resize(rows, space.basis.cols());
  for (std::size_t i = 0; i < tracking.kept.size(); ++i) {
    const auto to = static_cast<Eigen::Index>(3 * i);
    const Eigen::Index from = 3 * tracking.kept[i];
    small.mean.segment<3>(to) = space.mean.segment<3>(from);
    small.basis.middleRows<3>(to) = space.basis.middleRows<3>(from);
  }
  return small;
}

std::vector<Vector3f> PositionsOnLearningMesh(const std::vector<Vector3f>& tracking_vertices,
                                              const TrackingTemplate& tracking) {
  Require(tracking_vertices.size() == tracking.kept.size(),
          "PositionsOnLearningMesh: {} vertices, the tracking mesh has {}",
          tracking_vertices.size(), tracking.kept.size());
  std::vector<Vector3f> positions;
  for (const SurfacePoint& point : tracking.learning_on_tracking)
    positions.push_back(Evaluate(point, tracking_vertices.data(), tracking.triangles));
  return positions;
}

SkinWeights WeightsOnLearningMesh(const SkinWeights& tracking_weights,
                                  const TrackingTemplate& tracking) {
  const Eigen::MatrixXf corners = Dense(tracking_weights, kBoneCount);
  Eigen::MatrixXf weights(static_cast<Eigen::Index>(tracking.learning_on_tracking.size()),
                          kBoneCount);
  for (std::size_t v = 0; v < tracking.learning_on_tracking.size(); ++v) {
    const SurfacePoint& point = tracking.learning_on_tracking[v];
    const Triangle& t = tracking.triangles[static_cast<std::size_t>(point.triangle)];
    weights.row(static_cast<Eigen::Index>(v)) = point.barycentric[0] * corners.row(t[0]) +
                                                point.barycentric[1] * corners.row(t[1]) +
                                                point.barycentric[2] * corners.row(t[2]);
  }
  return Sparsified(weights);
}

}  // namespace vitruvia
