// The embedded mannequin: a parametric human built here, without any file.
//
// A quad control cage of cross-section loops along the skeleton, closed, of genus 0, mirror
// symmetric, 400 vertices and 398 quads for every subject. Two Catmull–Clark steps give 6,370
// vertices and 12,736 triangles, three give 25,474 and 50,944.
//
// Lengths are fractions of stature and girths are means and standard deviations of published tables
// (mannequin_tables.h). Because Catmull–Clark subdivision shrinks a mesh, the cage is computed such
// that the surface after two steps passes through the designed points and has the table's girths.
//
// Subjects of the same sex and different stature are scaled copies. Then all girths are changed by
// the same score, in standard deviations, until volume × density is the requested weight.
#pragma once

#include <string>

#include "synth/bodies/body_source.h"

namespace vitruvia {

inline constexpr int kMannequinSteps = 2;  // the refinement at which height and weight are exact

// Mean density of a living body with air in its lungs, kg/m³.
double BodyDensity(Sex sex);

// "" if a body of that height and weight can be built, otherwise why not.
std::string MannequinProblem(const BodySettings& settings);

// ConfigError if MannequinProblem() is not "".
ControlBody MakeMannequin(const BodySettings& settings);

}  // namespace vitruvia
