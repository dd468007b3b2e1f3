// MakeHuman's macro sliders: a body is base + Σ w_t d_t, where the weight w_t of a target is the
// product of the factors of all category words in its file name.
#pragma once

#include <map>
#include <vector>

#include "synth/bodies/makehuman_package.h"

namespace vitruvia {

// All 0 … 1; the defaults are MakeHuman's neutral body. The three races count a third each.
struct MakeHumanSliders {
  double gender = 0.5;  // 0 female, 1 male
  double age = 0.5;     // see MakeHumanAge
  double muscle = 0.5;
  double weight = 0.5;
  double height = 0.5;  // strong: a deviation of 0.09 gives a population's spread
  double proportions = 0.5;
  double cup = 0.5;
  double firmness = 0.5;
};

// The age slider: 1 year at 0, 25 at 0.5, 90 at 1.
double MakeHumanAge(double years);

// The weight of a target by its path; 0 for targets that no slider above drives.
double MakeHumanTargetWeight(const std::string& target_name, const MakeHumanSliders& sliders);

// Morphs bodies of one package. Targets are read when first needed and kept.
class MakeHumanMorph {
 public:
  explicit MakeHumanMorph(MakeHumanPackage package);

  const MakeHumanPackage& package() const { return package_; }
  // All vertices of the morphed A-pose body, decimetres.
  std::vector<Vector3f> Vertices(const MakeHumanSliders& sliders);

 private:
  MakeHumanPackage package_;
  std::vector<int> driven_targets_;
  std::map<int, std::vector<Vector3f>> displacements_;  // by target
};

}  // namespace vitruvia
