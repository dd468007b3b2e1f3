#include "scoring/bone_placement.h"

#include <algorithm>

#include "math/rigid_fit.h"
#include "metrics/nearest_vertices.h"

namespace vitruvia {
namespace {

constexpr double kFollowsShare = 0.8;  // of the largest weight that a bone has anywhere
constexpr int kSweeps = 5;             // over all bones
constexpr std::size_t kFewestFollowers = 3;

}  // namespace

BonePlacement::BonePlacement(const std::vector<Vector3f>& rest_vertices, const BodyModel& subject)
    : rest_(rest_vertices), followers_(kBoneCount) {
  std::array<double, kBoneCount> largest{};
  for (const int vertex : NearestVertices(rest_vertices, subject.rest.vertices)) {
    weights_.bones.push_back(subject.weights.bones[vertex]);
    weights_.weights.push_back(subject.weights.weights[vertex]);
    for (int k = 0; k < kMaxInfluences; ++k) {
      double& most = largest[weights_.bones.back()[k]];
      most = std::max<double>(most, weights_.weights.back()[k]);
    }
  }
  for (std::size_t v = 0; v < weights_.size(); ++v) {
    for (int k = 0; k < kMaxInfluences; ++k) {
      const int bone = weights_.bones[v][k];
      const double weight = weights_.weights[v][k];
      if (weight > 0.0 && weight >= kFollowsShare * largest[bone])
        followers_[bone].push_back({static_cast<int>(v), weight});
    }
  }
}

// Each follower's place less what the other bones do to it, as the bone alone would have to carry
// it.
Rigidd BonePlacement::FitBone(int bone, const std::vector<Vector3f>& posed,
                              const BoneTransforms& others) const {
  const std::vector<Follower>& followers = followers_[bone];
  return FitRigid(followers.size(), [&](std::size_t i) {
    const auto [v, weight] = followers[i];
    const Vector3d rest = rest_[v].cast<double>();
    Vector3d place = posed[v].cast<double>();
    for (int k = 0; k < kMaxInfluences; ++k) {
      const int other = weights_.bones[v][k];
      if (other != bone) place -= weights_.weights[v][k] * (others[other] * rest);
    }
    return PointPair{rest, place / weight};
  });
}

BoneTransforms BonePlacement::Fit(const std::vector<Vector3f>& posed) const {
  BoneTransforms bones(kBoneCount);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const std::vector<Follower>& followers = followers_[bone];
    if (followers.size() < kFewestFollowers) {
      if (Bones()[bone].parent >= 0) bones[bone] = bones[Bones()[bone].parent];
      continue;
    }
    bones[bone] = FitRigid(followers.size(), [&](std::size_t i) {
      const int v = followers[i].vertex;
      return PointPair{rest_[v].cast<double>(), posed[v].cast<double>()};
    });
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int bone = 0; bone < kBoneCount; ++bone) {
      if (followers_[bone].size() >= kFewestFollowers) bones[bone] = FitBone(bone, posed, bones);
    }
  }
  return bones;
}

std::vector<float> BonePlacement::Warps(const std::vector<Vector3f>& posed) const {
  std::vector<Vector3f> skinned;
  SkinLinear(rest_, weights_, Fit(posed), skinned);
  std::vector<float> warps_m;
  for (std::size_t v = 0; v < posed.size(); ++v) warps_m.push_back((posed[v] - skinned[v]).norm());
  return warps_m;
}

std::vector<std::uint8_t> BonePlacement::BoneOfVertex() const {
  std::vector<std::uint8_t> bones;
  for (const auto& row : weights_.bones) bones.push_back(row[0]);
  return bones;
}

}  // namespace vitruvia
