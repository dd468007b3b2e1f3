#include "learning/skinning/fit_errors.h"

#include "core/error.h"
#include "math/rigid.h"

namespace vitruvia::skinning {

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

}  // namespace vitruvia::skinning
