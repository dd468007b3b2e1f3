#include "synth/bodies/mannequin_limbs.h"

#include <algorithm>
#include <array>
#include <numbers>

#include <Eigen/LU>

#include "synth/bodies/mannequin_cage.h"
#include "synth/bodies/mannequin_tables.h"

namespace vitruvia::mannequin {
namespace {

using Section = Eigen::Matrix<double, kRingPoints, 2>;  // points of a cross-section, in its plane

// A cross-section of unit girth: a hexagon's directions, each stretched.
struct SectionShape {
  std::array<double, kRingPoints> radii{1, 1, 1, 1, 1, 1};
  double width = 1.0, depth = 1.0;
};

// The length of the closed uniform cubic B-spline through the points: what a ring of the refined
// surface comes to.
double GirthOf(const Section& points) {
  Eigen::Matrix<double, kRingPoints, kRingPoints> basis;
  basis.setZero();
  for (int i = 0; i < kRingPoints; ++i) {
    basis(i, i) = 4.0 / 6.0;
    basis(i, (i + 1) % kRingPoints) = basis(i, (i + kRingPoints - 1) % kRingPoints) = 1.0 / 6.0;
  }
  const Section control = basis.inverse() * points;
  constexpr int kSamples = 16;  // a span's chords fall short of its arc by less than 1e-4
  double length = 0.0;
  Eigen::RowVector2d last = points.row(0);
  for (int i = 0; i < kRingPoints; ++i) {
    for (int s = 1; s <= kSamples; ++s) {
      const double t = s / static_cast<double>(kSamples), u = 1.0 - t;
      const Eigen::RowVector2d p =
          (u * u * u * control.row((i + kRingPoints - 1) % kRingPoints) +
           (3 * t * t * t - 6 * t * t + 4) * control.row(i) +
           (3 * u * u * u - 6 * u * u + 4) * control.row((i + 1) % kRingPoints) +
           t * t * t * control.row((i + 2) % kRingPoints)) /
          6.0;
      length += (p - last).norm();
      last = p;
    }
  }
  return length;
}

// Point k lies in direction `first_deg` + k `step_deg`.
Section SectionOfGirth(const SectionShape& shape, double first_deg, double step_deg,
                       double girth_m) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  Section points;
  for (int k = 0; k < kRingPoints; ++k) {
    const double angle = kDegree * (first_deg + step_deg * k);
    points.row(k) << shape.width * shape.radii[k] * std::cos(angle),
        shape.depth * shape.radii[k] * std::sin(angle);
  }
  return points * (girth_m / GirthOf(points));
}

double At(const Girth& girth, double girth_score) {
  return girth.mean_m * Growth(girth, girth_score);
}
Girth Scaled(const Girth& girth, double factor) {
  return {factor * girth.mean_m, factor * girth.deviation_m};
}
Girth Between(const Girth& a, const Girth& b, double share_of_b) {
  return {(1.0 - share_of_b) * a.mean_m + share_of_b * b.mean_m,
          (1.0 - share_of_b) * a.deviation_m + share_of_b * b.deviation_m};
}

constexpr double kCentimetre = 0.01;

// Arms.

constexpr double kArmHeight = 0.800;  // of the arms' axis over stature (guessed: the survey's
                                      // acromion at 0.82, less the deltoid)
constexpr double kArmZ_cm = -2.0;

constexpr double ShoulderBreadth(Sex sex) { return sex == Sex::kMale ? 0.0975 : 0.0940; }

struct ArmRingForm {
  double x_m;  // of the ring's plane
  Girth girth;
  SectionShape shape;
  double up_cm = 0.0, forward_cm = 0.0;  // of the ring's centre from the arm's axis
};

// Kept of the flexed girth where a relaxed muscle was not measured; the rest lies between
// (guessed).
std::array<ArmRingForm, kPalm> ArmForms(Sex sex, double girth_score) {
  const SurveyTable& survey = Survey(sex);
  const ArmJoints joints = LeftArmJoints(sex);
  const Girth biceps = Scaled(survey.biceps_flexed, kRelaxedBiceps);
  const Girth forearm = Scaled(survey.forearm_flexed, kRelaxedForearm);
  const double upper = joints.elbow.x() - joints.shoulder.x();
  const double lower = joints.wrist.x() - joints.elbow.x();
  // A broad trunk pushes the deltoid outwards.
  const double pushed = std::max(0.0, 0.006 * girth_score);
  return {{
      {joints.shoulder.x() + 0.20 * upper + pushed,
       Scaled(biceps, 1.14),
       {{1, 1, 1, 1.02, 1.02, 1.02}, 1.0, 1.04},
       0.0,
       0.1},
      {joints.shoulder.x() + 0.58 * upper, biceps, {{1, 1, 1, 1, 1, 1}, 0.97, 1.03}, -0.1, 0.0},
      {joints.elbow.x(),
       Between(biceps, survey.wrist, 0.35),
       {{1, 1, 1, 1, 1, 1}, 1.04, 0.96},
       0.0,
       -0.2},
      {joints.elbow.x() + 0.24 * lower, forearm, {{1, 1, 1, 1, 1, 1}, 1.04, 0.96}, 0.0, 0.2},
      {joints.elbow.x() + 0.64 * lower,
       Between(forearm, survey.wrist, 0.6),
       {{1, 1, 1, 1, 1, 1}, 1.1, 0.9},
       0.0,
       0.1},
      {joints.wrist.x() - 0.01, survey.wrist, {{1, 1, 1, 1, 1, 1}, 1.22, 0.8}, 0.0, 0.0},
  }};
}

// The hand: half widths (z) and half thicknesses (y) of its rings, centimetres for a hand of 19 cm.
struct HandRing {
  double along_cm, rounding_cm;  // of the edges; of the middle beyond them
  double forward_cm, up_cm, half_width_cm, half_thickness_cm;
};
constexpr std::array<HandRing, kArmRings - kPalm> kHand{{
    {2.8, 0.0, 0.3, 0.0, 3.6, 1.75},     // kPalm
    {8.6, 0.5, 0.0, 0.0, 4.2, 1.4},      // kKnuckles
    {17.0, 1.6, -0.3, -0.2, 2.7, 0.85},  // kFingers
}};
constexpr double kHandLength_cm = 19.0;
// The thumb's tip, of the same hand: along, up and forward from the wrist; in the order of the quad
// that it leaves: top front and bottom front at the palm, bottom front and top front at the
// knuckles.
constexpr std::array<std::array<double, 3>, kThumbPoints> kThumb_cm{
    {{7.6, -0.1, 7.9}, {7.6, -1.5, 7.9}, {9.4, -1.5, 7.0}, {9.4, -0.1, 7.0}}};

// Legs.

// Half the distance between the hip joints over stature (guessed after pelvis X-rays).
constexpr double kHalfHipJoints = 0.050;
constexpr double kInnerGap_cm = 0.3;  // from the midline to the inner thigh

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

// The foot: centimetres from the floor point below the ankle, for a foot of 27 cm.
struct FootPoint {
  double x_cm, y_cm, z_cm;
};
constexpr std::array<std::array<FootPoint, kRingPoints>, kLegRings - kHeel> kFoot{{
    // kHeel
    {{{-2.8, 2.8, -3.2},
      {0, 3, -5.6},
      {2.8, 2.8, -3.2},
      {3.4, 6.2, 3},
      {0, 9, 6.6},
      {-3.4, 6.2, 3}}},
    // kInstep
    {{{-2.4, 0.1, -1.6},
      {0, 0, -2.6},
      {2.4, 0.1, -1.6},
      {3.9, 2.4, 6.4},
      {-0.4, 6.8, 10.8},
      {-3.6, 3.2, 6.6}}},
    // kBall
    {{{-3.2, 0, 12},
      {0, 0, 11.5},
      {3.6, 0, 10.8},
      {5.1, 1.6, 12.8},
      {-0.4, 4.2, 16},
      {-4.7, 2, 14.6}}},
    // kToes
    {{{-2.8, 0.2, 20.4},
      {0.1, 0.2, 20.9},
      {2.8, 0.2, 19},
      {3.8, 1.1, 18.9},
      {0, 2.2, 20.9},
      {-3.6, 1.4, 20.6}}},
}};
constexpr double kFootLength_cm = 27.1;      // ANSUR II men, at 1.756 m
constexpr double kWomansFoot = 24.6 / 27.1;  // ANSUR II
constexpr double kFootSpread_deg = 6.0;      // toes turn outwards (guessed)

// The share of the hips' spread that the leg has at a height over stature.
double SpreadShare(double height) {
  constexpr double kAtAnkle = 0.7;
  return kAtAnkle + (1.0 - kAtAnkle) * (height - kAnkleHeight) / (kHipHeight - kAnkleHeight);
}

// How far heavy thighs move the legs apart, metres, at the hips.
double Spread(Sex sex, double girth_score) {
  const double inner_direction = std::cos(std::numbers::pi / 6.0);  // of ring points 0 and 5
  double spread = 0.0;
  for (const LegRingForm& form : LegForms(sex)) {
    const Section section = SectionOfGirth(form.shape, -150.0, 60.0, At(form.girth, girth_score));
    const double half_width = -section.col(0).minCoeff() / inner_direction;
    const double missing = half_width - kCentimetre * (form.x_cm - kInnerGap_cm);
    spread = std::max(spread, missing / SpreadShare(form.height));
  }
  return spread;
}

}  // namespace

