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
  kConverged,         // an alternation reduced the error by less than the limit, or by less than
                      // the precision of floats
  kAlternationLimit,  // all alternations were carried out
};
const char* Name(Ending ending);

struct Alternation {
  double rmse_m = 0.0;  // root mean square distance of the vertices from their examples, at the end
  double time_ms = 0.0;
  bool jointly = false;  // it started from a joint step (joint_step.h), which improved the result
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
// vertex of each label may follow, itself among them; its size is the number of bones.
// std::invalid_argument if ExamplesProblem() or LabelsProblem() reports a problem.
Decomposition Decompose(const Examples& examples, const Labels& labels, const BoneGraph& candidates,
                        const Settings& settings);

// The bones' transforms for given weights, for instance those of another subject.
struct FittedTransforms {
  std::vector<BoneTransforms> poses;  // P × B, posed_from_rest
  double rmse_m = 0.0;
};
FittedTransforms FitTransforms(const Examples& examples, const SkinWeights& weights, int bone_count,
                               int threads);

}  // namespace vitruvia::skinning
