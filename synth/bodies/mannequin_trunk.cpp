#include "synth/bodies/mannequin_trunk.h"

#include <algorithm>
#include <array>

#include "synth/bodies/mannequin_tables.h"

namespace vitruvia::mannequin {
namespace {

// x and z in centimetres at the survey's mean stature, height in percent of stature. Modelled by
// eye after anatomical drawings, then brought to the survey's girths (tests/synth measures them).
struct Point {
  double x_cm, height_percent, z_cm;
};
using Row = std::array<Point, kRingPoints>;

constexpr int kBodyRows = kThroat;  // rows below the head, modelled for each sex
using BodyRows = std::array<Row, kBodyRows>;

constexpr BodyRows kMan{{
    // kLegOpening
    {{{0, 48, 3.6},
      {8, 49.8, 9.4},
      {15.8, 52, 5.4},
      {16.9, 51.6, -4.6},
      {9.4, 48.4, -12.8},
      {0, 48.2, -5.2}}},
    // kHip
    {{{0, 53, 10.4},
      {8.6, 53.8, 10.3},
      {15.3, 55.4, 5.8},
      {16.5, 55.2, -4.4},
      {9.6, 52.2, -15.1},
      {0, 53.6, -12.8}}},
    // kWaist
    {{{0, 60.5, 12},
      {8.8, 60.6, 10.9},
      {15, 60.8, 5.4},
      {16, 60.8, -2.8},
      {9.4, 60.8, -10.9},
      {0, 60.8, -10}}},
    // kRibs
    {{{0, 66.8, 11.9},
      {8.9, 66.6, 10.9},
      {15.1, 66.6, 5.6},
      {16.3, 66.6, -2.2},
      {10, 66.8, -11.5},
      {0, 66.8, -11.1}}},
    // kBreast
    {{{0, 72.4, 11.8},
      {9.2, 72.2, 12.5},
      {16.2, 72.6, 6.6},
      {18.2, 72.4, -2.2},
      {12, 72.6, -12.3},
      {0, 72.6, -12.2}}},
    // kArmpit
    {{{0, 77.2, 9.8},
      {9, 77.2, 10.8},
      {16.9, 76.8, 5.2},
      {19.2, 76, -1.8},
      {17.2, 76.4, -8.8},
      {0, 77.6, -12.4}}},
    // kShoulder
    {{{0, 80.6, 6.6},
      {8.2, 81.4, 6.4},
      {16.9, 82.4, 2.6},
      {18.4, 83.6, -2.2},
      {16.6, 82.8, -7.2},
      {0, 82.6, -11.2}}},
    // kNeckBase
    {{{0, 82.7, 3.5},
      {3.8, 83.1, 2.9},
      {6.7, 84.3, -0.3},
      {7.1, 85.2, -4},
      {4.9, 85.9, -7.7},
      {0, 86.3, -9}}},
}};

constexpr BodyRows kWoman{{
    // kLegOpening
    {{{0, 47.7, 3.4},
      {7.8, 49.6, 8.9},
      {16, 51.8, 5.2},
      {17.2, 51.4, -4.6},
      {9.4, 48.2, -12.3},
      {0, 47.9, -4.8}}},
    // kHip
    {{{0, 53, 9.6},
      {8.5, 53.6, 9.7},
      {15.1, 55, 5.4},
      {16.3, 54.8, -4.4},
      {9.6, 52, -14.8},
      {0, 53.6, -12.1}}},
    // kWaist
    {{{0, 60.5, 10.5},
      {7.9, 60.8, 9.4},
      {13.9, 61.2, 4.3},
      {14.8, 61.2, -2.9},
      {8.7, 61, -9.6},
      {0, 61, -8.6}}},
    // kRibs
    {{{0, 66.6, 9.3},
      {7.4, 66.6, 8.9},
      {12.7, 66.6, 4.8},
      {13.6, 66.6, -2.2},
      {8.9, 66.8, -10},
      {0, 66.8, -9.1}}},
    // kBreast
    {{{0, 72.2, 9.6},
      {8.8, 71.8, 13},
      {14.1, 72.2, 6.2},
      {14.8, 72.2, -2.2},
      {10.2, 72.6, -10.8},
      {0, 72.6, -10.3}}},
    // kArmpit
    {{{0, 77.2, 8.2},
      {7.9, 77.2, 9.2},
      {14.2, 76.8, 4.4},
      {16, 76.2, -1.8},
      {14.2, 76.6, -7.6},
      {0, 77.6, -10.8}}},
    // kShoulder
    {{{0, 80.8, 5.6},
      {7.1, 81.4, 5.4},
      {14.4, 82.2, 2},
      {15.5, 83.1, -2.2},
      {14.2, 82.5, -6.2},
      {0, 82.8, -9.6}}},
    // kNeckBase
    {{{0, 82.8, 2.5},
      {3.2, 83.2, 2.1},
      {5.5, 84.5, -0.7},
      {5.8, 85.4, -3.8},
      {4.1, 86.1, -6.8},
      {0, 86.5, -7.9}}},
}};

constexpr int kHeadRows = kTrunkRows - kBodyRows;

// A man's; a woman's is scaled by the survey's head girth.
constexpr std::array<Row, kHeadRows> kHeadSections{{
    // kThroat
    {{{0, 86.2, 4.4},
      {3.4, 86.6, 3.5},
      {5.4, 87.5, 0.3},
      {5.6, 88.5, -3.2},
      {3.9, 89.5, -6.4},
      {0, 89.9, -7.6}}},
    // kChin
    {{{0, 87.5, 9.5},
      {2.8, 87.7, 8.2},
      {5.1, 88.6, 3.6},
      {6.1, 90.2, -1.2},
      {5, 91.5, -6.4},
      {0, 91.8, -8.5}}},
    // kMouth
    {{{0, 89.2, 10.4},
      {2.9, 89.5, 9},
      {5.6, 90.5, 4.6},
      {6.9, 91.8, -0.8},
      {5.8, 93, -6.8},
      {0, 93.5, -9.4}}},
    // kNose
    {{{0, 91, 12.1},
      {2.3, 91.4, 9.6},
      {6.2, 92.4, 5.2},
      {7.2, 93.4, -0.8},
      {6.1, 94.5, -7.1},
      {0, 95.1, -9.9}}},
    // kEyes
    {{{0, 93.6, 10.1},
      {2.8, 93.6, 9.1},
      {6.4, 94.1, 4.9},
      {7.4, 94.9, -1},
      {6.2, 95.8, -6.9},
      {0, 96.5, -9.9}}},
    // kBrow
    {{{0, 95.2, 10.3},
      {3, 95.3, 9.5},
      {6.4, 95.8, 5.2},
      {7.2, 96.4, -1.2},
      {5.6, 97.1, -6.6},
      {0, 97.7, -9}}},
    // kForehead
    {{{0, 97.9, 8.3},
      {2.9, 98, 7.3},
      {4.9, 98.5, 3.4},
      {5.2, 98.8, -1.6},
      {3.7, 98.9, -5.4},
      {0, 98.9, -6.8}}},
}};
constexpr std::array<Point, kCrownPoints> kCrown{{{0, 99.7, 3.0}, {0, 100.0, -2.8}}};

// How a row grows with the girth score: by which girth's relative deviation, how much of that
// sideways, about which z (so that a belly grows forwards and a back stays), and how far the row's
// points at the arm's opening rise with a heavy arm, in percent of stature per deviation.
struct RowGrowth {
  double deviation_of_mean;
  double sideways = 1.0;
  double z_anchor_cm = -4.0;
  double arm_rise_percent = 0.0;
};

constexpr double kLeanSideways = 0.75;  // of the rest of it below the mean: breadth is bone

double Relative(const Girth& girth) { return girth.deviation_m / girth.mean_m; }

RowGrowth GrowthOf(int row, const SurveyTable& survey) {
  const double waist = Relative(survey.waist), chest = Relative(survey.chest);
  const double buttock = Relative(survey.buttock), neck = Relative(survey.neck);
  switch (row) {
    case kLegOpening:
      return {0.5 * (buttock + Relative(survey.thigh)), 1.0, -2.0};
    case kHip:
      return {buttock, 1.0, -2.0};
    case kWaist:
      return {waist};
    case kRibs:
      return {0.5 * (waist + chest)};
    case kBreast:
      return {chest};
    // The shoulders' breadth is bone.
    case kArmpit:
      return {chest, 0.4, -3.0, -0.25};
    case kShoulder:
      return {0.5 * chest, 0.4, -3.0, 0.20};
    case kNeckBase:
      return {neck};
    case kThroat:
      return {neck, 1.0, -2.0};
    case kChin:
      return {0.7 * neck, 1.0, 1.0};
    case kMouth:
      return {0.5 * neck, 1.0, 1.0};
    default:
      return {Relative(survey.head), 1.0, 0.0};
  }
}

Eigen::RowVector3d Placed(const Point& p, const RowGrowth& growth, double girth_score,
                          double stature_m) {
  constexpr double kMetres = 0.01, kPercent = 0.01;
  const double grown = Growth(growth.deviation_of_mean, girth_score) - 1.0;
  const double sideways = growth.sideways * (grown < 0.0 ? kLeanSideways : 1.0);
  return {kMetres * p.x_cm * (1.0 + sideways * grown), kPercent * p.height_percent * stature_m,
          kMetres * (growth.z_anchor_cm + (1.0 + grown) * (p.z_cm - growth.z_anchor_cm))};
}

bool AtArmOpening(int k) { return k >= 2 && k <= 4; }

Point Scaled(const Point& p, double factor) {
  return {factor * p.x_cm, p.height_percent, factor * p.z_cm};
}

Point PointOf(int row, int k, Sex sex) {
  if (row < kBodyRows) return (sex == Sex::kMale ? kMan : kWoman)[row][k];
  const Point& point = kHeadSections[row - kBodyRows][k];
  const SurveyTable &men = Survey(Sex::kMale), &own = Survey(sex);
  return Scaled(point, row == kThroat ? own.neck.mean_m / men.neck.mean_m
                                      : own.head.mean_m / men.head.mean_m);
}

}  // namespace

Eigen::MatrixX3d TrunkPoints(Sex sex, double girth_score) {
  const SurveyTable& survey = Survey(sex);
  Eigen::MatrixX3d points(CrownVertex(kCrownPoints), 3);
  for (int row = 0; row < kTrunkRows; ++row) {
    const RowGrowth growth = GrowthOf(row, survey);
    for (int k = 0; k < kRingPoints; ++k) {
      Point point = PointOf(row, k, sex);
      if (AtArmOpening(k)) {
        point.height_percent += growth.arm_rise_percent * std::max(0.0, girth_score);
      }
      points.row(TrunkVertex(row, k)) = Placed(point, growth, girth_score, survey.stature_m);
    }
  }
  const double head = survey.head.mean_m / Survey(Sex::kMale).head.mean_m;
  for (int k = 0; k < kCrownPoints; ++k) {
    points.row(CrownVertex(k)) =
        Placed(Scaled(kCrown[k], head), GrowthOf(kForehead, survey), girth_score, survey.stature_m);
  }
  return points;
}

}  // namespace vitruvia::mannequin
