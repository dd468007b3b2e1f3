// Where the bones of an estimated surface are: by the vertices that follow them most.
#pragma once

#include <vector>

#include "body/body_model.h"

namespace vitruvia {

class BonePlacement {
 public:
  // The surface's rest pose is the subject's; its vertices have the weights of the subject's
  // vertices nearest to them.
  BonePlacement(const std::vector<Vector3f>& rest_vertices, const BodyModel& subject);

  // The rigid motions, one for each bone, that carry the rest pose nearly onto the posed surface by
  // linear blending: each in turn fitted to what the others leave (block coordinate descent). A
  // bone that no vertex follows goes with its parent.
  BoneTransforms Fit(const std::vector<Vector3f>& posed) const;

  // How far each vertex is from where those motions carry it, metres: for methods that warp their
  // template the length of the warps.
  std::vector<float> Warps(const std::vector<Vector3f>& posed) const;

  // The bone that each vertex follows most.
  std::vector<std::uint8_t> BoneOfVertex() const;

 private:
  // A vertex that follows a bone about as much as any does.
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
