#include "tracking/start_search.h"

#include <cmath>

#include <fmt/format.h>

#include "fitting/depth_search.h"
#include "math/rigid.h"

namespace vitruvia {
namespace {

constexpr DepthTargetSettings kCoarseFrame{80, 1500, 300};
constexpr DepthTargetSettings kFineFrame{160, 4000, 600};

DepthTargetSettings Within(DepthTargetSettings settings, double max_depth_m) {
  settings.max_depth_m = static_cast<float>(max_depth_m);
  return settings;
}

}  // namespace

void DescribeStart(Fields& f, Start& start) {
  f.Choice(
      "start", start, {{"rest_pose", Start::kRestPose}, {"search", Start::kSearch}},
      {.meaning = "how the first pose is found: rest_pose: the subject stands in the rest pose "
                  "and faces the camera; search: any pose of a library at any heading",
       .origin = Origin::kPaper,
       .source = "both papers start from the rest pose"});
}

StartSearch::StartSearch(const Subject& subject, const PinholeCamera& camera, double max_depth_m,
                         const PoseSearchSettings& settings)
    : settings_(settings),
      camera_(camera),
      max_depth_m_(max_depth_m),
      fine_body_(RigidShape(subject, settings.fine_vertices)),
      coarse_body_(Coarser(fine_body_, settings.coarse_vertices)) {}

SearchOutcome StartSearch::Search(DepthTarget& coarse_target, DepthTarget& fine_target,
                                  const KnownJoints& known) {
  FitPriors priors;
  priors.angle_deviation_deg = settings_.angle_deviation_deg;
  // Wider than for the verdict: while poses are compared their surfaces are not in place yet.
  const NearFar limits{2.0 * settings_.near_m, settings_.far_m};
  const Matrix3<double> facing_camera = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  if (known.joints.empty()) {
    hypotheses_ = StartHypotheses(facing_camera, settings_.headings, Eigen::VectorXd());
    return SearchDepth(hypotheses_, {&coarse_, &fine_, &coarse_target, &fine_target}, priors,
                       limits);
  }
  hypotheses_ = StartHypotheses(facing_camera, 1, Eigen::VectorXd());
  for (PoseHypothesis& h : hypotheses_) {
    h.state = FittedToJoints(coarse_body_, h.state, known, settings_.angle_deviation_deg);
  }
  return SearchPose(hypotheses_,
                    {{&coarse_, &coarse_target, {4, 0.2, 0.12, 0.3, false}, 6},
                     {&fine_, &fine_target, {12, 0.15, 0.05, 0.0, false}, 2}},
                    priors, limits);
}

FoundStart StartSearch::Find(const DepthImage& depth, const KnownJoints& known) {
  DepthTarget coarse_target(depth, camera_, Within(kCoarseFrame, max_depth_m_));
  DepthTarget fine_target(depth, camera_, Within(kFineFrame, max_depth_m_));
  FoundStart start;
  if (fine_target.is_empty() || coarse_target.is_empty()) {
    start.message = "not found: the frame holds too few measurements";
    return start;
  }
  const SearchOutcome found = Search(coarse_target, fine_target, known);
  start.state = found.best.state;
  start.camera_from_rest = WorldFromRest(fine_body_, start.state);
  start.distance =
      fine_.Measure(fine_target, start.state, settings_.LimitsAt(fine_target.Center().z()));
  start.margin = found.margin;
  const MutualDistance& d = start.distance;
  start.found = d.target_explained >= settings_.least_explained &&
                d.body_explained >= settings_.least_explained;
  start.message = fmt::format(
      "{}: from {}, {}: {:.0f} % of the points and {:.0f} % of the body "
      "explained (expected at least {:.0f} %), {}",
      start.found ? "found" : "not found", found.best.start->pose,
      known.joints.empty() ? fmt::format("heading {:.0f} degrees", found.best.start->heading_deg)
                           : fmt::format("{} joints known", known.joints.size()),
      100.0 * d.target_explained, 100.0 * d.body_explained, 100.0 * settings_.least_explained,
      std::isfinite(start.margin)
          ? fmt::format("the second-best pose is {:.0f} % farther", 100.0 * start.margin)
          : "no other pose came near");
  return start;
}

std::string WithStart(const std::string& start, const std::string& ending) {
  return ending.empty() ? start : start + "; " + ending;
}

}  // namespace vitruvia
