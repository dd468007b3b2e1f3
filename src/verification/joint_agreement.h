// Agreement of depth images with the true joints. Internal to this module.
#pragma once

#include <vector>

#include "sequence/sequence.h"

namespace vitruvia {

struct JointAgreement {
  int visible = 0;             // joints marked visible in the truth
  int seen = 0;                // of these: project onto measured depth
  int agreeing = 0;            // of these: lie behind it by the depth of a joint below the skin
  std::vector<double> ratios;  // depth / z of the joints that are seen

  double Score() const { return visible == 0 ? 0.0 : static_cast<double>(agreeing) / visible; }
};

void AddFrame(const DepthImage& depth, const PinholeCamera& camera,
              const std::vector<Vector3<double>>& visible_joints, JointAgreement& sum);

// The joints of one frame that are known and marked visible.
std::vector<Vector3<double>> VisibleTrueJoints(const JointTruth& truth);

}  // namespace vitruvia
