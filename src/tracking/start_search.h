// Finds the subject's first pose in a frame, in any pose and at any heading.
#pragma once

#include <memory>
#include <string>

#include "config/settings.h"
#include "fitting/depth_target.h"
#include "fitting/pose_search.h"
#include "fitting/search_settings.h"
#include "math/rigid.h"
#include "tracking/tracker.h"

namespace vitruvia {

// How a tracker gets its first pose.
enum class Start {
  kRestPose,  // as in the papers: the subject stands in the rest pose and faces the camera
  kSearch,    // not in the papers: any pose of a library, at any heading
};
// Describes a method's setting of that type.
void DescribeStart(Fields& fields, Start& start);

struct FoundStart {
  bool found = false;
  BodyState state;                  // of the best hypothesis, even if `found` is false
  BoneTransforms camera_from_rest;  // in that state
  MutualDistance distance;
  double margin = 0.0;  // see SearchOutcome
  std::string message;  // confidence of the result, for the user
};

class StartSearch {
 public:
  StartSearch(const Subject& subject, const PinholeCamera& camera, double max_depth_m,
              const PoseSearchSettings& settings);

  // The frame must show the person alone. If joints are known, the search starts from them.
  FoundStart Find(const DepthImage& depth, const KnownJoints& known);

 private:
  SearchOutcome Search(DepthTarget& coarse_target, DepthTarget& fine_target,
                       const KnownJoints& known);

  PoseSearchSettings settings_;
  PinholeCamera camera_;
  double max_depth_m_;
  ShapedBody fine_body_, coarse_body_;
  PoseFit fine_{fine_body_}, coarse_{coarse_body_};
  std::vector<PoseHypothesis> hypotheses_;  // of the search at hand
};

// The message of the first tracked frame: the start's message and that of its tracking.
std::string WithStart(const std::string& start, const std::string& ending);

}  // namespace vitruvia
