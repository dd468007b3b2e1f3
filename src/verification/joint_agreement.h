// How well depth images agree with the true joints. For this module's own files.
#pragma once

#include <vector>

#include "sequence/sequence.h"

namespace vitruvia {

struct JointAgreement {
  int visible = 0;             // joints that the truth calls visible
  int seen = 0;                // of these: project onto measured depth
  int agreeing = 0;            // of these: lie behind it as far as a joint lies below skin
  std::vector<double> ratios;  // depth / z of the joints that are seen

  double Score() const { return visible == 0 ? 0.0 : static_cast<double>(agreeing) / visible; }
};

void AddFrame(const DepthImage& depth, const PinholeCamera& camera,
              const std::vector<Vector3<double>>& visible_joints, JointAgreement& sum);

// Those of one frame that are known and marked visible.
std::vector<Vector3<double>> VisibleTrueJoints(const JointTruth& truth);

}  // namespace vitruvia
