#include "methods/skeleton_driven/settings.h"

namespace vitruvia::skeleton_driven {

void DetectorSettings::Describe(Fields& f) {
  f.File("model", model, {.meaning = "folder of a joint model (vitruvia learn joints)"});
  f.Section("votes", votes, {.meaning = "how pixels vote for joints"});
}

void Settings::Describe(Fields& f) {
  f.Choice("joints", joints, {{"detector", JointSource::kDetector}, {"file", JointSource::kFile}},
           {.meaning = "who finds the joints: the learnt detector in every frame anew, or a file "
                       "of observations, which may come from a stand-in with stated noise",
            .origin = Origin::kPaper,
            .source = "paper A, fig. 9: the joints of a Kinect's tracker"});
  if (f.Applies(joints == JointSource::kDetector)) {
    f.Section("detector", detector, {.meaning = "the learnt detector"});
  }
  if (f.Applies(joints == JointSource::kFile)) {
    f.File("observations", observations,
           {.meaning = "file of joint observations (vitruvia stand-in-joints)"});
  }
  f.Section("pose", pose, {.meaning = "inverse kinematics"});
  f.Section("weights", weights, {.meaning = "skinning weights from the subject's mesh"});
  f.Number("max_depth_m", max_depth_m,
           {.meaning = "pixels beyond this are no measurement",
            .unit = "m",
            .min = 0.1,
            .max = 100.0,
            .origin = Origin::kGuessed});
  f.Number("lost_above_m", lost_above_m,
           {.meaning = "lost if a skeleton of the subject's bone lengths misses the found joints "
                       "by more in the median",
            .unit = "m",
            .min = 0.0,
            .max = 10.0,
            .origin = Origin::kGuessed});
}

std::string Settings::Problem() const {
  if (joints == JointSource::kDetector && detector.model.empty()) {
    return "detector.model: expected the folder of a joint model, made by vitruvia learn joints; "
           "got none";
  }
  if (joints == JointSource::kFile && observations.empty()) {
    return "observations: expected a file of joint observations; got none";
  }
  return "";
}

}  // namespace vitruvia::skeleton_driven
