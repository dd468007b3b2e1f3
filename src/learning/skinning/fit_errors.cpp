#include "learning/skinning/fit_errors.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace vitruvia::skinning {
namespace {

constexpr double kGoldenRatio =
    0.61803398874989485;  // steps of hue by it never come near each other
constexpr float kLeastBrightness = 0.25f;

// The colour of full saturation with that hue, 0 … 1.
Vector3f Hue(double hue) {
  Vector3f colour;
  for (int channel = 0; channel < 3; ++channel) {
    const double turn = std::fmod(hue + channel / 3.0, 1.0);  // distance from the channel's own hue
    const double strength = std::clamp(std::abs(6.0 * turn - 3.0) - 1.0, 0.0, 1.0);
    colour[channel] = kLeastBrightness + (1.0f - kLeastBrightness) * static_cast<float>(strength);
  }
  return colour;
}

}  // namespace

std::vector<std::vector<float>> VertexErrors(const Examples& examples, const SkinWeights& weights,
                                             const std::vector<BoneTransforms>& poses) {
  Require(poses.size() == examples.poses.size(),
          "VertexErrors: transforms of {} poses, expected {}", poses.size(), examples.poses.size());
  std::vector<std::vector<float>> errors(poses.size());
  std::vector<Vector3f> skinned;
  for (std::size_t p = 0; p < poses.size(); ++p) {
    SkinLinear(examples.rest, weights, poses[p], skinned);
    Require(examples.poses[p].size() == skinned.size(), "VertexErrors: {} vertices, expected {}",
            examples.poses[p].size(), skinned.size());
    errors[p].resize(skinned.size());
    for (std::size_t v = 0; v < skinned.size(); ++v) {
      errors[p][v] = (skinned[v] - examples.poses[p][v]).norm();
    }
  }
  return errors;
}

std::vector<Vector3f> BoneColours(const SkinWeights& weights, int bone_count) {
  std::vector<Vector3f> of_bones(bone_count);
  for (int bone = 0; bone < bone_count; ++bone) {
    of_bones[bone] = Hue(std::fmod(bone * kGoldenRatio, 1.0));
  }
  std::vector<Vector3f> colours(weights.size(), Vector3f::Zero());
  for (std::size_t v = 0; v < colours.size(); ++v) {
    for (int k = 0; k < kMaxInfluences; ++k) {
      if (!(weights.weights[v][k] > 0.0f)) continue;
      Require(weights.bones[v][k] < bone_count, "BoneColours: bone {}, but there are {}",
              weights.bones[v][k], bone_count);
      colours[v] += weights.weights[v][k] * of_bones[weights.bones[v][k]];
    }
  }
  return colours;
}

}  // namespace vitruvia::skinning
