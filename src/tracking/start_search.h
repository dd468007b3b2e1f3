// Finds the subject in a frame, in any pose and facing anywhere, for a tracker to start from.
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
  kRestPose,  // papers: the subject stands in the rest pose and faces the camera
  kSearch,    // ours: any pose of a library, at any heading
};
// Describes a method's field of that type.
void DescribeStart(Fields& fields, Start& start);

struct FoundStart {
  bool found = false;
  BodyState state;                  // of the best hypothesis, also where it is not trusted
  BoneTransforms camera_from_rest;  // in that state
  MutualDistance distance;
  double margin = 0.0;  // see SearchOutcome
  std::string message;  // how sure it is
};

class StartSearch {
 public:
  StartSearch(const Subject& subject, const PinholeCamera& camera, double max_depth_m,
              const PoseSearchSettings& settings);

  // The frame's measurements are the person's. Where joints are known the search begins at them.
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

// The message of the first frame that is tracked: how its start was found, and how it ended.
std::string WithStart(const std::string& start, const std::string& ending);

}  // namespace vitruvia
