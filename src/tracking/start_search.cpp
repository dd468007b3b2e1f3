#include "tracking/start_search.h"

#include <cmath>

#include <fmt/format.h>

#include "math/rigid.h"

namespace vitruvia {
namespace {

constexpr DepthTargetSettings kCoarseFrame{80, 1500, 300};
constexpr DepthTargetSettings kFineFrame{160, 4000, 1000};

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

void StartSearchSettings::Describe(Fields& f) {
  f.Integer("headings", headings,
            {.meaning = "directions, evenly spaced, in which each start pose of the search faces",
             .min = 1,
             .max = 72,
             .origin = Origin::kGuessed});
  f.Integer("coarse_vertices", coarse_vertices,
            {.meaning = "vertices of the subject while start poses are compared",
             .min = 100,
             .max = 100000,
             .origin = Origin::kGuessed});
  f.Integer("fine_vertices", fine_vertices,
            {.meaning = "vertices of the subject while the best start poses are refined",
             .min = 100,
             .max = 100000,
             .origin = Origin::kGuessed});
  f.Number("angle_deviation_deg", angle_deviation_deg,
           {.meaning = "standard deviation of a joint angle from its start pose",
            .unit = "deg",
            .min = 1.0,
            .max = 180.0,
            .origin = Origin::kGuessed});
  f.Number("near_m", near_m,
           {.meaning = "distance within which subject and frame explain each other",
            .unit = "m",
            .min = 0.001,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("far_m", far_m,
           {.meaning = "distance beyond which subject and frame are equally far from each other",
            .unit = "m",
            .min = 0.001,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("least_explained", least_explained,
           {.meaning = "share of the frame's points, and of the subject's vertices that the frame "
                       "can judge, that must be explained for the subject to be found",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
}

StartSearch::StartSearch(const Subject& subject, const PinholeCamera& camera, double max_depth_m,
                         const StartSearchSettings& settings)
    : settings_(settings),
      camera_(camera),
      max_depth_m_(max_depth_m),
      fine_body_(RigidShape(subject, settings.fine_vertices)),
      coarse_body_(Coarser(fine_body_, settings.coarse_vertices)) {}

FoundStart StartSearch::Find(const DepthImage& depth) {
  DepthTarget coarse_target(depth, camera_, Within(kCoarseFrame, max_depth_m_));
  DepthTarget fine_target(depth, camera_, Within(kFineFrame, max_depth_m_));
  FoundStart start;
  if (fine_target.is_empty() || coarse_target.is_empty()) {
    start.message = "not found: the frame holds too few measurements";
    return start;
  }
  const std::vector<SearchLevel> levels{{&coarse_, &coarse_target, {4, 0.6, 0.3, 1.0, false}, 24},
                                        {&coarse_, &coarse_target, {8, 0.3, 0.12, 0.3, false}, 8},
                                        {&fine_, &fine_target, {12, 0.15, 0.05, 0.0, false}, 2}};
  FitPriors priors;
  priors.angle_deviation_deg = settings_.angle_deviation_deg;
  const Matrix3<double> facing_camera = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  const std::vector<PoseHypothesis> hypotheses =
      StartHypotheses(facing_camera, settings_.headings, Eigen::VectorXd());
  const SearchOutcome found =
      SearchPose(hypotheses, levels, priors, {settings_.near_m, settings_.far_m});
  start.state = found.best.state;
  start.camera_from_rest = WorldFromRest(fine_body_, start.state);
  start.distance = found.best.distance;
  start.margin = found.margin;
  const MutualDistance& d = start.distance;
  start.found = d.target_explained >= settings_.least_explained &&
                d.body_explained >= settings_.least_explained;
  start.message = fmt::format(
      "{}: from {}, heading {:.0f} degrees: {:.0f} % of the points and {:.0f} % of the body "
      "explained (expected at least {:.0f} %), {}",
      start.found ? "found" : "not found", found.best.start->pose, found.best.start->heading_deg,
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
