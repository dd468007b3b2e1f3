// Seeded starts: people in poses of daily life, facing anywhere, before a Kinect v1; a tracker that
// knows nothing of the pose has to find them.
#pragma once

#include <string>
#include <vector>

#include "body/anatomical_pose.h"
#include "body/body_model.h"
#include "tracking/tracker.h"

namespace vitruvia {

// Who stands there: what is seen (dual quaternion skinning with spread weights, noise) differs from
// the subject that the tracker is given (linear skinning, fewer vertices).
struct StartPerson {
  std::string name;
  Subject subject;
  BodyModel truth;
};
// Two men, two women, and a child of 1 m.
std::vector<StartPerson> StartPeople();

struct StartPosture {
  std::string name;
  AnatomicalPose pose;
};
// Ten postures; those of body/start_poses.h are others, or differ in their angles.
std::vector<StartPosture> StartPostures();

struct StartTrial {
  int person = 0, posture = 0;
  double heading_deg = 0.0;  // 0: faces the camera
  int seed = 0;              // of deviations from the posture and heading, distance, noise
  bool is_tuned_on = false;  // the search's constants were chosen by it
};
// All people × postures × four headings. Of each person and posture two opposite headings are tuned
// on, in turn the front and back and the two sides.
std::vector<StartTrial> AllStartTrials();

struct StartResult {
  bool found = false;  // by the tracker's own word, after the first frame
  std::string message;
  double first_error_m = 0.0;  // mean distance of the joints after the first frame
  double last_error_m = 0.0;   // after the last
  bool swapped = false;        // left and right, after the first frame
  double first_ms = 0.0;       // processor time of the first frame
};
// `frames` frames of the person at rest, each with noise of its own.
StartResult RunStartTrial(const StartTrial& trial, const StartPerson& person,
                          const StartPosture& posture, Tracker& tracker, int frames);

}  // namespace vitruvia
