// Experiments of the kind "intrinsic_shape" (paper A, figure 4): held-out people are scanned, their
// shape is fitted to the scan, and both are compared with the truth.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/plan/experiment_config.h"
#include "experiments/plan/planned_run.h"
#include "learning/shape/intrinsic_shape.h"
#include "subjects/learned_model.h"
#include "subjects/scan.h"

namespace vitruvia {

inline constexpr const char* kShapeKind = "intrinsic_shape";

struct ScanVariant {
  std::string name;
  std::filesystem::path scan;  // a scan file; its person is replaced

  void Describe(Fields& fields);
};

struct ShapeStudySettings {
  std::string kind, title, description;
  std::filesystem::path learning;
  std::vector<ScanVariant> scans;
  int people = 5;  // the first people of the held-out ones
  IntrinsicShapeSettings fit;
  std::vector<ExpectationSettings> expectations;

  void Describe(Fields& fields);
};

// How a fitted body differs from the person, both in the T-pose, rigidly aligned.
struct ShapeError {
  double surface_mean_m = 0.0, surface_max_m = 0.0;  // of each to the nearest point of the other
  double vertex_mean_m = 0.0;                        // of corresponding vertices
  double joint_mean_m = 0.0;
  std::vector<float> surface_m;           // per vertex of the fitted body
  std::vector<Vector3f> fitted_vertices;  // aligned to the truth
};
ShapeError CompareShapes(const BodyModel& fitted, const BodyModel& truth);

// One run for each scan and person. Throws ConfigError before anything has run.
Experiment PlanShapeStudy(const std::filesystem::path& file, const WorkFolders& work);
// Scans the person, fits the shape and compares. Pictures: scan, fitted body, both, and the error
// from the front and from behind.
RunRecord CarryOutShapeRun(const PlannedRun& run, const std::filesystem::path& run_folder);

}  // namespace vitruvia
