// Agreement of a posed body and a frame for each bone, by area.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "body/body_model.h"
#include "geometry/mesh_rasterizer.h"
#include "geometry/point_cloud.h"
#include "tracking/classification.h"

namespace vitruvia {

// Areas projected along the line of sight, m². The visible part of a bone's skin is confirmed by
// the frame, contradicted (the frame shows something farther away, or nothing) or covered (by
// something nearer). Not counted are skin outside the image, and vertices on a silhouette whose
// pixel is empty in the rendered model.
struct BoneAreas {
  double confirmed_m2 = 0.0, contradicted_m2 = 0.0, covered_m2 = 0.0;
  double unexplained_m2 = 0.0;  // of the points near this bone that the model does not explain

  double visible_m2() const { return confirmed_m2 + contradicted_m2 + covered_m2; }
  // Unexplained and contradicted area as a share of the visible and the unexplained area.
  double disagreement() const;
  BoneAreas& operator+=(const BoneAreas& other);
};

struct BodyAreas {
  std::array<BoneAreas, kBoneCount> bones;
  double observed_m2 = 0.0;  // of all points
  double stray_m2 = 0.0;     // of the unexplained points that are out of reach of all bones

  BoneAreas total() const;
  // Unexplained and contradicted area as a share of the observed area within reach. If nothing is
  // observed there: 1 if the model is contradicted and something is observed elsewhere, otherwise
  // 0.
  double disagreement() const;
  // Confirmed area divided by the union of the model's visible area and the unexplained area within
  // reach: similarity of the tracked object to the subject, independent of the rest of the frame.
  double overlap() const;
};

class BodyAreaMeter {
 public:
  // Vertices belong to the bone of their largest weight. Points are those of every `stride`-th row
  // and column up to `max_depth_m`; one belongs to the bone whose axis is nearest, if that is
  // within `reach_m`.
  BodyAreaMeter(const BodyModel& subject, const PinholeCamera& camera, int stride,
                double max_depth_m, double reach_m);

  // `vertices`: the subject's surface in the pose `camera_from_rest` (camera frame, metres).
  BodyAreas Measure(const std::vector<Vector3f>& vertices, const BoneTransforms& camera_from_rest,
                    const DepthImage& depth, const NearnessSettings& nearness);
  // The points of the last measured frame, and the indices of those that the model does not
  // explain.
  const std::vector<Vector3f>& points() const { return cloud_.points; }
  const std::vector<int>& unexplained() const { return unexplained_; }
  // The depth of only those points of the last measured frame that are out of reach of all bones.
  DepthImage StrayDepth(const DepthImage& depth) const;

 private:
  void MeasureVertexAreas(const std::vector<Vector3f>& vertices);
  void AddSkin(const std::vector<Vector3f>& vertices, const DepthImage& depth,
               const DepthImage& rendered, const NearnessSettings& nearness, BodyAreas& areas);
  void AddPoints(const BoneTransforms& camera_from_rest, const DepthImage& depth,
                 const DepthImage& rendered, const NearnessSettings& nearness, BodyAreas& areas);

  PinholeCamera camera_;
  int stride_;
  float max_depth_m_;
  double reach_m_;
  std::vector<Triangle> triangles_;
  std::vector<int> bone_of_vertex_;
  Skeleton skeleton_;
  std::unique_ptr<MeshRasterizer> rasterizer_;
  // Kept between calls to avoid allocation.
  std::vector<Vector3f> projected_;  // u, v, z
  std::vector<float> vertex_area_m2_;
  std::vector<int> visible_, unexplained_;
  std::vector<int> stray_pixels_;
  PointCloud cloud_;
};

}  // namespace vitruvia
