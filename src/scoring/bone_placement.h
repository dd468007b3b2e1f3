// Bone poses of an estimated surface, fitted to the vertices with large weights for each bone.
#pragma once

#include <vector>

#include "body/body_model.h"

namespace vitruvia {

class BonePlacement {
 public:
  // The surface's rest pose must be the subject's; each vertex takes the weights of the nearest
  // vertex of the subject.
  BonePlacement(const std::vector<Vector3f>& rest_vertices, const BodyModel& subject);

  // The rigid motions of the bones that approximately map the rest pose to the posed surface by
  // linear blend skinning, by block coordinate descent: each bone in turn is fitted to the residual
  // of the others. A bone that no vertex follows moves with its parent.
  BoneTransforms Fit(const std::vector<Vector3f>& posed) const;

  // Distance of each vertex from its place under those motions, metres: for methods that warp their
  // template, the length of the warps.
  std::vector<float> Warps(const std::vector<Vector3f>& posed) const;

  // The bone of each vertex's largest weight.
  std::vector<std::uint8_t> BoneOfVertex() const;

 private:
  // A vertex whose weight for a bone is near the bone's maximum.
  struct Follower {
    int vertex;
    double weight;
  };
  Rigidd FitBone(int bone, const std::vector<Vector3f>& posed, const BoneTransforms& others) const;

  std::vector<Vector3f> rest_;
  SkinWeights weights_;
  std::vector<std::vector<Follower>> followers_;  // by bone
};

}  // namespace vitruvia
