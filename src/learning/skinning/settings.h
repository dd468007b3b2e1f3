// Settings of the skinning decomposition (paper A, eqs. 2 to 5).
#pragma once

#include "config/settings.h"

namespace vitruvia::skinning {

enum class TransformSolver {
  kClosedForm,  // Le & Deng 2012: one bone after the other, each solved exactly with the others
                // fixed
  kLinearised,  // paper A: all bones of a pose together, rotations linearised
};

struct Settings {
  int alternations = 20;
  int influences = 4;
  int neighbours = 4;
  int neighbour_steps = 2;
  TransformSolver transforms = TransformSolver::kLinearised;
  int transform_steps = 3;
  int joint_iterations = 10;
  double least_gain = 1e-6;
  int threads = 2;

  void Describe(Fields& fields);
};

}  // namespace vitruvia::skinning
