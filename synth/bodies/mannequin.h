// The embedded mannequin: a parametric human built here, without any file.
//
// A quad control cage of cross-section loops along the skeleton, closed, of genus 0, mirror
// symmetric, 400 vertices and 398 quads for every subject. Two Catmull–Clark steps give 6,370
// vertices and 12,736 triangles, three give 25,474 and 50,944.
//
// Lengths are fractions of stature and girths are means and standard deviations of published
// tables (mannequin_tables.h). The cage is solved for so that the surface after two steps passes
// through the points that were designed: Catmull–Clark shrinks, the table's girths must not.
//
// Subjects of one sex and other statures are scaled copies; weight then moves all girths together
// along their standard deviations, by one score, until volume × density is the weight asked for.
#pragma once

#include <string>

#include "synth/bodies/body_source.h"

namespace vitruvia {

inline constexpr int kMannequinSteps = 2;  // the refinement at which height and weight are exact

// Mean density of a living body with air in its lungs, kg/m³.
double BodyDensity(Sex sex);

// "" if a body of that height and weight can be built, otherwise why not.
std::string MannequinProblem(const BodySettings& settings);

// ConfigError if MannequinProblem() says so.
ControlBody MakeMannequin(const BodySettings& settings);

}  // namespace vitruvia
