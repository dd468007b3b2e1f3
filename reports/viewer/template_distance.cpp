#include "reports/viewer/template_distance.h"

#include "math/rigid_fit.h"
#include "metrics/nearest_vertices.h"

namespace vitruvia {
namespace {

constexpr float kRigidWeight = 0.9f;  // of a vertex that shows where its bone is
constexpr std::size_t kFewestVertices = 3;

}  // namespace

TemplateDistance::TemplateDistance(const std::vector<Vector3f>& rest_vertices,
                                   const BodyModel& subject)
    : rest_(rest_vertices), rigid_vertices_(kBoneCount) {
  for (const int vertex : NearestVertices(rest_vertices, subject.rest.vertices)) {
    const auto index = static_cast<int>(weights_.size());
    weights_.bones.push_back(subject.weights.bones[vertex]);
    weights_.weights.push_back(subject.weights.weights[vertex]);
    if (weights_.weights.back()[0] >= kRigidWeight)
      rigid_vertices_[weights_.bones.back()[0]].push_back(index);
  }
}

std::vector<float> TemplateDistance::Of(const std::vector<Vector3f>& posed) const {
  BoneTransforms posed_from_rest(kBoneCount);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const std::vector<int>& vertices = rigid_vertices_[bone];
    if (vertices.size() < kFewestVertices) continue;
    posed_from_rest[bone] = FitRigid(vertices.size(), [&](std::size_t k) {
      return PointPair{rest_[vertices[k]].cast<double>(), posed[vertices[k]].cast<double>()};
    });
  }
  std::vector<Vector3f> skinned;
  SkinLinear(rest_, weights_, posed_from_rest, skinned);
  std::vector<float> distances_m;
  for (std::size_t v = 0; v < posed.size(); ++v)
    distances_m.push_back((posed[v] - skinned[v]).norm());
  return distances_m;
}

}  // namespace vitruvia
