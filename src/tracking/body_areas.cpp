#include "tracking/body_areas.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/rigid.h"
#include "math/segment.h"
#include "tracking/visibility.h"

namespace vitruvia {
namespace {

// A vertex up to this far behind the rendered depth of its pixel is visible; otherwise slanted skin
// would not be.
constexpr float kVisibleWithin_m = 0.01f;

enum class Evidence { kConfirmed, kContradicted, kCovered };

// Evidence of the pixels round a visible vertex at depth z. The best evidence in the order of the
// enumerators counts, except for covering pixels, because half a pixel decides at silhouettes.
Evidence EvidenceAt(const DepthImage& depth, Pixel at, float z, const NearnessSettings& nearness) {
  bool is_covered = false;
  for (int v = at.v - nearness.edge_px; v <= at.v + nearness.edge_px; ++v) {
    for (int u = at.u - nearness.edge_px; u <= at.u + nearness.edge_px; ++u) {
      if (!depth.Contains(u, v) || !(depth(u, v) > 0.0f)) continue;
      const float behind_m = depth(u, v) - z;
      if (std::abs(behind_m) < nearness.depth_m) return Evidence::kConfirmed;
      is_covered |= behind_m < 0.0f;
    }
  }
  return is_covered ? Evidence::kCovered : Evidence::kContradicted;
}

}  // namespace

BoneAreas& BoneAreas::operator+=(const BoneAreas& other) {
  confirmed_m2 += other.confirmed_m2;
  contradicted_m2 += other.contradicted_m2;
  covered_m2 += other.covered_m2;
  unexplained_m2 += other.unexplained_m2;
  return *this;
}

double BoneAreas::disagreement() const {
  constexpr double kLeast_m2 = 0.002;  // some pixels of less area say little
  return (contradicted_m2 + unexplained_m2) / std::max(visible_m2() + unexplained_m2, kLeast_m2);
}

BoneAreas BodyAreas::total() const {
  BoneAreas sum;
  for (const BoneAreas& areas : bones) sum += areas;
  return sum;
}

double BodyAreas::disagreement() const {
  const double within_reach_m2 = observed_m2 - stray_m2;
  const BoneAreas sum = total();
  if (!(within_reach_m2 > 0.0)) return stray_m2 > 0.0 && sum.contradicted_m2 > 0.0 ? 1.0 : 0.0;
  return (sum.unexplained_m2 + sum.contradicted_m2) / within_reach_m2;
}

double BodyAreas::overlap() const {
  const BoneAreas sum = total();
  const double union_m2 = sum.visible_m2() + sum.unexplained_m2;
  return union_m2 > 0.0 ? sum.confirmed_m2 / union_m2 : 0.0;
}

BodyAreaMeter::BodyAreaMeter(const BodyModel& subject, const PinholeCamera& camera, int stride,
                             double max_depth_m, double reach_m)
    : camera_(camera),
      stride_(stride),
      max_depth_m_(static_cast<float>(max_depth_m)),
      reach_m_(reach_m),
      triangles_(subject.rest.triangles),
      skeleton_(subject.skeleton),
      rasterizer_(MakeRasterizer(Rasterizer::kFrontFaces, camera)) {
  for (const auto& bones : subject.weights.bones) bone_of_vertex_.push_back(bones[0]);
}

BodyAreas BodyAreaMeter::Measure(const std::vector<Vector3f>& vertices,
                                 const BoneTransforms& camera_from_rest, const DepthImage& depth,
                                 const NearnessSettings& nearness) {
  BodyAreas areas;
  const DepthImage& rendered = rasterizer_->Render(vertices, triangles_);
  MeasureVertexAreas(vertices);
  AddSkin(vertices, depth, rendered, nearness, areas);
  AddPoints(camera_from_rest, depth, rendered, nearness, areas);
  return areas;
}

DepthImage BodyAreaMeter::StrayDepth(const DepthImage& depth) const {
  DepthImage stray(depth.width(), depth.height());
  for (const int pixel : stray_pixels_) stray.pixels()[pixel] = depth.pixels()[pixel];
  return stray;
}

// A third of each adjoining triangle's image, at the vertex's depth; of those that face the camera.
void BodyAreaMeter::MeasureVertexAreas(const std::vector<Vector3f>& vertices) {
  const auto fx = static_cast<float>(camera_.fx), fy = static_cast<float>(camera_.fy);
  projected_.clear();
  for (const Vector3f& vertex : vertices) {
    const float inverse_z = vertex.z() > 0.0f ? 1.0f / vertex.z() : 0.0f;
    projected_.emplace_back(fx * vertex.x() * inverse_z, fy * vertex.y() * inverse_z, vertex.z());
  }
  vertex_area_m2_.assign(vertices.size(), 0.0f);
  for (const Triangle& triangle : triangles_) {
    const Vector3f &a = projected_[triangle[0]], &b = projected_[triangle[1]],
                   &c = projected_[triangle[2]];
    const float area_px2 =
        0.5f * ((c.x() - a.x()) * (b.y() - a.y()) - (b.x() - a.x()) * (c.y() - a.y()));
    if (!(area_px2 > 0.0f)) continue;
    for (const int corner : triangle) {
      const float z = projected_[corner].z();
      vertex_area_m2_[corner] += area_px2 / 3.0f * z * z / (fx * fy);
    }
  }
}

void BodyAreaMeter::AddSkin(const std::vector<Vector3f>& vertices, const DepthImage& depth,
                            const DepthImage& rendered, const NearnessSettings& nearness,
                            BodyAreas& areas) {
  FindVisibleVertices(vertices, rendered, camera_, kVisibleWithin_m, visible_);
  for (const int i : visible_) {
    const auto at = camera_.PixelOf(vertices[i]);
    if (!at) continue;
    BoneAreas& bone = areas.bones[bone_of_vertex_[i]];
    const double area_m2 = vertex_area_m2_[i];
    switch (EvidenceAt(depth, *at, vertices[i].z(), nearness)) {
      case Evidence::kConfirmed:
        bone.confirmed_m2 += area_m2;
        break;
      case Evidence::kContradicted:
        bone.contradicted_m2 += area_m2;
        break;
      case Evidence::kCovered:
        bone.covered_m2 += area_m2;
        break;
    }
  }
}

void BodyAreaMeter::AddPoints(const BoneTransforms& camera_from_rest, const DepthImage& depth,
                              const DepthImage& rendered, const NearnessSettings& nearness,
                              BodyAreas& areas) {
  CloudFromDepth(depth, camera_, stride_, max_depth_m_, cloud_);
  FindUnexplainedPoints(cloud_, rendered, nearness, unexplained_);
  const double pixel_sr = stride_ * stride_ / (camera_.fx * camera_.fy);
  const auto area_m2 = [&](const Vector3f& point) { return pixel_sr * point.z() * point.z(); };
  for (const Vector3f& point : cloud_.points) areas.observed_m2 += area_m2(point);
  std::array<Segment, kBoneCount> axes;
  for (int j = 0; j < kBoneCount; ++j) {
    axes[j] = {camera_from_rest[j] * skeleton_.joints[j], camera_from_rest[j] * skeleton_.tips[j]};
  }
  stray_pixels_.clear();
  for (const int i : unexplained_) {
    const Vector3d point = cloud_.points[i].cast<double>();
    int nearest = -1;
    double nearest_squared = reach_m_ * reach_m_;
    for (int j = 0; j < kBoneCount; ++j) {
      const double squared = axes[j].SquaredDistance(point);
      if (squared > nearest_squared) continue;
      nearest_squared = squared;
      nearest = j;
    }
    if (nearest < 0) stray_pixels_.push_back(cloud_.pixels[i]);
    double& sum = nearest < 0 ? areas.stray_m2 : areas.bones[nearest].unexplained_m2;
    sum += area_m2(cloud_.points[i]);
  }
}

}  // namespace vitruvia
