#include "subjects/learned_model.h"

#include <algorithm>

#include "config/build_cache.h"
#include "core/error.h"

namespace vitruvia {
namespace fs = std::filesystem;

void LearningSettings::Describe(Fields& f) {
  f.Section("database", database, {.meaning = "the people that are learnt from"});
  f.Section("shape", shape, {.meaning = "the space of their shapes"});
  f.Integer(
      "held_out", held_out,
      {.meaning = "number of subjects, the last of the database, that are held out for testing",
       .min = 0,
       .max = 100000});
  f.Section("weights", weights, {.meaning = "how skinning weights are learnt"});
  f.Text("weights_subject", weights_subject,
         {.meaning = "subject from whose pose examples the weights are learnt"});
  f.Integer("tracking_vertices", tracking_vertices,
            {.meaning = "vertices of the mesh that is tracked",
             .min = 100,
             .max = 1000000,
             .origin = Origin::kPaper,
             .source = "paper A, sec. 6.2"});
}

std::string LearningSettings::Problem() const {
  if (held_out < database.population.subjects) return "";
  return fmt::format("held_out: expected fewer than the {} subjects, got {}",
                     database.population.subjects, held_out);
}

LearningSettings ReadLearningSettings(const fs::path& file) {
  return ReadSettingsFile<LearningSettings>(file);
}

Split SplitSubjects(const BodyDatabase& database, int held_out) {
  const auto count = static_cast<int>(database.subjects.size());
  Require(held_out >= 0 && held_out < count, "SplitSubjects: {} held out of {}", held_out, count);
  Split split;
  for (int s = 0; s < count; ++s)
    (s < count - held_out ? split.training : split.held_out).push_back(s);
  return split;
}

skinning::Decomposition LearnWeights(const BodyDatabase& database, const PoseExamples& examples,
                                     const skinning::Settings& settings) {
  const auto subject =
      std::find_if(database.subjects.begin(), database.subjects.end(),
                   [&](const DatabaseSubject& s) { return s.name == examples.subject; });
  Require(subject != database.subjects.end(), "LearnWeights: no subject {}", examples.subject);
  const std::vector<Triangle>& triangles = database.reference.rest.triangles;
  const skinning::Labels labels = skinning::HeaviestBones(database.reference.weights);
  const skinning::BoneGraph neighbours =
      skinning::NeighboursOnSurface(labels, triangles, kBoneCount, settings.neighbours);
  return skinning::Decompose(
      {subject->vertices, examples.poses}, labels,
      skinning::BonesWithin(neighbours, settings.neighbour_steps, kBoneCount), settings);
}

LearnedModel LearnModel(const BodyDatabase& database, const LearningSettings& settings) {
  const auto examples =
      std::find_if(database.examples.begin(), database.examples.end(),
                   [&](const PoseExamples& e) { return e.subject == settings.weights_subject; });
  if (examples == database.examples.end()) {
    throw ConfigError(fmt::format(
        "weights_subject: \"{}\" has no pose examples; the first {} subjects have, from \"{}\"",
        settings.weights_subject, database.examples.size(), database.subjects.front().name));
  }
  LearnedModel model;
  model.space = LearnShapeSpace(database, SplitSubjects(database, settings.held_out).training,
                                settings.shape);
  model.space.reference.weights = LearnWeights(database, *examples, settings.weights).weights;
  model.tracking = MakeTrackingTemplate(model.space.reference.rest, settings.tracking_vertices);
  model.tracking_space = OnTrackingMesh(model.space, model.tracking);
  return model;
}

LearnedModel ObtainLearnedModel(const LearningSettings& settings, const fs::path& cache) {
  const CachedFolder kept(cache, "model", WriteSettings(settings));
  kept.GetOrBuild([&](const fs::path& folder) {
    WriteShapeSpace(folder, LearnModel(MakeDatabase(settings.database), settings).space);
  });
  LearnedModel model;
  model.space = ReadShapeSpace(kept.path());
  model.tracking = MakeTrackingTemplate(model.space.reference.rest, settings.tracking_vertices);
  model.tracking_space = OnTrackingMesh(model.space, model.tracking);
  return model;
}

}  // namespace vitruvia
