// Finds a body's pose without a known start: many hypotheses, from coarse to fine.
#pragma once

#include <vector>

#include "fitting/pose_fit.h"

namespace vitruvia {

struct PoseHypothesis {
  BodyState state;
  const char* pose = "";     // name of the pose that it starts from
  double heading_deg = 0.0;  // rotation to the subject's left from the front direction of the
                             // search
};

// Every start pose at each of `headings` evenly spaced headings. `world_from_front` rotates a body
// in the rest pose so that it faces the front direction.
std::vector<PoseHypothesis> StartHypotheses(const Matrix3<double>& world_from_front, int headings,
                                            const Eigen::VectorXd& theta);

// Mean joint distance below which two poses count as the same.
inline constexpr double kSamePose_m = 0.05;

struct FoundPose {
  const PoseHypothesis* start = nullptr;
  BodyState state;
  MutualDistance distance;
};

// A level of the search: body and target at the level's resolution, and the fit to run.
struct SearchLevel {
  PoseFit* fit = nullptr;
  FitTarget* target = nullptr;
  FitStage stage;
  int kept = 1;  // number of best hypotheses that go on to the next level
};

struct SearchOutcome {
  FoundPose best;
  // Relative excess of the distance of the best hypothesis that ended in another pose. Infinite if
  // all refined hypotheses ended in the same pose.
  double margin = 0.0;
};

// Passes the hypotheses, which must outlive the outcome, through the levels; at each level, those
// near a better one are dropped. Equally good ones keep the order of the hypotheses.
SearchOutcome SearchPose(const std::vector<PoseHypothesis>& hypotheses,
                         const std::vector<SearchLevel>& levels, FitPriors priors,
                         const NearFar& limits);

// Mean distance of the joints of two states of a body, metres.
double MeanJointDistance(const ShapedBody& body, const BodyState& a, const BodyState& b);

}  // namespace vitruvia
