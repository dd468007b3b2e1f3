// A detector of joints in one depth image: pixels vote through a forest
// (learning/joints/voting_tree.h).
//
// After Girshick, Shotton, Kohli, Criminisi & Fitzgibbon, ICCV 2011: every pixel of a grid reaches
// a leaf of each tree and votes for the points stored there; a point is the mode of its votes,
// found by mean shift. Departures: a leaf votes for a fixed number of points, its best ones; a
// vote's weight depends on its leaf's deviation and the pixel's area; and from the mode a walk
// leads to the point, each step the mean of what the point's walk trees say (Jung, Lee, Heo & Yun,
// CVPR 2015, whose walks start at the previous point of the skeleton). Frames are independent of
// each other.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "body/body_points.h"
#include "config/settings.h"
#include "learning/joints/voting_tree.h"

namespace vitruvia::joints {

struct JointModel {
  std::vector<VotingTree> trees;
  std::array<std::vector<VotingTree>, kBodyPointCount> walks;  // of each point; empty: none
};

struct VoteSettings {
  int stride_px = 3;
  double deviation_m = 0.03;
  double bandwidth_m = 0.06;
  int shifts = 6;
  int steps = 24;

  void Describe(Fields& fields);
};

// The detected points, camera frame, metres; nothing for a point without votes.
using DetectedPoints = std::array<std::optional<Vector3d>, kBodyPointCount>;

class JointDetector {
 public:
  // The model must outlive this.
  JointDetector(const JointModel& model, const VoteSettings& settings)
      : model_(model), settings_(settings) {}

  // The image must show the person alone, who is of that size (SizeOf).
  DetectedPoints Detect(const DepthImage& depth, const PinholeCamera& camera, double max_depth_m,
                        double size) const;

 private:
  const JointModel& model_;
  VoteSettings settings_;
};

// On disk, a folder: joints.json and trees.bin. `learnt_from`: settings, free form. DataError
// naming what is missing or damaged.
inline constexpr const char* kJointModelFile = "joints.json";
void WriteJointModel(const std::filesystem::path& folder, const JointModel& model,
                     const nlohmann::json& learnt_from);
JointModel ReadJointModel(const std::filesystem::path& folder);
nlohmann::json ReadLearntFrom(const std::filesystem::path& folder);

}  // namespace vitruvia::joints
