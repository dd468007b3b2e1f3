#include "methods/sdf_parts/parts_term.h"

#include <algorithm>
#include <cmath>

#include "articulated/bone_neighbors.h"
#include "articulated/cloud_normals.h"
#include "articulated/strided_camera.h"
#include "geometry/point_sets.h"
#include "math/rigid.h"

namespace vitruvia::sdf_parts {

using articulated::AreNeighbors;
using articulated::Clock;
using articulated::MovingBones;
using articulated::Narrowed;
using articulated::PoseSystem;
using articulated::TimedStep;

namespace {}  // namespace

PartsTerm::PartsTerm(const Subject& subject, const PinholeCamera& camera, const Settings& settings)
    : settings_(settings),
      camera_(camera),
      prediction_camera_(articulated::Strided(camera, settings.predicted.stride_px)),
      parts_(CutIntoParts(subject, settings.field.least_weight)),
      posed_(parts_, settings.field.cell_m, settings.field.margin_m),
      rasterizer_(MakeRasterizer(Rasterizer::kFrontFaces, prediction_camera_)) {
  // A window that holds what lies within the cutoff at arm's length of the camera.
  constexpr int kWindow_px = 64;
  near_cloud_ = MakeNearestNeighbors(Association::kWindow, camera, kWindow_px);
  std::int32_t first = 0;
  for (const Part& part : parts_) {
    for (const Triangle& t : part.mesh.triangles) {
      triangles_.push_back({first + t[0], first + t[1], first + t[2]});
    }
    first += static_cast<std::int32_t>(part.mesh.vertices.size());
  }
  vertices_.resize(first);
  if (settings.intersection.weight == 0.0) return;
  sample_area_m2_ = 1.0 / settings.intersection.samples_per_m2;
  for (const Part& part : parts_) {
    const int count = std::max(1, static_cast<int>(SurfaceArea(part.mesh) / sample_area_m2_));
    for (const Vector3f& place : SampleSurface(part.mesh, count).points) {
      samples_.push_back({part.bone, place});
    }
  }
}

void PartsTerm::Observe(const articulated::Observation& observation) {
  observation_ = observation;
  articulated::FindNormals(*observation.cloud, *observation.depth, camera_,
                           settings_.common.stride_px, normals_);
  if (settings_.predicted.weight > 0.0) near_cloud_->Build(observation.cloud->points);
}

void PartsTerm::AddRows(const MovingBones& bones, double progress, WorkerTeam& team, Clock& clock,
                        PoseSystem& system) {
  posed_.Pose(bones.camera_from_rest());
  clock.Lap(TimedStep::kPose);
  nearest_.clear();
  predicted_.clear();
  if (settings_.observed.weight > 0.0) {
    MatchPoints(static_cast<float>(Narrowed(settings_.observed.first_cutoff_m,
                                            settings_.observed.last_cutoff_m, progress)),
                team);
  }
  if (settings_.predicted.weight > 0.0) MatchPrediction(bones.camera_from_rest(), team);
  clock.Lap(TimedStep::kMatch);
  AddObservedRows(system);
  observed_energy_ = system.energy();
  AddPredictedRows(system);
  predicted_energy_ = system.energy() - observed_energy_;
  AddIntersectionRows(bones.camera_from_rest(), system);
  intersection_energy_ = system.energy() - observed_energy_ - predicted_energy_;
}

void PartsTerm::MatchPoints(float cutoff_m, WorkerTeam& team) {
  const std::vector<Vector3f>& points = observation_.cloud->points;
  const auto facing_cosine = static_cast<float>(settings_.observed.facing_cosine);
  nearest_.resize(points.size());
  team.For(static_cast<int>(points.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      PosedParts::Nearest nearest = posed_.FindNearest(points[i], cutoff_m);
      const bool is_near = std::abs(nearest.distance_m) <= cutoff_m;
      const bool agrees =
          normals_[i].isZero() || normals_[i].dot(nearest.gradient) >= facing_cosine;
      if (!is_near || !agrees) nearest.bone = -1;
      nearest_[i] = nearest;
    }
  });
}

