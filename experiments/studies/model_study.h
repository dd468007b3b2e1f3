// Experiments of the kind "model_drawing": drawings of a tracker's model, without tracking, for the
// papers' figures of the models (paper A, figures 2 and 5; paper B, figure 2).
#pragma once

#include <filesystem>
#include <string>

#include "body/skeleton.h"
#include "experiments/plan/planned_run.h"
#include "methods/model_structure.h"
#include "records/bone_tree.h"
#include "synth/bodies/body_source.h"

namespace vitruvia {

inline constexpr const char* kModelKind = "model_drawing";

// Whose model is drawn.
enum class DrawnModel {
  kRealtimeScape,  // 17 bones: regions, main axes, tree
  kDynamic,        // hinges and slides of a skeleton file: axes, tree
};

struct ModelDrawingSettings {
  DrawnModel model = DrawnModel::kRealtimeScape;
  BodySettings body;
  RefinementSettings mesh;
  std::filesystem::path skeleton;  // of kDynamic

  void Describe(Fields& fields);
  std::string Problem() const;
};

struct ModelStudySettings {
  std::string kind, title, description;
  ModelDrawingSettings drawing;

  void Describe(Fields& fields);
};

// The tree of the 17 bones, and that of a skeleton: a node for each place, with its joints.
BoneTree TreeOfBones();
BoneTree TreeOfSkeleton(const ModelSkeleton& skeleton);

// One run. Throws ConfigError before anything has run.
Experiment PlanModelStudy(const std::filesystem::path& file, const WorkFolders& work);
// Stores surfaces (records/surface_strips.h) and a tree (records/bone_tree.h).
RunRecord CarryOutModelRun(const PlannedRun& run, const std::filesystem::path& run_folder);

}  // namespace vitruvia
