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
#include "config/settings.h"
#include "learning/joints/regression_tree.h"

namespace vitruvia::joints {

using Forest = std::vector<RegressionTree>;

struct JointStage {
  double jitter_m =
      0.0;  // standard deviation round the places that its forests learnt to start from
  std::array<Forest, kBodyPointCount> forests;
};

struct JointModel {
  std::vector<JointStage> stages;
};

// The places that vote on each step: the last step's end, and others round it.
struct VoteSettings {
  int places = 8;
  double spread = 1.0;

  void Describe(Fields& fields);
};

class JointDetector {
 public:
  // The model must outlive this.
  JointDetector(const JointModel& model, const VoteSettings& votes);

  // Camera frame, metres; nothing if no pixel is measured within max_depth_m. The image shows the
  // person alone.
  std::optional<BodyPointPositions> Detect(const DepthImage& depth, const PinholeCamera& camera,
                                           double max_depth_m) const;

 private:
  const JointModel& model_;
  double spread_;
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
