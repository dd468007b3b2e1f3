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

// The arms are turned to ±x, elbows straight, palms down; legs and feet stay as they stand. The
// package's own weights skin the change, with dual quaternions.
class MakeHumanTPose {
 public:
  explicit MakeHumanTPose(const MakeHumanPackage& package);  // which must outlive this

  TPosedMakeHuman Apply(const std::vector<Vector3f>& vertices) const;  // all, decimetres

 private:
  const MakeHumanPackage& package_;
  SkinWeights arm_weights_;
};

// The package's bones merged to ours: each goes with its nearest ancestor that has a counterpart.
SkinWeights MergedWeights(const MakeHumanPackage& package);

}  // namespace vitruvia
