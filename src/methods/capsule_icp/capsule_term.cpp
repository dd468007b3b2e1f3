#include "methods/capsule_icp/capsule_term.h"

#include <algorithm>
#include <cmath>

#include "articulated/bone_neighbors.h"
#include "articulated/cloud_normals.h"
#include "articulated/strided_camera.h"
#include "math/rigid.h"

namespace vitruvia::capsule_icp {

using articulated::AreNeighbors;
using articulated::Clock;
using articulated::MovingBones;
using articulated::Narrowed;
using articulated::PoseSystem;
using articulated::TimedStep;

namespace {

// The nearest points of two capsules' segments, and how far the capsules reach into each other.
struct Overlap {
  Vector3d a, b, direction;  // from b to a
  double depth_m;            // negative: apart
};

// Nearest points of two segments (Ericson, Real-Time Collision Detection, sec. 5.1.9).
Overlap OverlapOf(const Capsule& first, const Capsule& second) {
  const Vector3d d1 = first.end - first.start, d2 = second.end - second.start,
                 r = first.start - second.start;
  const double a = std::max(d1.squaredNorm(), 1e-12), e = std::max(d2.squaredNorm(), 1e-12);
  const double b = d1.dot(d2), c = d1.dot(r), f = d2.dot(r), denominator = a * e - b * b;
  double s = denominator > 1e-12 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  const double t = std::clamp((b * s + f) / e, 0.0, 1.0);
  s = std::clamp((b * t - c) / a, 0.0, 1.0);
  Overlap overlap;
  overlap.a = first.start + s * d1;
  overlap.b = second.start + t * d2;
  const Vector3d apart = overlap.a - overlap.b;
  const double distance = apart.norm();
  overlap.direction = distance > 0.0 ? Vector3d(apart / distance) : d1.unitOrthogonal();
  overlap.depth_m = std::lerp(first.start_radius_m, first.end_radius_m, s) +
                    std::lerp(second.start_radius_m, second.end_radius_m, t) - distance;
  return overlap;
}

// Geman–McClure: about 1 well within the width, falling with the fourth power beyond it.
double Robust(double residual, double width) {
  const double share = width * width / (width * width + residual * residual);
  return share * share;
}

// The slope of depth (metres per pixel) along a column or row from both neighbours, where they
// belong to the same surface; 0 elsewhere.
float Slope(float before, float here, float after) {
  constexpr float kOneSurface_m = 0.05f;
  const bool is_smooth =
      std::abs(before - here) < kOneSurface_m && std::abs(after - here) < kOneSurface_m;
  return is_smooth ? 0.5f * (after - before) : 0.0f;
}

}  // namespace

DataRow ClosestPointRow(const PosedCapsules& capsules, const Vector3f& point,
                        const Vector3f& normal, float cutoff_m, float facing_cosine) {
  const PosedCapsules::Nearest nearest = capsules.FindNearest(point);
  const bool faces_camera = nearest.normal.dot(point) < 0.0f;
  const bool agrees = normal.isZero() || normal.dot(nearest.normal) > facing_cosine;
  if (std::abs(nearest.distance_m) > cutoff_m || !faces_camera || !agrees) return {};
  // The point is fixed and the capsule moves, so a motion along the normal reduces the distance.
  return {capsules.rest()[nearest.capsule].bone, point, -nearest.normal, nearest.distance_m};
}

DataRow DepthDifferenceRow(const PinholeCamera& camera, int bone, const Vector3f& rendered_point,
                           float observed_depth_m, const Eigen::Vector2f& slope, float cutoff_m) {
  const float residual = observed_depth_m - rendered_point.z();
  if (!(std::abs(residual) <= cutoff_m)) return {};
  const float inverse_z = 1.0f / rendered_point.z();
  const float along_u = static_cast<float>(camera.fx) * inverse_z * slope.x();
  const float along_v = static_cast<float>(camera.fy) * inverse_z * slope.y();
  const Vector3f direction(
      along_u, along_v,
      -inverse_z * (rendered_point.x() * along_u + rendered_point.y() * along_v) - 1.0f);
  return {bone, rendered_point, direction, residual};
}

CapsuleTerm::CapsuleTerm(const Subject& subject, const PinholeCamera& camera,
                         const Settings& settings)
    : camera_(camera),
      settings_(settings),
      capsules_(FitCapsules(subject, settings.capsules.trunk_capsules)),
      samples_(SampleCapsules(capsules_.rest(), settings.capsules.sample_spacing_m)),
      mesh_(Meshed(capsules_.rest(), kRenderedCorners)),
      rasterizer_(MakeRasterizer(Rasterizer::kFrontFaces,
                                 articulated::Strided(camera, settings.common.stride_px))),
      silhouette_(camera, settings.silhouette.reach_px) {
  const std::vector<Capsule>& rest = capsules_.rest();
  for (int a = 0; a < static_cast<int>(rest.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(rest.size()); ++b) {
      const bool meet_at_rest = OverlapOf(rest[a], rest[b]).depth_m > 0.0;
      if (!AreNeighbors(rest[a].bone, rest[b].bone) && !meet_at_rest) pairs_.push_back({a, b});
    }
  }
}

void CapsuleTerm::Observe(const articulated::Observation& observation) {
  observation_ = observation;
  if (settings_.silhouette.weight > 0.0) {
    silhouette_.Observe(*observation.depth, static_cast<float>(settings_.common.max_depth_m));
  }
  articulated::FindNormals(*observation.cloud, *observation.depth, camera_,
                           settings_.common.stride_px, normals_);
}

void CapsuleTerm::AddRows(const MovingBones& bones, double progress, WorkerTeam& team, Clock& clock,
                          PoseSystem& system) {
  const double cutoff_m =
      Narrowed(settings_.match.first_cutoff_m, settings_.match.last_cutoff_m, progress);
  capsules_.Pose(bones.camera_from_rest());
  clock.Lap(TimedStep::kPose);
  switch (settings_.data_term) {
    case DataTermKind::kClosestPoint:
      MatchPoints(static_cast<float>(cutoff_m), team);
      break;
    case DataTermKind::kDepthDifference:
      MatchPixels(bones.camera_from_rest(), static_cast<float>(cutoff_m), team);
      break;
  }
  clock.Lap(TimedStep::kMatch);
  AddDataRows(0.5 * cutoff_m, system);
  data_energy_ = system.energy();
  AddSampleRows(bones.camera_from_rest(), system);
  const double before = system.energy();
  if (settings_.intersection_weight > 0.0) AddIntersectionRows(system);
  intersection_energy_ = system.energy() - before;
}

void CapsuleTerm::MatchPoints(float cutoff_m, WorkerTeam& team) {
  const std::vector<Vector3f>& points = observation_.cloud->points;
  const auto facing_cosine = static_cast<float>(settings_.match.facing_cosine);
  rows_.resize(points.size());
  team.For(static_cast<int>(points.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      rows_[i] = ClosestPointRow(capsules_, points[i], normals_[i], cutoff_m, facing_cosine);
    }
  });
}

