#include "learning/skinning/settings.h"

#include "learning/skinning/simplex_qp.h"

namespace vitruvia::skinning {

void Settings::Describe(Fields& f) {
  f.Integer("alternations", alternations,
            {.meaning = "maximum number of alternations between weights and transforms",
             .min = 0,
             .max = 10000,
             .origin = Origin::kPaper,
             .source = "paper A, sec. 4: 20"});
  f.Integer("influences", influences,
            {.meaning = "maximum number of bones that move one vertex",
             .min = 1,
             .max = kMaxInfluences,
             .origin = Origin::kPaper,
             .source = "paper A, eq. 2: |N| = 4"});
  f.Integer("neighbours", neighbours,
            {.meaning = "maximum number of neighbours of a bone",
             .min = 1,
             .max = kMaxCandidates,
             .origin = Origin::kTuned,
             .source = "paper A, sec. 4: 3; a chest has 4: abdomen, neck and two arms"});
  f.Integer("neighbour_steps", neighbour_steps,
            {.meaning = "maximum number of steps, from neighbour to neighbour, from a vertex's own "
                        "bone to a bone that influences it",
             .min = 0,
             .max = 16,
             .origin = Origin::kTuned,
             .source = "paper A: 1"});
  f.Choice(
      "transforms", transforms,
      {{"closed_form", TransformSolver::kClosedForm}, {"linearised", TransformSolver::kLinearised}},
      {.meaning = "how bones are fitted: one after the other in closed form (Le & Deng 2012), "
                  "or all of a pose together with linearised rotations",
       .origin = Origin::kPaper,
       .source = "paper A, sec. 4"});
  f.Integer("transform_steps", transform_steps,
            {.meaning = "linearised solves, or rounds over all bones, per alternation",
             .min = 1,
             .max = 100,
             .origin = Origin::kTuned,
             .source = "paper A: 1"});
  f.Integer("joint_iterations", joint_iterations,
            {.meaning = "conjugate gradient iterations, in each alternation, of the step of all "
                        "transforms that lets the weights follow; 0: plain alternation",
             .min = 0,
             .max = 1000,
             .origin = Origin::kTuned,
             .source = "the papers: 0"});
  f.Number("least_gain", least_gain,
           {.meaning = "the fit ends when an alternation lowers the RMSE by less than this share",
            .min = 0,
            .max = 1,
            .origin = Origin::kTuned});
  f.Integer("threads", threads,
            {.meaning = "number of threads; the result does not depend on it",
             .min = 1,
             .max = 64,
             .origin = Origin::kInput});
}

}  // namespace vitruvia::skinning
