#include "subjects/rig_pictures.h"

#include <algorithm>
#include <cmath>

#include "geometry/surface_map.h"
#include "math/angles.h"
#include "math/rigid.h"

namespace vitruvia {
namespace {

using Vertices = std::vector<Vector3f>;

// Over the origin.
TriangleMesh Centred(Vertices vertices, const std::vector<Triangle>& triangles) {
  Vector3f middle = BoundingBox(vertices).center();
  middle.y() = 0.0f;
  for (Vector3f& v : vertices) v -= middle;
  return {std::move(vertices), triangles};
}

struct Shown {
  std::string label;
  TriangleMesh mesh;
  Vertices registered, skinned;
  double heading_deg;  // that the person faces
};

std::vector<float> Errors(const Rig& rig, const Shown& shown) {
  std::vector<float> errors_m;
  const bool has_own_surface = rig.cost.has_value();
  const std::vector<SurfacePoint> nearest = has_own_surface
                                                ? std::vector<SurfacePoint>()
                                                : ClosestSurfacePoints(shown.skinned, shown.mesh);
  for (std::size_t v = 0; v < shown.skinned.size(); ++v) {
    const Vector3f place =
        has_own_surface ? shown.mesh.vertices[v]
                        : Evaluate(nearest[v], shown.mesh.vertices.data(), shown.mesh.triangles);
    errors_m.push_back((shown.skinned[v] - place).norm());
  }
  return errors_m;
}

SurfaceStrip Strip(const Rig& rig, const Shown& shown) {
  const double turn_deg = -shown.heading_deg;
  const ShownSurface mesh{
      Centred(shown.mesh.vertices, shown.mesh.triangles), SurfaceColor::kTruth, {}};
  const ShownSurface registered{
      Centred(shown.registered, rig.model.rest.triangles), SurfaceColor::kEstimate, {}};
  const ShownSurface skinned{
      Centred(shown.skinned, rig.subject.rest.triangles), SurfaceColor::kEstimate, {}};
  ShownSurface bones = skinned, errors = skinned;
  bones.color = SurfaceColor::kBone;
  for (const auto& heaviest : rig.subject.weights.bones) bones.values.push_back(heaviest[0]);
  errors.color = SurfaceColor::kError;
  errors.values = Errors(rig, shown);
  return {shown.label,
          "",
          {{"mesh", turn_deg, {mesh}},
           {"registered body", turn_deg, {registered}},
           {"skinned subject", turn_deg, {skinned}},
           {"heaviest bone", turn_deg, {bones}},
           {"error, from the front", turn_deg, {errors}},
           {"error, from behind", turn_deg + 180.0, {errors}}}};
}

Vertices Skinned(const BodyModel& body, const BoneTransforms& bones) {
  Vertices vertices;
  SkinLinear(body.rest.vertices, body.weights, bones, vertices);
  return vertices;
}

double Heading_deg(const Matrix3<double>& rotation) {
  return std::atan2(rotation(0, 2), rotation(2, 2)) / kRadiansPerDegree;
}

}  // namespace

std::vector<SurfaceStrip> RigStrips(const Rig& rig, const std::vector<TriangleMesh>& frames,
                                    int count) {
  std::vector<SurfaceStrip> strips{Strip(
      rig, {"T-pose", rig.subject.rest, rig.model.rest.vertices, rig.subject.rest.vertices, 0.0})};
  const std::size_t shown = std::min(frames.size(), static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t f = i * frames.size() / shown;
    strips.push_back(Strip(
        rig, {fmt::format("frame {}", f), frames[f], Skinned(rig.model, rig.model_frames[f]),
              Skinned(rig.subject, rig.frames[f]), Heading_deg(rig.model_frames[f][0].rotation)}));
  }
  return strips;
}

}  // namespace vitruvia
