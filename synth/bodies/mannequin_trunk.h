// The shape of trunk, neck and head: the cage's rows of six points.
#pragma once

#include <Eigen/Core>

#include "body/body_model.h"
#include "synth/bodies/mannequin_cage.h"

namespace vitruvia::mannequin {

// Rows kTrunkRows × kRingPoints and then the crown's points, × 3, metres, at the mean stature.
Eigen::MatrixX3d TrunkPoints(Sex sex, double girth_score);

}  // namespace vitruvia::mannequin
