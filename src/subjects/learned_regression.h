// The pose regression of the SCAPE baseline, learnt from the pose examples of a body database.
#pragma once

#include "learning/shape/pose_regression.h"
#include "synth/population/make_database.h"

namespace vitruvia {

// A file of configs/pose_regression.
struct RegressionLearningSettings {
  DatabaseSettings database;  // all of its people have pose examples
  PoseRegressionSettings regression;
  int held_out = 1;

  RegressionLearningSettings();
  void Describe(Fields& fields);
  std::string Problem() const;
};

// Distance of surfaces predicted from true part rotations to the examples, after aligning the
// vertices' means.
struct RegressionErrors {
  double training_mean_m = 0.0, held_out_mean_m = 0.0;
  double without_mean_m = 0.0;  // held-out subjects, with the identity for every Q
};

struct LearnedRegression {
  PoseRegression regression;
  RegressionErrors errors;
};
LearnedRegression LearnRegression(const RegressionLearningSettings& settings);

}  // namespace vitruvia