// At a pixel that only the observation covers, the row is that of the nearest capsule.
void CapsuleTerm::MatchPixels(const BoneTransforms& camera_from_rest, float cutoff_m,
                              WorkerTeam& team) {
  vertices_.resize(mesh_.bones.size());
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    vertices_[v] =
        (camera_from_rest[mesh_.bones[v]] * mesh_.mesh.vertices[v].cast<double>()).cast<float>();
  }
  const DepthImage& rendered = rasterizer_->Render(vertices_, mesh_.mesh.triangles);
  const DepthImage& depth = *observation_.depth;
  const int stride = settings_.common.stride_px;
  const int columns = (camera_.width - 1) / stride, rows = (camera_.height - 1) / stride;
  rows_.assign(static_cast<std::size_t>(columns) * rows, {});
  team.For(rows, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      for (int column = 0; column < columns; ++column) {
        const int u = column * stride, v = row * stride;
        const float z = rendered(column, row), here = depth(u, v);
        if (u == 0 || v == 0 || !(here > 0.0f)) continue;
        rows_[static_cast<std::size_t>(row) * columns + column] =
            z > 0.0f ? RenderedPixelRow({u, v}, z, cutoff_m)
                     : ClosestPointRow(capsules_, PointAt({u, v}, here), Vector3f::Zero(), cutoff_m,
                                       0.0f);
      }
    }
  });
}

Vector3f CapsuleTerm::PointAt(const Pixel& pixel, float depth_m) const {
  return camera_.Unproject(static_cast<float>(pixel.u), static_cast<float>(pixel.v), depth_m);
}

