// Skinning weights from a single mesh and its skeleton, by heat diffusion (Baran & Popović,
// "Automatic rigging and animation of 3D characters", SIGGRAPH 2007, sec. 4).
//
// Each bone is a segment from its joint to its tip. The weights w_j of bone j are the equilibrium
// temperatures of a surface whose vertices are heated by their nearest bone: (L + M H) w_j = M H
// p_j, L the cotangent Laplacian (positive semidefinite), M a third of each vertex' triangle area,
// p_j 1 where bone j is the nearest one (bones of equal distance share it), H = heat / d² with d
// the distance to it, and 0 where the bone is not visible from the vertex. One sparse Cholesky
// factorisation serves all bones. Weights of a vertex sum to one by construction; the four largest
// are kept.
#pragma once

#include "body/skinning.h"
#include "config/settings.h"

namespace vitruvia::skinning {

struct HeatWeightSettings {
  double heat = 1.0;
  double visible_angle_deg = 60.0;

  void Describe(Fields& fields);
};

// The nearest bones of a vertex and their distance, which determine its heat.
struct BoneContact {
  std::vector<std::uint8_t> bones;  // of equal distance; those that are visible
  double distance_m = 0.0;          // to the nearest bone, visible or not
};
std::vector<BoneContact> NearestVisibleBones(const TriangleMesh& rest, const Skeleton& skeleton,
                                             double visible_angle_deg);

// V × kBoneCount before the four largest are taken. DataError if a piece of the mesh sees no bone.
Eigen::MatrixXd HeatDistribution(const TriangleMesh& rest, const std::vector<BoneContact>& contacts,
                                 double heat);

// The mesh must be closed (InspectMesh), in the subject frame, metres.
SkinWeights HeatWeights(const TriangleMesh& rest, const Skeleton& skeleton,
                        const HeatWeightSettings& settings);

}  // namespace vitruvia::skinning
