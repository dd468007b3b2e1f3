// The two baselines that rest on learnt models, with small models: what a frame of 320 × 240 costs.
#include <filesystem>

#include "bench/bench.h"
#include "learning/skinning/heat_weights.h"
#include "methods/registry.h"
#include "subjects/learned_joints.h"
#include "subjects/learned_regression.h"
#include "support/arm_stage.h"
#include "support/temporary_folder.h"

namespace vitruvia::bench {
namespace {

constexpr int kThreads = 2, kModelFrames = 20, kModelRepeats = 3;

// A model of as many stages and trees as the shipped one, of trees less deep.
void LearnSmallJointModel(const std::filesystem::path& folder) {
  JointLearningSettings settings;
  settings.examples.population.subjects = 4;
  settings.examples.images = 300;
  joints::WriteJointModel(folder, LearnJointModel(settings, kThreads), {});
}

void LearnSmallRegression(const std::filesystem::path& folder) {
  RegressionLearningSettings settings;
  settings.database.population.subjects = settings.database.subjects_with_poses = 2;
  settings.database.poses.poses = 12;
  WritePoseRegression(folder, LearnRegression(settings).regression, {});
}

double MedianFrameMs(const Json& method, ArmStage& stage) {
  const std::unique_ptr<Tracker> tracker =
      MakeTracker(ReadMethodConfig(method, {"baseline_models_bench", ""}));
  tracker->Start(stage.body, stage.camera);
  std::vector<double> ms;
  for (int i = 0; i < kModelFrames; ++i) {
    const DepthFrame frame = stage.Frame(i, 0.03 * i);
    ms.push_back(MedianMs(1, [&] { tracker->TrackFrame(frame); }));
  }
  return Median(ms);
}

}  // namespace

std::vector<Row> BaselineModels() {
  const TemporaryFolder folder;
  LearnSmallJointModel(folder / "joints");
  LearnSmallRegression(folder / "regression");
  ArmStage stage(2, SkinLinear, {Vector3d(1, -1, -1).asDiagonal(), {0.05, 0.9, 2.8}});
  const Json skeleton_driven = {
      {"method", "skeleton_driven"},
      {"settings", {{"detector", {{"model", (folder / "joints").string()}}}}}};
  const Json scape = {{"method", "scape_regression"},
                      {"settings", {{"regression", (folder / "regression").string()}}}};
  return {{"heat_weights",
           MedianMs(kModelRepeats,
                    [&] { skinning::HeatWeights(stage.body.rest, stage.body.skeleton, {}); }),
           "ms"},
          {"skeleton_driven_frame", MedianFrameMs(skeleton_driven, stage), "ms"},
          {"scape_regression_frame", MedianFrameMs(scape, stage), "ms"}};
}

}  // namespace vitruvia::bench
