// Published measurements on which the mannequin is based.
//
// Girths: means and standard deviations of ANSUR II, the 2012 anthropometric survey of U.S. Army
// personnel (Gordon et al. 2014, NATICK/TR-15/007; 4,082 men, 1,986 women), rounded to millimetres.
// Women's calf and ankle are estimated from published percentiles, within about a percent. Not
// every number has been checked against the report: the last digit is uncertain.
//
// Lengths: fractions of stature H. Legs after Drillis & Contini 1966 (as in Winter 2009, fig. 4.1);
// arms between joint centres after de Leva 1996, whose arms and shoulders add up to the measured
// span, which those of Drillis & Contini exceed by a tenth.
#pragma once

#include "body/body_model.h"

namespace vitruvia::mannequin {

struct Girth {
  double mean_m;
  double deviation_m;  // standard deviation over the survey's subjects
};

struct SurveyTable {
  double stature_m;  // mean, at which the girths below hold
  double weight_kg;  // mean
  Girth head, neck, chest, waist, buttock;
  Girth thigh, calf, ankle;
  Girth biceps_flexed, forearm_flexed, wrist;
};
const SurveyTable& Survey(Sex sex);

// Ratio of a girth to its mean for a person that many standard deviations from the mean. Below the
// mean it decreases exponentially, so that no girth becomes zero or negative.
double Growth(double deviation_of_mean, double girth_score);
inline double Growth(const Girth& girth, double girth_score) {
  return Growth(girth.deviation_m / girth.mean_m, girth_score);
}

// A muscle that hangs relaxed is thinner than the survey's flexed one (guessed).
inline constexpr double kRelaxedBiceps = 0.93;
inline constexpr double kRelaxedForearm = 0.96;

// Joint centres over stature, Drillis & Contini 1966.
inline constexpr double kHipHeight = 0.530, kKneeHeight = 0.285, kAnkleHeight = 0.039;
// Between joint centres over stature, de Leva 1996, men and women alike to half a percent.
inline constexpr double kUpperArmLength = 0.1600, kForearmLength = 0.1535, kHandLength = 0.108;

}  // namespace vitruvia::mannequin
