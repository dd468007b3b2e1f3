// A user's own registered meshes, and the skinning weights learnt from them, as files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "body/body_model.h"
#include "config/json_settings.h"
#include "learning/skinning/decomposition.h"

namespace vitruvia {

// Where the examples lie and what is known of the bones.
struct WeightExampleFiles {
  std::filesystem::path meshes;  // folder of PLY, OBJ and OFF files of one topology, a pose each
  std::filesystem::path rest;    // mesh; the rig's own if empty
  std::filesystem::path rig;     // body folder: its weights say where bones begin; or empty
  std::filesystem::path labels;  // text: one bone per vertex; or empty
  int bones = 0;                 // without rig and labels: so many rigid pieces are looked for
};

struct WeightExamples {
  TriangleMesh rest;
  std::vector<std::string> names;  // of the poses' files, ascending
  std::vector<std::vector<Vector3f>> poses;
  std::optional<BodyModel> rig;
  skinning::Labels labels;  // empty if rigid pieces are to be looked for
  int bone_count = 0;
};

// ConfigError if it is not said what to start from; DataError naming the file on anything that is
// not as above, on meshes of other topologies, on fewer than two poses, and on files in the folder
// that are no meshes.
WeightExamples ReadWeightExamples(const WeightExampleFiles& files);

// With a rig: a body folder with the learnt weights. Without: weights.bin as a body folder has it,
// labels.txt and rest.ply. Both with learning.json: settings, RMSE and time per alternation, and
// the bones' transforms in every pose. Whole or not at all.
void WriteLearntWeights(const std::filesystem::path& folder, const WeightExamples& examples,
                        const skinning::Settings& settings, const skinning::Decomposition& result);

}  // namespace vitruvia