// A pixel off the image's edge.
DataRow CapsuleTerm::RenderedPixelRow(const Pixel& pixel, float rendered_m, float cutoff_m) const {
  const auto& [u, v] = pixel;
  const DepthImage& depth = *observation_.depth;
  const Vector3f point = PointAt(pixel, rendered_m);
  const int bone = capsules_.rest()[capsules_.FindNearest(point).capsule].bone;
  const float here = depth(u, v);
  const Eigen::Vector2f slope(Slope(depth(u - 1, v), here, depth(u + 1, v)),
                              Slope(depth(u, v - 1), here, depth(u, v + 1)));
  return DepthDifferenceRow(camera_, bone, point, here, slope, cutoff_m);
}

double CapsuleTerm::PointWeight(double depth_m) const {
  return settings_.common.data.RowWeight(observation_.cloud->points.size(), depth_m);
}

void CapsuleTerm::AddDataRows(double width_m, PoseSystem& system) {
  for (const DataRow& row : rows_) {
    if (row.bone < 0) continue;
    system.AddRow(row.bone, row.point.cast<double>(), row.direction.cast<double>(),
                  double{row.residual},
                  Robust(double{row.residual}, width_m) * PointWeight(double{row.point.z()}));
  }
}

// A sample stands for as much surface as so many points.
void CapsuleTerm::AddSampleRows(const BoneTransforms& camera_from_rest, PoseSystem& system) {
  silhouette_energy_ = free_space_energy_ = 0.0;
  for (const SurfaceSample& sample : samples_) {
    const Vector3d place = camera_from_rest[sample.bone] * sample.place;
    const std::optional<Pixel> pixel = camera_.PixelOf(place);
    if (!pixel) continue;
    const double before = system.energy();
    const auto observed = double{(*observation_.depth)(pixel->u, pixel->v)};
    if (observed > 0.0) {
      AddFreeSpaceRow(sample.bone, place, observed, system);
      free_space_energy_ += system.energy() - before;
    } else {
      AddSilhouetteRows(sample.bone, place, *pixel, system);
      silhouette_energy_ += system.energy() - before;
    }
  }
}

// Across the image, in metres at the sample's depth: towards the nearest measured pixel.
void CapsuleTerm::AddSilhouetteRows(int bone, const Vector3d& place, const Pixel& pixel,
                                    PoseSystem& system) const {
  if (settings_.silhouette.weight == 0.0) return;
  const std::optional<Pixel> nearest = silhouette_.NearestTo(pixel);
  if (!nearest) return;
  const double z = place.z();
  const Vector3d away(z / camera_.fx * (pixel.u - nearest->u),
                      z / camera_.fy * (pixel.v - nearest->v), 0.0);
  const double spacing = settings_.capsules.sample_spacing_m / (settings_.common.stride_px * z);
  const double weight = settings_.silhouette.weight * PointWeight(z) * spacing * spacing *
                        camera_.fx * camera_.fy *
                        Robust(away.norm(), settings_.silhouette.reach_px * z / camera_.fx);
  system.AddRow(bone, place, {1.0, 0.0, -place.x() / z}, away.x(), weight);
  system.AddRow(bone, place, {0.0, 1.0, -place.y() / z}, away.y(), weight);
}

void CapsuleTerm::AddFreeSpaceRow(int bone, const Vector3d& place, double observed_depth_m,
                                  PoseSystem& system) const {
  const FreeSpaceSettings& settings = settings_.free_space;
  const double in_front = observed_depth_m - settings.margin_m - place.z();
  if (settings.weight == 0.0 || in_front <= 0.0 || in_front > settings.reach_m) return;
  const double spacing =
      settings_.capsules.sample_spacing_m / (settings_.common.stride_px * place.z());
  system.AddRow(bone, place, {0.0, 0.0, -1.0}, in_front,
                settings.weight * PointWeight(place.z()) * spacing * spacing * camera_.fx *
                    camera_.fy * Robust(in_front, 0.5 * settings.reach_m));
}

void CapsuleTerm::AddIntersectionRows(PoseSystem& system) const {
  for (const Overlapping& pair : pairs_) {
    const Capsule a = capsules_.InCamera(pair.a), b = capsules_.InCamera(pair.b);
    const Overlap overlap = OverlapOf(a, b);
    if (overlap.depth_m <= 0.0) continue;
    system.AddPairRow(a.bone, overlap.a, b.bone, overlap.b, -overlap.direction, overlap.depth_m,
                      settings_.intersection_weight * PointWeight(overlap.a.z()));
  }
}

std::vector<NamedValue> CapsuleTerm::Energies() const {
  return {{"data", data_energy_},
          {"silhouette", silhouette_energy_},
          {"free space", free_space_energy_},
          {"intersection", intersection_energy_}};
}

}  // namespace vitruvia::capsule_icp
