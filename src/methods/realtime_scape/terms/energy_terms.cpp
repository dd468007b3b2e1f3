#include "methods/realtime_scape/terms/energy_terms.h"

#include "math/angles.h"
#include "methods/realtime_scape/terms/axis_term.h"
#include "methods/realtime_scape/terms/fit_term.h"
#include "methods/realtime_scape/terms/free_space_term.h"
#include "methods/realtime_scape/terms/inertia_term.h"
#include "methods/realtime_scape/terms/joint_term.h"
#include "methods/realtime_scape/terms/limit_term.h"
#include "methods/realtime_scape/terms/prior_term.h"

namespace vitruvia::realtime_scape {
namespace {

struct TermEntry {
  EnergyTerm term;
  const char* name;
  const char* weight_key;  // nullptr: the term has no weight of its own
  double default_weight;
  About about;  // of the weight
  void (*add)(const TermInput& input, double weight, BlockNormalEquations& equations);
};

About AboutWeight(const char* meaning) {
  return {.meaning = meaning,
          .min = 0,
          .max = 1e9,
          .origin = Origin::kPaper,
          .source = "paper A, eq. 7"};
}

// Of a term that paper A does not have; 0 leaves it out.
About AboutOwnWeight(const char* meaning) {
  return {.meaning = meaning,
          .min = 0,
          .max = 1e9,
          .origin = Origin::kGuessed,
          .source = "paper A has no such term"};
}

// In the order of the enum, in which they are added.
const std::array<TermEntry, kEnergyTermCount>& Terms() {
  static const std::array<TermEntry, kEnergyTermCount> terms = {{
      {EnergyTerm::kFit,
       "fit",
       nullptr,
       1.0,
       {},
       [](const TermInput& in, double, BlockNormalEquations& equations) {
         AddFitTerm(in.model, in.pose, in.camera, in.classes, in.pairs, in.settings.fit,
                    in.settings.length_unit_m, equations);
       }},
      {EnergyTerm::kJoint, "joint", "joint_weight", 10.0,
       AboutWeight("α₁, weight of the term that keeps neighbouring bones connected"),
       [](const TermInput& in, double weight, BlockNormalEquations& equations) {
         in.joints.Add(in.model, in.pose, weight, in.settings.length_unit_m, equations);
       }},
      {EnergyTerm::kInertia, "inertia", "inertia_weight", 5.0,
       AboutWeight(
           "α₂, weight of the term that keeps each bone's local rotation near the predicted one"),
       [](const TermInput& in, double weight, BlockNormalEquations& equations) {
         AddInertiaTerm(in.pose, in.expected, weight, equations);
       }},
      {EnergyTerm::kAxis, "axis", "axis_weight", 1.0,
       AboutWeight("α₃, weight of the term that aligns the hinge axes of seven bones with their "
                   "parents"),
       [](const TermInput& in, double weight, BlockNormalEquations& equations) {
         AddAxisTerm(in.pose, weight, equations);
       }},
      {EnergyTerm::kFreeSpace, "free_space", "free_space_weight", 0.0,
       AboutOwnWeight("weight of the term that moves visible vertices out of space that the frame "
                      "shows to be free, or out of the image where its border is nearer"),
       [](const TermInput& in, double weight, BlockNormalEquations& equations) {
         AddFreeSpaceTerm(in.model, in.pose, in.free_space, in.settings.fit, weight,
                          in.settings.length_unit_m, equations);
       }},
      {EnergyTerm::kLimit, "limit", "limit_weight", 0.0,
       AboutOwnWeight("weight of the term that keeps joints within their anatomical range, per "
                      "squared radian"),
       [](const TermInput& in, double weight, BlockNormalEquations& equations) {
         AddLimitTerm(in.pose, in.settings.limit_slack_deg * kRadiansPerDegree, weight, equations);
       }},
      {EnergyTerm::kPrior, "prior", "prior_weight", 0.0,
       AboutOwnWeight("weight of the prior on local rotations about their means in captured "
                      "motion, per squared standard deviation"),
       [](const TermInput& in, double weight, BlockNormalEquations& equations) {
         AddPriorTerm(in.pose, weight, equations);
       }},
  }};
  return terms;
}

}  // namespace

const char* Name(EnergyTerm term) { return Terms().at(static_cast<std::size_t>(term)).name; }

TermWeights::TermWeights() {
  for (const TermEntry& entry : Terms()) (*this)[entry.term] = entry.default_weight;
}

void TermWeights::Describe(Fields& f) {
  for (const TermEntry& entry : Terms()) {
    if (entry.weight_key != nullptr) f.Number(entry.weight_key, (*this)[entry.term], entry.about);
  }
}

Energies AddEnergyTerms(const TermInput& input, BlockNormalEquations& equations) {
  Energies energies{};
  for (const TermEntry& entry : Terms()) {
    if (input.settings.weights[entry.term] == 0.0) continue;
    const double before = equations.energy();
    entry.add(input, input.settings.weights[entry.term], equations);
    energies[static_cast<std::size_t>(entry.term)] = equations.energy() - before;
  }
  return energies;
}

}  // namespace vitruvia::realtime_scape
