// Files of a user's registered meshes and of the skinning weights learnt from them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "body/body_model.h"
#include "config/json_settings.h"
#include "learning/skinning/decomposition.h"

namespace vitruvia {

// Paths of the examples and the sources of the initial bones.
struct WeightExampleFiles {
  std::filesystem::path meshes;  // folder of PLY, OBJ and OFF files of one topology, a pose each
  std::filesystem::path rest;    // mesh; the rig's own if empty
  std::filesystem::path rig;     // body folder: its weights say where bones begin; or empty
  std::filesystem::path labels;  // text: one bone per vertex; or empty
  int bones = 0;                 // without rig and labels: number of rigid pieces to find
};

struct WeightExamples {
  TriangleMesh rest;
  std::vector<std::string> names;  // of the poses' files, ascending
  std::vector<std::vector<Vector3f>> poses;
  std::optional<BodyModel> rig;
  skinning::Labels labels;  // empty if rigid pieces are to be looked for
  int bone_count = 0;
};

// ConfigError if no initial bones are given; DataError naming the file for any violation of this
// format, for different topologies, for fewer than two poses, and for files in the folder that are
// not meshes.
WeightExamples ReadWeightExamples(const WeightExampleFiles& files);

// With a rig: a body folder with the learnt weights. Without: weights.bin as a body folder has it,
// labels.txt and rest.ply. Both with learning.json: settings, RMSE and time per alternation, and
// the bones' transforms in every pose. Whole or not at all.
void WriteLearntWeights(const std::filesystem::path& folder, const WeightExamples& examples,
                        const skinning::Settings& settings, const skinning::Decomposition& result);

}  // namespace vitruvia
