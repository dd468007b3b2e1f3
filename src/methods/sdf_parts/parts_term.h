// The energy of parts with signed distance fields: observed points against the parts, the predicted
// surface against what was observed, and parts against each other.
#pragma once

#include "articulated/data_term.h"
#include "methods/sdf_parts/posed_parts.h"
#include "methods/sdf_parts/settings.h"
#include "search/nearest_neighbors.h"
#include "tracking/tracker.h"

namespace vitruvia::sdf_parts {

class PartsTerm final : public articulated::DataTerm {
 public:
  PartsTerm(const Subject& subject, const PinholeCamera& camera, const Settings& settings);

  void Observe(const articulated::Observation& observation) override;
  void AddRows(const articulated::MovingBones& bones, double progress, WorkerTeam& team,
               articulated::Clock& clock, articulated::PoseSystem& system) override;
  std::vector<NamedValue> Energies() const override;

 private:
  // A point of a part's surface, in the rest pose.
  struct Sample {
    int bone;
    Vector3f place;
  };

  void MatchPoints(float cutoff_m, WorkerTeam& team);
  void MatchPrediction(const BoneTransforms& camera_from_rest, WorkerTeam& team);
  void AddObservedRows(articulated::PoseSystem& system) const;
  void AddPredictedRows(articulated::PoseSystem& system) const;
  void AddIntersectionRows(const BoneTransforms& camera_from_rest,
                           articulated::PoseSystem& system) const;
  double PointWeight(double depth_m) const;

  Settings settings_;
  PinholeCamera camera_, prediction_camera_;
  std::vector<Part> parts_;
  PosedParts posed_;
  std::vector<Sample> samples_;
  double sample_area_m2_ = 0.0;  // surface area per sample
  std::unique_ptr<MeshRasterizer> rasterizer_;
  std::unique_ptr<NearestNeighbors> near_cloud_;
  double observed_energy_ = 0.0, predicted_energy_ = 0.0, intersection_energy_ = 0.0;

  // Of the frame.
  articulated::Observation observation_{};
  std::vector<Vector3f> normals_;  // of the cloud's points

  // Kept between iterations to avoid allocation.
  std::vector<Triangle> triangles_;  // of all parts
  std::vector<Vector3f> vertices_;
  std::vector<PosedParts::Nearest> nearest_;  // of the cloud's points
  std::vector<Vector3f> predicted_;           // camera frame
  std::vector<int> predicted_bones_;
  std::vector<KdTree::Neighbor> neighbors_;  // of the predicted points in the cloud
};

}  // namespace vitruvia::sdf_parts
