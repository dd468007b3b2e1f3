// The experiment file of a tracking experiment.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "config/json_settings.h"
#include "experiments/plan/sweep.h"
#include "records/run_record.h"
#include "scoring/score.h"
#include "tracking/input_faults.h"

namespace vitruvia {

inline constexpr const char* kTrackingKind = "tracking";

// Default of the largest share of a run's frames that may fail.
inline constexpr double kFailedFramesLimit = 0.5;

// Named overrides (RFC 7386 merge patches) of the scene file and of the method file.
struct VariantSettings {
  std::string name;
  std::string description;
  std::vector<std::string> methods;  // patterns of the methods that it applies to; empty: all
  Json scene = Json::object();
  Json method = Json::object();
  // A subject file (fitted_subject.h) or the folder of a body (body_model.h). Without one the
  // tracker gets the scene's own template, or the subject that is stored with a sequence.
  std::filesystem::path subject;
  InputFaultSettings faults;  // none by default

  void Describe(Fields& fields);
  std::string Problem() const;
};

struct ExpectationSettings {
  std::string metric;
  double paper = std::numeric_limits<double>::quiet_NaN();
  double at_most = std::numeric_limits<double>::quiet_NaN();
  double at_least = std::numeric_limits<double>::quiet_NaN();
  std::string source, remark, not_comparable;
  std::vector<std::string> scenes;  // none: all

  void Describe(Fields& fields);
  std::string Problem() const;
  Expectation AsRecorded() const;
};

struct ExperimentSettings {
  std::string kind = kTrackingKind;
  std::string title, description;
  std::vector<std::filesystem::path> scenes, methods;
  std::vector<std::filesystem::path> sequences;  // stored ones, beside the scenes
  std::vector<VariantSettings> variants;         // none: one without overrides, named "default"
  SweepSettings sweep;
  std::vector<int> seeds{1};
  int repeats = 1;
  int most_frames = 0;  // of each scene; 0: as the scene says
  bool timed = false;
  double failed_frames_limit = kFailedFramesLimit;
  std::vector<ExpectationSettings> expectations;
  std::vector<int> picture_frames;         // none: spread over the sequence
  std::vector<std::string> table_columns;  // none: the usual ones
  bool side_by_side = false;
  ScoreSettings score;
  std::vector<FrameSummary> summaries;

  void Describe(Fields& fields);
  std::string Problem() const;
};

// Whether the variant applies to the method of that file.
bool IsAbout(const VariantSettings& variant, const std::filesystem::path& method_file);

// The name of the single variant of an experiment without variants.
inline constexpr const char* kDefaultVariant = "default";

// What runs call a scene of that file, and a stored sequence of that folder.
std::string SceneNameOf(const std::filesystem::path& scene_file);
std::string SequenceNameOf(const std::filesystem::path& folder);

// Whether the name can be part of a folder's name: letters, digits, . _ - only.
bool IsPlainName(const std::string& name);

// The file's path below the nearest folder called "configs", without extension; its stem elsewhere.
std::string ConfigName(const std::filesystem::path& file);

}  // namespace vitruvia
