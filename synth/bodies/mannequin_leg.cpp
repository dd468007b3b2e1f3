#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "synth/bodies/mannequin_limbs.h"
#include "synth/bodies/mannequin_section.h"

namespace vitruvia::mannequin {
namespace {

// Half the distance between the hip joints over stature (guessed after pelvis X-rays).
constexpr double kHalfHipJoints = 0.050;
constexpr double kInnerGap_cm = 0.3;  // from the midline to the inner thigh
// Where the joints of the mean leg lie: x and z.
struct GroundPoint {
  double x_cm, z_cm;
};
constexpr GroundPoint kKnee{9.4, -0.3}, kAnkleJoint{10.2, -3.3};

struct LegRingForm {
  double height;  // over stature
  Girth girth;
  SectionShape shape;
  double x_cm, z_cm;  // of the ring's centre
};

std::array<LegRingForm, kHeel> LegForms(Sex sex) {
  const SurveyTable& survey = Survey(sex);
  const Girth knee = Between(survey.calf, survey.thigh, 0.02);
  return {{
      {0.452, survey.thigh, {{0.96, 1.02, 1, 1, 1.02, 0.96}, 0.88, 1.12}, 8.8, -1.0},
      {0.385, Between(survey.thigh, knee, 0.34), {{1, 1, 1, 1, 1.03, 1}, 0.91, 1.09}, 9.0, -0.4},
      {0.318, Between(survey.thigh, knee, 0.88), {{1, 1, 1, 1, 1.03, 1}, 0.96, 1.04}, 9.3, -0.3},
      {0.256, Scaled(knee, 0.90), {{1, 1, 1, 1, 1.03, 1}, 0.97, 1.03}, 9.5, -0.9},
      {0.196, survey.calf, {{1.03, 1.06, 1, 1, 0.96, 1}, 0.98, 1.02}, 9.8, -2.6},
      {0.125,
       Between(survey.calf, survey.ankle, 0.58),
       {{1, 1.04, 1, 1, 1, 1}, 0.96, 1.04},
       10.0,
       -2.9},
      {0.064, survey.ankle, {{1, 1.02, 1, 1, 1, 1}, 0.92, 1.08}, 10.2, -3.4},
  }};
}

// The foot: centimetres from the floor point below the ankle joint, for a foot of 27.1 cm, the mean
// of ANSUR II's men.
struct FootPoint {
  double x_cm, y_cm, z_cm;
};
constexpr std::array<std::array<FootPoint, kRingPoints>, kLegRings - kHeel> kFoot{{
    // kHeel
    {{{-2.8, 2.8, -5.8},
      {0, 3, -8.2},
      {2.8, 2.8, -5.8},
      {3.4, 6.2, 0.4},
      {0, 9, 4},
      {-3.4, 6.2, 0.4}}},
    // kInstep
    {{{-2.4, 0.1, -4.2},
      {0, 0, -5.2},
      {2.4, 0.1, -4.2},
      {3.9, 2.4, 3.8},
      {-0.4, 6.8, 8.2},
      {-3.6, 3.2, 4}}},
    // kBall
    {{{-3.2, 0, 9.4},
      {0, 0, 8.9},
      {3.6, 0, 8.2},
      {5.1, 1.6, 10.2},
      {-0.4, 4.2, 13.4},
      {-4.7, 2, 12}}},
    // kToes
    {{{-2.8, 0.2, 17.8},
      {0.1, 0.2, 18.3},
      {2.8, 0.2, 16.4},
      {3.8, 1.1, 16.3},
      {0, 2.2, 18.3},
      {-3.6, 1.4, 18}}},
}};
constexpr double kFootTurn_deg = 6.0;        // toes turn outwards (guessed)
constexpr double kWomansFoot = 24.6 / 27.1;  // ANSUR II's mean foot lengths

double FootScale(Sex sex) {  // metres per centimetre of kFoot
  return kCentimetre * (sex == Sex::kMale ? 1.0 : kWomansFoot);
}

// The share of the hips' spread that the leg has at a height over stature.
double SpreadShare(double height) {
  constexpr double kAtAnkle = 0.7;
  return kAtAnkle + (1.0 - kAtAnkle) * (height - kAnkleHeight) / (kHipHeight - kAnkleHeight);
}

Section RingSection(const LegRingForm& form, double girth_score) {
  // Width along x, depth along z; point 0 is the inner back.
  return SectionOfGirth(form.shape, -150.0, 60.0, At(form.girth, girth_score));
}

// How far heavy thighs move the legs apart, metres, at the hips.
double Spread(Sex sex, double girth_score) {
  const double inner_direction = std::cos(std::numbers::pi / 6.0);  // of ring points 0 and 5
  double spread = 0.0;
  for (const LegRingForm& form : LegForms(sex)) {
    const double half_width = -RingSection(form, girth_score).col(0).minCoeff() / inner_direction;
    const double missing = half_width - kCentimetre * (form.x_cm - kInnerGap_cm);
    spread = std::max(spread, missing / SpreadShare(form.height));
  }
  return spread;
}

// Down to the ankle.
Eigen::MatrixX3d LegRings(Sex sex, double girth_score) {
  const double stature = Survey(sex).stature_m, spread = Spread(sex, girth_score);
  const auto forms = LegForms(sex);
  Eigen::MatrixX3d points(kHeel * kRingPoints, 3);
  for (int r = 0; r < kHeel; ++r) {
    const LegRingForm& form = forms[r];
    const double x = kCentimetre * form.x_cm + SpreadShare(form.height) * spread;
    const Section section = RingSection(form, girth_score);
    for (int k = 0; k < kRingPoints; ++k) {
      points.row(kRingPoints * r + k) << x + section(k, 0), form.height * stature,
          kCentimetre * form.z_cm + section(k, 1);
    }
  }
  return points;
}

// From the heel to the toes.
Eigen::MatrixX3d Foot(Sex sex, double girth_score) {
  const Vector3d ankle = LeftLegJoints(sex, girth_score).ankle;
  const double scale = FootScale(sex), flesh = Growth(Survey(sex).ankle, girth_score);
  const double turn = kFootTurn_deg * std::numbers::pi / 180.0;
  Eigen::MatrixX3d points((kLegRings - kHeel) * kRingPoints, 3);
  int next = 0;
  for (const auto& ring : kFoot) {
    for (const FootPoint& p : ring) {
      const double x = scale * flesh * p.x_cm, z = scale * p.z_cm;
      points.row(next++) << ankle.x() + std::cos(turn) * x + std::sin(turn) * z, scale * p.y_cm,
          ankle.z() + std::cos(turn) * z - std::sin(turn) * x;
    }
  }
  return points;
}

}  // namespace

LegJoints LeftLegJoints(Sex sex, double girth_score) {
  const double stature = Survey(sex).stature_m;
  const double spread = Spread(sex, girth_score);
  LegJoints joints;
  joints.hip = {kHalfHipJoints * stature, kHipHeight * stature, 0.0};
  joints.knee = {kCentimetre * kKnee.x_cm + SpreadShare(kKneeHeight) * spread,
                 kKneeHeight * stature, kCentimetre * kKnee.z_cm};
  joints.ankle = {kCentimetre * kAnkleJoint.x_cm + SpreadShare(kAnkleHeight) * spread,
                  kAnkleHeight * stature, kCentimetre * kAnkleJoint.z_cm};
  joints.toe_tip = {joints.ankle.x() + FootScale(sex) * 1.5, FootScale(sex) * 1.2,
                    joints.ankle.z() + FootScale(sex) * 18.0};
  return joints;
}

Eigen::MatrixX3d LegPoints(Sex sex, double girth_score) {
  Eigen::MatrixX3d points(kLegRings * kRingPoints, 3);
  points << LegRings(sex, girth_score), Foot(sex, girth_score);
  return points;
}

}  // namespace vitruvia::mannequin
