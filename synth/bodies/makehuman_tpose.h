// From MakeHuman's A-pose with bent elbows to the T-pose: metres, subject frame, feet on y = 0.
#pragma once

#include <vector>

#include "body/skinning.h"
#include "synth/bodies/makehuman_package.h"

namespace vitruvia {

struct TPosedMakeHuman {
  std::vector<Vector3f> body_vertices;  // kMakeHumanBodyVertices
  Skeleton skeleton;
};

// The arms are rotated to ±x, with straight elbows and palms down; legs and feet are unchanged. The
// change is skinned with the package's weights and dual quaternions.
class MakeHumanTPose {
 public:
  explicit MakeHumanTPose(const MakeHumanPackage& package);  // which must outlive this

  TPosedMakeHuman Apply(const std::vector<Vector3f>& vertices) const;  // all, decimetres

 private:
  const MakeHumanPackage& package_;
  SkinWeights arm_weights_;
};

// Weights of the package's bones merged to the skeleton's: each bone is merged into its nearest
// ancestor that has a counterpart.
SkinWeights MergedWeights(const MakeHumanPackage& package);

}  // namespace vitruvia
