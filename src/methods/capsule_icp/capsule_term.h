// The energy of capsules in a frame: data, silhouette, free space, intersections.
#pragma once

#include "articulated/data_term.h"
#include "methods/capsule_icp/capsule_samples.h"
#include "methods/capsule_icp/posed_capsules.h"
#include "methods/capsule_icp/settings.h"
#include "methods/capsule_icp/silhouette.h"
#include "tracking/tracker.h"

namespace vitruvia::capsule_icp {

// A row of the data term: residual + direction · δx of a point of the model on a bone.
struct DataRow {
  int bone = -1;  // -1: none
  Vector3f point, direction;
  float residual = 0.0f;
};

// Row of an observed point: its distance from the nearest capsule. No row if the capsule is farther
// than cutoff_m, or if its surface faces away from the camera or from the observed normal (unit
// length, towards the camera; zero if unknown).
DataRow ClosestPointRow(const PosedCapsules& capsules, const Vector3f& point,
                        const Vector3f& normal, float cutoff_m, float facing_cosine);

// Row of a rendered pixel: observed minus rendered depth of the model's point at the pixel. Because
// the point moves to other pixels, the row contains the slope of the observed depth (metres per
// pixel, (0, 0) if there is none). No row if the difference exceeds cutoff_m.
DataRow DepthDifferenceRow(const PinholeCamera& camera, int bone, const Vector3f& rendered_point,
                           float observed_depth_m, const Eigen::Vector2f& slope, float cutoff_m);

// Corners of the mesh that is rendered for depth differences.
inline constexpr int kRenderedCorners = 16;

class CapsuleTerm final : public articulated::DataTerm {
 public:
  CapsuleTerm(const Subject& subject, const PinholeCamera& camera, const Settings& settings);

  void Observe(const articulated::Observation& observation) override;
  void AddRows(const articulated::MovingBones& bones, double progress, WorkerTeam& team,
               articulated::Clock& clock, articulated::PoseSystem& system) override;
  std::vector<NamedValue> Energies() const override;

 private:
  struct Overlapping {
    int a, b;  // capsules
  };

  void MatchPoints(float cutoff_m, WorkerTeam& team);
  void MatchPixels(const BoneTransforms& camera_from_rest, float cutoff_m, WorkerTeam& team);
  Vector3f PointAt(const Pixel& pixel, float depth_m) const;
  DataRow RenderedPixelRow(const Pixel& pixel, float rendered_m, float cutoff_m) const;
  void AddDataRows(double width_m, articulated::PoseSystem& system);
  void AddSampleRows(const BoneTransforms& camera_from_rest, articulated::PoseSystem& system);
  void AddSilhouetteRows(int bone, const Vector3d& place, const Pixel& pixel,
                         articulated::PoseSystem& system) const;
  void AddFreeSpaceRow(int bone, const Vector3d& place, double observed_depth_m,
                       articulated::PoseSystem& system) const;
  void AddIntersectionRows(articulated::PoseSystem& system) const;
  double PointWeight(double depth_m) const;

  PinholeCamera camera_;
  Settings settings_;
  PosedCapsules capsules_;
  std::vector<SurfaceSample> samples_;
  CapsuleMesh mesh_;
  std::vector<Overlapping> pairs_;  // that may meet
  std::unique_ptr<MeshRasterizer> rasterizer_;
  Silhouette silhouette_;
  double data_energy_ = 0.0, silhouette_energy_ = 0.0, free_space_energy_ = 0.0,
         intersection_energy_ = 0.0;

  // Of the frame.
  articulated::Observation observation_{};
  std::vector<Vector3f> normals_;  // of the cloud's points

  // Kept between iterations to avoid allocation.
  std::vector<Vector3f> vertices_;
  std::vector<DataRow> rows_;
};

}  // namespace vitruvia::capsule_icp