// The model's depth, the part at each of its pixels, and the observed point nearest to it.
void PartsTerm::MatchPrediction(const BoneTransforms& camera_from_rest, WorkerTeam& team) {
  std::size_t v = 0;
  for (const Part& part : parts_) {
    const Rigidf moved = camera_from_rest[part.bone].Cast<float>();
    for (const Vector3f& rest : part.mesh.vertices) vertices_[v++] = moved * rest;
  }
  const DepthImage& rendered = rasterizer_->Render(vertices_, triangles_);
  for (int row = 0; row < rendered.height(); ++row) {
    for (int column = 0; column < rendered.width(); ++column) {
      const float z = rendered(column, row);
      if (z <= 0.0f) continue;
      predicted_.push_back(
          prediction_camera_.Unproject(static_cast<float>(column), static_cast<float>(row), z));
    }
  }
  constexpr float kOnSurface_m = 0.02f;
  predicted_bones_.resize(predicted_.size());
  team.For(static_cast<int>(predicted_.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      predicted_bones_[i] = posed_.FindNearest(predicted_[i], kOnSurface_m).bone;
  });
  near_cloud_->FindNearest(predicted_, static_cast<float>(settings_.predicted.cutoff_m),
                           neighbors_);
}

double PartsTerm::PointWeight(double depth_m) const {
  return settings_.common.data.RowWeight(observation_.cloud->points.size(), depth_m);
}

// The minus arises because the point is fixed and the part moves.
void PartsTerm::AddObservedRows(PoseSystem& system) const {
  const std::vector<Vector3f>& points = observation_.cloud->points;
  for (std::size_t i = 0; i < nearest_.size(); ++i) {
    const PosedParts::Nearest& nearest = nearest_[i];
    if (nearest.bone < 0) continue;
    const double d = double{nearest.distance_m};
    const double huber = std::min(1.0, settings_.observed.huber_m / std::max(std::abs(d), 1e-12));
    system.AddRow(nearest.bone, points[i].cast<double>(), -nearest.gradient.cast<double>(), d,
                  settings_.observed.weight * huber * PointWeight(double{points[i].z()}));
  }
}

// Rows of the predicted points' distances from occupied space.
void PartsTerm::AddPredictedRows(PoseSystem& system) const {
  const std::vector<Vector3f>& points = observation_.cloud->points;
  const double stride =
      static_cast<double>(settings_.predicted.stride_px) / settings_.common.stride_px;
  for (std::size_t i = 0; i < predicted_.size(); ++i) {
    if (predicted_bones_[i] < 0 || neighbors_[i].index < 0) continue;
    const Vector3d place = predicted_[i].cast<double>();
    const Vector3d away = place - points[neighbors_[i].index].cast<double>();
    const double distance = away.norm();
    if (distance <= settings_.predicted.occupied_m) continue;
    system.AddRow(predicted_bones_[i], place, away / distance,
                  distance - settings_.predicted.occupied_m,
                  settings_.predicted.weight * stride * stride * PointWeight(place.z()));
  }
}

// Through the joints of the part that the sample belongs to only.
void PartsTerm::AddIntersectionRows(const BoneTransforms& camera_from_rest,
                                    PoseSystem& system) const {
  for (const Sample& sample : samples_) {
    const Vector3d place = camera_from_rest[sample.bone] * sample.place.cast<double>();
    for (int other = 0; other < kBoneCount; ++other) {
      if (AreNeighbors(sample.bone, other)) continue;
      const PosedParts::Nearest inside = posed_.DistanceFrom(other, place.cast<float>());
      if (inside.bone < 0 || inside.distance_m >= 0.0f) continue;
      const double point_side_m = settings_.common.stride_px * place.z();
      const double points =
          sample_area_m2_ * camera_.fx * camera_.fy / (point_side_m * point_side_m);
      system.AddRow(sample.bone, place, inside.gradient.cast<double>(), double{inside.distance_m},
                    settings_.intersection.weight * points * PointWeight(place.z()));
    }
  }
}

std::vector<NamedValue> PartsTerm::Energies() const {
  return {{"observed", observed_energy_},
          {"predicted", predicted_energy_},
          {"intersection", intersection_energy_}};
}

}  // namespace vitruvia::sdf_parts
