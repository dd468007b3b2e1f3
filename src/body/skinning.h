// Skinning weights, linear blend skinning and dual quaternion skinning.
#pragma once

#include <cstdint>
#include <vector>

#include "body/skeleton.h"
#include "geometry/mesh.h"

namespace vitruvia {

inline constexpr int kMaxInfluences = 4;  // paper A, |N| = 4

// At most four bones for each vertex; unused slots have weight 0. Weights are ≥ 0 and sum to 1.
struct SkinWeights {
  std::vector<std::array<std::uint8_t, kMaxInfluences>> bones;
  std::vector<std::array<float, kMaxInfluences>> weights;  // largest first

  std::size_t size() const { return bones.size(); }
};

// Keeps each row's four largest entries and normalises them. `dense` is V × B.
SkinWeights Sparsified(const Eigen::MatrixXf& dense);
Eigen::MatrixXf Dense(const SkinWeights& weights, int bone_count);

// "" if the weights are valid for that many vertices and bones; otherwise a message that names the
// vertex and the problem.
std::string WeightsProblem(const SkinWeights& weights, std::size_t vertex_count, int bone_count);

// v = Σ w (R v̄ + T) (paper A, eq. 2a). `posed` is resized to the number of vertices.
void SkinLinear(const std::vector<Vector3f>& rest_vertices, const SkinWeights& weights,
                const BoneTransforms& posed_from_rest, std::vector<Vector3f>& posed);

// v = b̂(v̄), where b̂ is the normalised blend of the bones' dual quaternions, each flipped into
// the hemisphere of the one with the largest weight (paper B, eqs. 3 and 4).
void SkinDualQuaternion(const std::vector<Vector3f>& rest_vertices, const SkinWeights& weights,
                        const BoneTransforms& posed_from_rest, std::vector<Vector3f>& posed);

}  // namespace vitruvia
