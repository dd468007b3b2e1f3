// Skinning decomposition: weights and rigid bone transforms that explain examples of a surface
// (paper A, eqs. 2 to 5; B. H. Le, Z. Deng, "Smooth skinning decomposition with rigid bones", ACM
// Trans. Graphics 31(6), 2012).
#pragma once

#include <vector>

#include "learning/skinning/examples.h"
#include "learning/skinning/labels.h"
#include "learning/skinning/settings.h"
#include "math/rigid.h"

namespace vitruvia::skinning {

enum class Ending {
  kConverged,         // an alternation gained less than asked for, or nothing that floats can tell
  kAlternationLimit,  // all alternations were carried out
};
const char* Name(Ending ending);

struct Alternation {
  double rmse_m = 0.0;  // root mean square distance of a vertex from its place, at its end
  double time_ms = 0.0;
  bool jointly = false;  // it went out from a joint step (joint_step.h), and was the better for it
};

struct Decomposition {
  SkinWeights weights;
  std::vector<BoneTransforms> poses;  // P × B, posed_from_rest
  double start_rmse_m = 0.0;          // of the labels' rigid bones
  double rmse_m = 0.0;                // of the result
  std::vector<Alternation> alternations;
  Ending ending = Ending::kAlternationLimit;
};

// Starts from rigid pieces, one per bone, as `labels` says (V). `candidates` are the bones that a
// vertex of each label may follow, itself among them; its size is the number of bones. Misuse if
// ExamplesProblem() or LabelsProblem() has a complaint.
Decomposition Decompose(const Examples& examples, const Labels& labels, const BoneGraph& candidates,
                        const Settings& settings);

// The bones' transforms for weights that are given, those of another subject for instance.
struct FittedTransforms {
  std::vector<BoneTransforms> poses;  // P × B, posed_from_rest
  double rmse_m = 0.0;
};
FittedTransforms FitTransforms(const Examples& examples, const SkinWeights& weights, int bone_count,
                               int threads);

}  // namespace vitruvia::skinning
