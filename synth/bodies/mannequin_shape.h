// The mannequin's shape: the surface point of each of the cage's vertices, and the joints.
#pragma once

#include <Eigen/Core>

#include "body/body_model.h"

namespace vitruvia::mannequin {

// The left half of a subject of the survey's mean stature.
struct Form {
  Eigen::MatrixX3d surface;  // kLeftVertices × 3, metres, subject frame; a point of the finished
                             // surface for each vertex of the cage, not the cage itself
  Skeleton skeleton;         // both sides
};

// `girth_score` moves every girth by that many of its standard deviations from the survey's mean.
Form MakeForm(Sex sex, double girth_score);

}  // namespace vitruvia::mannequin
