// Skinning weights of the mannequin's cage. The same for every subject.
#pragma once

#include <Eigen/Core>

namespace vitruvia::mannequin {

// V × kBoneCount; rows sum to 1, at most 4 entries of a row are not 0; left and right mirror.
Eigen::MatrixXf CageWeights();

}  // namespace vitruvia::mannequin
