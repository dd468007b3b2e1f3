#include <algorithm>
#include <array>
#include <numbers>

#include "synth/bodies/mannequin_limbs.h"
#include "synth/bodies/mannequin_section.h"

namespace vitruvia::mannequin {
namespace {

constexpr double kArmHeight = 0.800;  // of the arms' axis over stature (guessed: the survey's
                                      // acromion at 0.82, less the deltoid)
constexpr double kArmZ_cm = -2.0;
// Of the radius that an arm has beyond the mean, the share by which it hangs below the bone
// (guessed).
constexpr double kSag = 0.5;

// Half the distance between the shoulder joints over stature, so that the span comes to the
// survey's 1.033 statures.
constexpr double HalfShoulderJoints(Sex sex) { return sex == Sex::kMale ? 0.0975 : 0.0940; }

struct ArmRingForm {
  double x_m;  // of the ring's plane
  Girth girth;
  SectionShape shape;
  double up_cm = 0.0, forward_cm = 0.0;  // of the ring's centre from the arm's axis
};

// Girths of the survey where available; in between, chosen by eye (guessed).
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
struct ThumbPoint {
  double along_cm, up_cm, forward_cm;
};
constexpr std::array<ThumbPoint, kThumbPoints> kThumb_cm{
    {{7.6, -0.1, 7.9}, {7.6, -1.5, 7.9}, {9.4, -1.5, 7.0}, {9.4, -0.1, 7.0}}};

Eigen::MatrixX3d ArmRings(Sex sex, double girth_score) {
  const ArmJoints joints = LeftArmJoints(sex);
  const auto forms = ArmForms(sex, girth_score);
  Eigen::MatrixX3d points(kPalm * kRingPoints, 3);
  for (int r = 0; r < kPalm; ++r) {
    const ArmRingForm& form = forms[r];
    const double girth = At(form.girth, girth_score);
    const double added_radius = std::max(0.0, girth - form.girth.mean_m) / (2.0 * std::numbers::pi);
    const double up = kCentimetre * form.up_cm - kSag * added_radius;
    // Width along z, depth along y; point 0 is the bottom front.
    const Section section = SectionOfGirth(form.shape, -30.0, -60.0, girth);
    for (int k = 0; k < kRingPoints; ++k) {
      points.row(kRingPoints * r + k) << form.x_m, joints.wrist.y() + up + section(k, 1),
          joints.wrist.z() + kCentimetre * form.forward_cm + section(k, 0);
    }
  }
  return points;
}

// Palm, knuckles, fingers and the thumb's tip.
Eigen::MatrixX3d Hand(Sex sex, double girth_score) {
  // Around a ring: half widths and thicknesses of a flattened hexagon with full corners.
  constexpr std::array<double, kRingPoints> kForward{0.92, 0, -0.92, -0.92, 0, 0.92};
  constexpr std::array<double, kRingPoints> kUp{-0.62, -1, -0.62, 0.62, 1, 0.62};
  const ArmJoints joints = LeftArmJoints(sex);
  const double scale = (joints.finger_tip.x() - joints.wrist.x()) / kHandLength_cm;  // m per cm
  const double flesh = Growth(Survey(sex).wrist, girth_score);
  Eigen::MatrixX3d points((kArmRings - kPalm) * kRingPoints + kThumbPoints, 3);
  int next = 0;
  const auto add = [&](double along_cm, double up_cm, double forward_cm) {
    points.row(next++) =
        joints.wrist.transpose() + scale * Eigen::RowVector3d(along_cm, up_cm, forward_cm);
  };
  for (const HandRing& ring : kHand) {
    for (int k = 0; k < kRingPoints; ++k) {
      const bool middle = kForward[k] == 0.0;
      add(ring.along_cm + (middle ? ring.rounding_cm : 0.0),
          ring.up_cm + flesh * ring.half_thickness_cm * kUp[k],
          ring.forward_cm + flesh * ring.half_width_cm * kForward[k]);
    }
  }
  for (const auto& [along_cm, up_cm, forward_cm] : kThumb_cm) add(along_cm, up_cm, forward_cm);
  return points;
}

}  // namespace

ArmJoints LeftArmJoints(Sex sex) {
  const double stature = Survey(sex).stature_m;
  const Vector3d outwards = Vector3d::UnitX();
  ArmJoints joints;
  joints.shoulder = {HalfShoulderJoints(sex) * stature, kArmHeight * stature,
                     kCentimetre * kArmZ_cm};
  joints.elbow = joints.shoulder + kUpperArmLength * stature * outwards;
  joints.wrist = joints.elbow + kForearmLength * stature * outwards;
  joints.finger_tip = joints.wrist + kHandLength * stature * outwards;
  return joints;
}

Eigen::MatrixX3d ArmPoints(Sex sex, double girth_score) {
  Eigen::MatrixX3d points(kArmRings * kRingPoints + kThumbPoints, 3);
  points << ArmRings(sex, girth_score), Hand(sex, girth_score);
  return points;
}

}  // namespace vitruvia::mannequin