ArmJoints LeftArmJoints(Sex sex) {
  const double stature = Survey(sex).stature_m;
  const Vector3d outwards = Vector3d::UnitX();
  ArmJoints joints;
  joints.shoulder = {ShoulderBreadth(sex) * stature, kArmHeight * stature, kCentimetre * kArmZ_cm};
  joints.elbow = joints.shoulder + kUpperArmLength * stature * outwards;
  joints.wrist = joints.elbow + kForearmLength * stature * outwards;
  joints.finger_tip = joints.wrist + kHandLength * stature * outwards;
  return joints;
}

LegJoints LeftLegJoints(Sex sex, double girth_score) {
  const double stature = Survey(sex).stature_m;
  const double spread = Spread(sex, girth_score);
  const double foot = (sex == Sex::kMale ? 1.0 : kWomansFoot);
  LegJoints joints;
  joints.hip = {kHalfHipJoints * stature, kHipHeight * stature, 0.0};
  joints.knee = {kCentimetre * 9.4 + SpreadShare(kKneeHeight) * spread, kKneeHeight * stature,
                 -0.003};
  joints.ankle = {kCentimetre * 10.2 + SpreadShare(kAnkleHeight) * spread, kAnkleHeight * stature,
                  -0.033};
  joints.toe_tip = joints.ankle + Vector3d(0.015, -0.04, 0.215) * foot;
  joints.toe_tip.y() = 0.012;
  return joints;
}

