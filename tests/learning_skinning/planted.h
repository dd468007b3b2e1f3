// A limb of known weights and bones, and examples made of it by linear blend skinning.
#pragma once

#include <cmath>

#include "core/random.h"
#include "learning/skinning/examples.h"
#include "learning/skinning/labels.h"
#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia::skinning {

struct Planted {
  SkinWeights weights;
  std::vector<BoneTransforms> bones;  // P × B
  Examples examples;
  Labels labels;
  BoneGraph candidates;
};

struct PlantedShape {
  int vertices = 400, bones = 5, poses = 12, influences = 3;
  double noise_m = 0.0, bend_rad = 0.7;
  Vector3d where_m = Vector3d::Zero();  // the whole limb, at rest and posed
  std::uint64_t seed = 1;
};

inline constexpr double kBoneLength_m = 0.3, kLimbRadius_m = 0.06;

// Smooth weights along a chain of bones: the nearest few, falling with the squared distance to
// their middles.
inline SkinWeights ChainWeights(const PlantedShape& shape, const std::vector<Vector3f>& rest) {
  Eigen::MatrixXf dense = Eigen::MatrixXf::Zero(shape.vertices, shape.bones);
  for (int v = 0; v < shape.vertices; ++v) {
    const double along_m = rest[v].x() - shape.where_m.x();
    std::vector<std::pair<double, int>> nearest;
    for (int b = 0; b < shape.bones; ++b) {
      nearest.emplace_back(std::abs(along_m - (b + 0.5) * kBoneLength_m), b);
    }
    std::sort(nearest.begin(), nearest.end());
    for (int k = 0; k < shape.influences; ++k) {
      const double reach = nearest[k].first / (0.6 * kBoneLength_m);
      dense(v, nearest[k].second) = static_cast<float>(std::exp(-reach * reach));
    }
  }
  return Sparsified(dense);
}

inline BoneTransforms RandomChain(const PlantedShape& shape, RandomStream& random) {
  BoneTransforms bones(shape.bones);
  Rigidd motion;
  for (int b = 0; b < shape.bones; ++b) {
    const Vector3d joint = shape.where_m + Vector3d(b * kBoneLength_m, 0.0, 0.0);
    const Vector3d turn = Vector3d::NullaryExpr(
        [&](Eigen::Index) { return random.Uniform(-shape.bend_rad, shape.bend_rad); });
    motion = motion * RotationAbout<double>(ExpSo3<double>(turn), joint);
    bones[b] = motion;
  }
  return bones;
}

inline Planted Plant(const PlantedShape& shape) {
  RandomStream random(shape.seed, "planted");
  Planted planted;
  for (int v = 0; v < shape.vertices; ++v) {
    const double angle = random.Uniform(0.0, 6.28);
    const Vector3d point(random.Uniform(0.0, shape.bones * kBoneLength_m),
                         kLimbRadius_m * std::cos(angle), kLimbRadius_m * std::sin(angle));
    planted.examples.rest.push_back((point + shape.where_m).cast<float>());
  }
  planted.weights = ChainWeights(shape, planted.examples.rest);
  for (int p = 0; p < shape.poses; ++p) {
    planted.bones.push_back(RandomChain(shape, random));
    SkinLinear(planted.examples.rest, planted.weights, planted.bones.back(),
               planted.examples.poses.emplace_back());
    for (Vector3f& vertex : planted.examples.poses.back()) {
      for (float& x : vertex) x += static_cast<float>(random.Normal(0.0, shape.noise_m));
    }
  }
  planted.labels = HeaviestBones(planted.weights);
  BoneGraph chain(shape.bones);
  for (int b = 0; b + 1 < shape.bones; ++b) {
    chain[b].push_back(static_cast<std::uint8_t>(b + 1));
    chain[b + 1].push_back(static_cast<std::uint8_t>(b));
  }
  planted.candidates = BonesWithin(chain, 2, shape.bones);
  return planted;
}

// Root mean square distance of the skinned rest pose from the examples, in double precision.
inline double SlowRmse(const Examples& examples, const SkinWeights& weights,
                       const std::vector<BoneTransforms>& poses) {
  double sum = 0.0;
  for (std::size_t p = 0; p < poses.size(); ++p) {
    for (std::size_t v = 0; v < examples.rest.size(); ++v) {
      Vector3d place = Vector3d::Zero();
      for (int k = 0; k < kMaxInfluences; ++k) {
        place += static_cast<double>(weights.weights[v][k]) *
                 (poses[p][weights.bones[v][k]] * examples.rest[v].cast<double>().eval());
      }
      sum += (place - examples.poses[p][v].cast<double>()).squaredNorm();
    }
  }
  return std::sqrt(sum / static_cast<double>(poses.size() * examples.rest.size()));
}

}  // namespace vitruvia::skinning
