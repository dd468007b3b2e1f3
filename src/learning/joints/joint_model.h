// A detector of joints in one depth image: regression forests that walk from joint to joint.
//
// After the random tree walk (Jung, Lee, Heo & Yun, CVPR 2015): the search for a joint starts at
// its parent, the pelvis' at the mean of the measured points, and a forest says at each place where
// the joint is from there. Departures: the forests give the mean offset, not a direction to step
// in; each stage of the walk has forests of its own, learnt nearer and nearer to the joint; a step
// averages the votes of fixed places round the last one instead of random steps. No frame knows of
// the one before.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "body/body_points.h"
#include "learning/joints/regression_tree.h"

namespace vitruvia::joints {

using Forest = std::vector<RegressionTree>;

struct JointStage {
  double start_deviation_m = 0.0;  // of the places that its forests have learnt to start from
  std::array<Forest, kBodyPointCount> forests;
};

struct JointModel {
  std::vector<JointStage> stages;
};

class JointDetector {
 public:
  // `votes` ≥ 1 places for each step, of which the first is the last step's end and the others lie
  // round it with `vote_spread` times the stage's deviation. The model must outlive this.
  JointDetector(const JointModel& model, int votes, double vote_spread);

  // Camera frame, metres; nothing if no pixel is measured within max_depth_m. The image shows the
  // person alone.
  std::optional<BodyPointPositions> Detect(const DepthImage& depth, const PinholeCamera& camera,
                                           double max_depth_m) const;

 private:
  const JointModel& model_;
  double vote_spread_;
  std::vector<Vector3f> places_;  // of votes, in standard deviations
};

// The mean of the measured points, with which a search begins; nothing if there are none.
std::optional<Vector3d> MeasuredCentroid(const DepthImage& depth, const PinholeCamera& camera,
                                         double max_depth_m);

// On disk, a folder: joints.json and trees.bin. `learnt_from`: settings, free form. DataError
// naming what is missing or damaged.
inline constexpr const char* kJointModelFile = "joints.json";
void WriteJointModel(const std::filesystem::path& folder, const JointModel& model,
                     const nlohmann::json& learnt_from);
JointModel ReadJointModel(const std::filesystem::path& folder);
nlohmann::json ReadLearntFrom(const std::filesystem::path& folder);

}  // namespace vitruvia::joints
