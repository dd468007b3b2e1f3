#include "synth/bodies/mannequin_tables.h"

#include <cmath>

namespace vitruvia::mannequin {

const SurveyTable& Survey(Sex sex) {
  static constexpr SurveyTable kMen{
      .stature_m = 1.756,
      .weight_kg = 85.5,
      .head = {0.574, 0.016},
      .neck = {0.398, 0.026},
      .chest = {1.059, 0.087},
      .waist = {0.941, 0.112},
      .buttock = {1.021, 0.076},
      .thigh = {0.625, 0.058},
      .calf = {0.392, 0.030},
      .ankle = {0.229, 0.015},
      .biceps_flexed = {0.358, 0.035},
      .forearm_flexed = {0.310, 0.022},
      .wrist = {0.176, 0.009},
  };
  static constexpr SurveyTable kWomen{
      .stature_m = 1.628,
      .weight_kg = 67.8,
      .head = {0.561, 0.017},
      .neck = {0.330, 0.020},
      .chest = {0.947, 0.083},
      .waist = {0.861, 0.100},
      .buttock = {1.020, 0.076},
      .thigh = {0.616, 0.056},
      .calf = {0.376, 0.030},
      .ankle = {0.216, 0.015},
      .biceps_flexed = {0.306, 0.031},
      .forearm_flexed = {0.264, 0.019},
      .wrist = {0.154, 0.008},
  };
  return sex == Sex::kMale ? kMen : kWomen;
}

double Growth(double deviation_of_mean, double girth_score) {
  const double deviation = deviation_of_mean * girth_score;
  return girth_score < 0.0 ? std::exp(deviation) : 1.0 + deviation;
}

}  // namespace vitruvia::mannequin
