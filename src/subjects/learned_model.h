// The offline model for all subjects of a body source: the shape space, the skinning weights, and
// the mesh that is tracked (paper A, sec. 4).
#pragma once

#include <filesystem>
#include <string>

#include "config/json_settings.h"
#include "learning/shape/shape_space.h"
#include "learning/shape/tracking_template.h"
#include "learning/skinning/decomposition.h"
#include "synth/population/make_database.h"

namespace vitruvia {

// A file of configs/learning.
struct LearningSettings {
  DatabaseSettings database;
  ShapeSpaceSettings shape;
  int held_out = 100;  // number of subjects, the last of the database, that are not used for
                       // training
  skinning::Settings weights;
  std::string weights_subject = "s000";  // the subject whose pose examples the weights are learnt
                                         // from
  int tracking_vertices = kTrackingVertices;

  void Describe(Fields& fields);
  std::string Problem() const;
};

LearningSettings ReadLearningSettings(const std::filesystem::path& file);

struct LearnedModel {
  ShapeSpace space;  // on the learning mesh; its weights are the learnt ones
  TrackingTemplate tracking;
  ShapeSpace tracking_space;  // the same space on the tracking mesh
};

// Training subjects and held-out subjects.
struct Split {
  std::vector<int> training, held_out;
};
Split SplitSubjects(const BodyDatabase& database, int held_out);

// Starts from the bone of the rig's largest weight at each vertex.
skinning::Decomposition LearnWeights(const BodyDatabase& database, const PoseExamples& examples,
                                     const skinning::Settings& settings);

// Everything from a database that holds the weights subject's examples in memory.
LearnedModel LearnModel(const BodyDatabase& database, const LearningSettings& settings);

// The model of these settings, read from `cache` or learnt there (including the database) unless
// one of the same settings and build exists.
LearnedModel ObtainLearnedModel(const LearningSettings& settings,
                                const std::filesystem::path& cache);

}  // namespace vitruvia