Eigen::MatrixX3d ArmPoints(Sex sex, double girth_score) {
  const ArmJoints joints = LeftArmJoints(sex);
  Eigen::MatrixX3d points(kArmRings * kRingPoints + kThumbPoints, 3);
  const auto forms = ArmForms(sex, girth_score);
  for (int r = 0; r < kPalm; ++r) {
    const ArmRingForm& form = forms[r];
    // What an arm has beyond the mean hangs below the bone: half of the added radius.
    const double added_radius =
        std::max(0.0, At(form.girth, girth_score) - form.girth.mean_m) / (2.0 * std::numbers::pi);
    const double sag = 0.5 * added_radius;
    // Width along z, depth along y; point 0 is the bottom front.
    const Section section = SectionOfGirth(form.shape, -30.0, -60.0, At(form.girth, girth_score));
    for (int k = 0; k < kRingPoints; ++k) {
      points.row(kRingPoints * r + k) << form.x_m,
          joints.wrist.y() + kCentimetre * form.up_cm - sag + section(k, 1),
          joints.wrist.z() + kCentimetre * form.forward_cm + section(k, 0);
    }
  }
  const double hand = (joints.finger_tip.x() - joints.wrist.x()) / kHandLength_cm;  // m per cm
  const double flesh = 1.0 + girth_score * Survey(sex).wrist.deviation_m / Survey(sex).wrist.mean_m;
  constexpr std::array<double, kRingPoints> kWide{0.92, 0, -0.92, -0.92, 0, 0.92};
  constexpr std::array<double, kRingPoints> kThick{-0.62, -1, -0.62, 0.62, 1, 0.62};
  for (int r = kPalm; r < kArmRings; ++r) {
    const HandRing& ring = kHand[r - kPalm];
    for (int k = 0; k < kRingPoints; ++k) {
      const bool middle = k == 1 || k == 4;
      points.row(kRingPoints * r + k)
          << joints.wrist.x() + hand * (ring.along_cm + (middle ? ring.rounding_cm : 0.0)),
          joints.wrist.y() + hand * (ring.up_cm + flesh * ring.half_thickness_cm * kThick[k]),
          joints.wrist.z() + hand * (ring.forward_cm + flesh * ring.half_width_cm * kWide[k]);
    }
  }
  for (int k = 0; k < kThumbPoints; ++k) {
    points.row(kRingPoints * kArmRings + k) << joints.wrist.x() + hand * kThumb_cm[k][0],
        joints.wrist.y() + hand * kThumb_cm[k][1], joints.wrist.z() + hand * kThumb_cm[k][2];
  }
  return points;
}

Eigen::MatrixX3d LegPoints(Sex sex, double girth_score) {
  const SurveyTable& survey = Survey(sex);
  const LegJoints joints = LeftLegJoints(sex, girth_score);
  const double spread = Spread(sex, girth_score);
  Eigen::MatrixX3d points(kLegRings * kRingPoints, 3);
  const auto forms = LegForms(sex);
  for (int r = 0; r < kHeel; ++r) {
    const LegRingForm& form = forms[r];
    const Section section = SectionOfGirth(form.shape, -150.0, 60.0, At(form.girth, girth_score));
    for (int k = 0; k < kRingPoints; ++k) {
      points.row(kRingPoints * r + k)
          << kCentimetre * form.x_cm + SpreadShare(form.height) * spread + section(k, 0),
          form.height * survey.stature_m, kCentimetre * form.z_cm + section(k, 1);
    }
  }
  const double foot = kCentimetre * (sex == Sex::kMale ? 1.0 : kWomansFoot);
  const double flesh = Growth(survey.ankle, girth_score);
  const double turn = kFootSpread_deg * std::numbers::pi / 180.0;
  for (int r = kHeel; r < kLegRings; ++r) {
    for (int k = 0; k < kRingPoints; ++k) {
      const FootPoint& p = kFoot[r - kHeel][k];
      const double x = foot * flesh * p.x_cm, z = foot * (p.z_cm - 2.6);
      points.row(kRingPoints * r + k) << joints.ankle.x() + std::cos(turn) * x + std::sin(turn) * z,
          foot * p.y_cm, joints.ankle.z() + std::cos(turn) * z - std::sin(turn) * x;
    }
  }
  return points;
}

}  // namespace vitruvia::mannequin
