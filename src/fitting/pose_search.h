// Finds a body's pose without a start that is known: many hypotheses, coarse to fine.
#pragma once

#include <vector>

#include "fitting/pose_fit.h"

namespace vitruvia {

struct PoseHypothesis {
  BodyState state;
  const char* pose = "";     // name of the pose that it starts from
  double heading_deg = 0.0;  // turn to the subject's left, from where the search's front is
};

// Each pose of the library at each of the headings, evenly spaced. `world_from_front` turns a body
// in the rest pose so that it looks to the front.
std::vector<PoseHypothesis> StartHypotheses(const Matrix3<double>& world_from_front, int headings,
                                            const Eigen::VectorXd& theta);

// Mean distance of the joints below which two poses are one.
inline constexpr double kSamePose_m = 0.05;

struct FoundPose {
  const PoseHypothesis* start = nullptr;
  BodyState state;
  MutualDistance distance;
};

// A level of the search: a body and the target as that level sees it, and what is done with them.
struct SearchLevel {
  PoseFit* fit = nullptr;
  FitTarget* target = nullptr;
  FitStage stage;
  int kept = 1;  // of the hypotheses, the best ones, that go on to the next level
};

struct SearchOutcome {
  FoundPose best;
  // Of the best hypothesis that ended elsewhere: by what share its distance is larger. Infinite if
  // all that were refined ended in one pose.
  double margin = 0.0;
};

// The hypotheses, which must outlive the outcome, go through the levels; at each, those near a
// better one are dropped. Order of equal ones is that of the hypotheses.
SearchOutcome SearchPose(const std::vector<PoseHypothesis>& hypotheses,
                         const std::vector<SearchLevel>& levels, FitPriors priors,
                         const NearFar& limits);

// Mean distance of the joints of two states of a body, metres.
double MeanJointDistance(const ShapedBody& body, const BodyState& a, const BodyState& b);

}  // namespace vitruvia
