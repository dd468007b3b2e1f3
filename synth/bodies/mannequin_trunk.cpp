#include "synth/bodies/mannequin_trunk.h"

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
    {{{0, 48.0, 3.6},
      {8.6, 49.8, 8.4},
      {16.2, 51.8, 4.2},
      {16.9, 51.4, -4.0},
      {9.2, 48.4, -10.6},
      {0, 48.2, -4.6}}},
    // kHip
    {{{0, 53.0, 9.6},
      {8.6, 53.8, 9.8},
      {15.6, 55.2, 4.4},
      {16.6, 55.0, -3.6},
      {8.8, 52.2, -13.0},
      {0, 53.4, -11.0}}},
    // kWaist
    {{{0, 60.5, 11.9},
      {8.6, 60.6, 11.2},
      {15.0, 60.8, 4.6},
      {15.6, 60.8, -2.8},
      {8.4, 60.8, -10.4},
      {0, 60.8, -9.2}}},
    // kRibs
    {{{0, 66.8, 11.4},
      {8.6, 66.6, 11.2},
      {14.8, 66.6, 5.2},
      {15.8, 66.6, -2.2},
      {9.6, 66.8, -11.4},
      {0, 66.8, -10.4}}},
    // kBreast
    {{{0, 72.4, 11.0},
      {9.0, 72.4, 12.4},
      {15.8, 72.8, 6.4},
      {17.4, 72.4, -2.2},
      {11.4, 72.6, -12.4},
      {0, 72.6, -11.8}}},
    // kArmpit
    {{{0, 77.2, 9.4},
      {8.8, 77.2, 10.6},
      {16.2, 76.8, 5.0},
      {18.4, 75.8, -1.8},
      {16.4, 76.4, -8.8},
      {0, 77.6, -12.4}}},
    // kShoulder
    {{{0, 80.6, 6.8},
      {8.0, 81.4, 6.6},
      {16.0, 82.2, 2.6},
      {17.4, 83.2, -2.2},
      {15.8, 82.4, -7.2},
      {0, 82.6, -11.2}}},
    // kNeckBase
    {{{0, 82.6, 3.8},
      {4.0, 83.0, 3.2},
      {7.2, 84.2, 0.0},
      {7.6, 85.0, -4.0},
      {5.2, 85.8, -8.0},
      {0, 86.2, -9.4}}},
}};

constexpr BodyRows kWoman{{
    // kLegOpening
    {{{0, 47.7, 3.2},
      {8.4, 49.6, 8.0},
      {16.4, 51.6, 4.2},
      {17.2, 51.2, -4.0},
      {9.0, 48.2, -10.6},
      {0, 47.9, -4.4}}},
    // kHip
    {{{0, 53.0, 9.0},
      {8.4, 53.6, 9.2},
      {15.6, 54.8, 4.2},
      {16.9, 54.6, -3.8},
      {8.6, 52.0, -13.2},
      {0, 53.4, -10.8}}},
    // kWaist
    {{{0, 60.5, 9.8},
      {7.4, 60.8, 9.2},
      {13.4, 61.0, 3.8},
      {14.0, 61.0, -2.8},
      {8.0, 61.0, -9.2},
      {0, 61.0, -7.8}}},
    // kRibs
    {{{0, 66.6, 9.0},
      {7.2, 66.6, 9.0},
      {12.2, 66.6, 4.4},
      {13.0, 66.6, -2.2},
      {8.4, 66.8, -9.8},
      {0, 66.8, -8.8}}},
    // kBreast
    {{{0, 72.2, 9.6},
      {8.6, 71.8, 13.0},
      {13.8, 72.2, 6.2},
      {14.4, 72.2, -2.2},
      {9.8, 72.6, -10.8},
      {0, 72.6, -10.2}}},
    // kArmpit
    {{{0, 77.2, 8.2},
      {7.8, 77.2, 9.2},
      {13.8, 76.8, 4.4},
      {15.6, 76.2, -1.8},
      {13.8, 76.6, -7.6},
      {0, 77.6, -10.8}}},
    // kShoulder
    {{{0, 80.8, 5.8},
      {7.0, 81.4, 5.6},
      {14.0, 82.0, 2.0},
      {15.0, 82.8, -2.2},
      {13.8, 82.2, -6.2},
      {0, 82.8, -9.6}}},
    // kNeckBase
    {{{0, 82.8, 2.8},
      {3.4, 83.2, 2.4},
      {5.9, 84.4, -0.4},
      {6.2, 85.2, -3.8},
      {4.4, 86.0, -7.0},
      {0, 86.4, -8.2}}},
}};

constexpr int kHeadRows = kTrunkRows - kBodyRows;

// A man's; a woman's is scaled by the survey's head girth.
constexpr std::array<Row, kHeadRows> kHead{{
    // kThroat
    {{{0, 86.2, 5.2},
      {3.8, 86.5, 4.2},
      {6.0, 87.4, 0.6},
      {6.2, 88.4, -3.4},
      {4.2, 89.4, -7.0},
      {0, 89.8, -8.4}}},
    // kChin
    {{{0, 87.6, 9.6},
      {2.8, 87.8, 8.4},
      {5.8, 88.8, 3.8},
      {6.7, 90.2, -1.2},
      {5.6, 91.4, -6.6},
      {0, 91.6, -8.8}}},
    // kMouth
    {{{0, 89.5, 10.7},
      {2.8, 89.7, 9.3},
      {6.2, 90.6, 4.6},
      {7.2, 91.8, -0.8},
      {6.4, 93.0, -7.0},
      {0, 93.4, -9.7}}},
    // kNose
    {{{0, 91.2, 12.7},
      {2.2, 91.5, 9.8},
      {6.5, 92.4, 5.4},
      {7.4, 93.4, -0.8},
      {6.7, 94.4, -7.2},
      {0, 95.0, -10.0}}},
    // kEyes
    {{{0, 93.6, 10.2},
      {2.6, 93.6, 9.0},
      {6.8, 94.0, 5.0},
      {7.6, 94.8, -1.0},
      {6.9, 95.7, -7.0},
      {0, 96.3, -10.1}}},
    // kBrow
    {{{0, 95.1, 10.6},
      {3.0, 95.2, 10.0},
      {6.8, 95.7, 5.4},
      {7.5, 96.3, -1.2},
      {6.5, 97.0, -6.8},
      {0, 97.5, -9.4}}},
    // kForehead
    {{{0, 97.9, 8.6},
      {3.0, 98.0, 7.8},
      {5.4, 98.4, 3.6},
      {5.8, 98.7, -1.6},
      {4.6, 98.8, -5.6},
      {0, 98.9, -7.2}}},
}};
constexpr std::array<Point, kCrownPoints> kCrown{{{0, 99.8, 3.2}, {0, 100.0, -3.0}}};

// How a row grows with the girth score: by which girth's relative deviation, how much of that
// sideways, and about which z, so that a belly grows forwards and a back stays.
struct Growth {
  double deviation_of_mean;
  double sideways = 1.0;
  double z_anchor_cm = -4.0;
};

double Relative(const Girth& girth) { return girth.deviation_m / girth.mean_m; }

Growth GrowthOf(int row, const SurveyTable& survey) {
  const double waist = Relative(survey.waist), chest = Relative(survey.chest);
  const double buttock = Relative(survey.buttock), neck = Relative(survey.neck);
  switch (row) {
    case kLegOpening:
      return {buttock, 1.0, -2.0};
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
      return {chest, 0.4, -3.0};
    case kShoulder:
      return {0.5 * chest, 0.4, -3.0};
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

Eigen::RowVector3d Placed(const Point& p, const Growth& growth, double girth_score,
                          double stature_m) {
  constexpr double kMetres = 0.01;
  const double grown = growth.deviation_of_mean * girth_score;
  return {kMetres * p.x_cm * (1.0 + growth.sideways * grown), 0.01 * p.height_percent * stature_m,
          kMetres * (growth.z_anchor_cm + (1.0 + grown) * (p.z_cm - growth.z_anchor_cm))};
}

Point Scaled(const Point& p, double factor) {
  return {factor * p.x_cm, p.height_percent, factor * p.z_cm};
}

Point PointOf(int row, int k, Sex sex) {
  if (row < kBodyRows) return (sex == Sex::kMale ? kMan : kWoman)[row][k];
  const Point& point = kHead[row - kBodyRows][k];
  const SurveyTable &men = Survey(Sex::kMale), &own = Survey(sex);
  return Scaled(point, row == kThroat ? own.neck.mean_m / men.neck.mean_m
                                      : own.head.mean_m / men.head.mean_m);
}

}  // namespace

Eigen::MatrixX3d TrunkPoints(Sex sex, double girth_score) {
  const SurveyTable& survey = Survey(sex);
  Eigen::MatrixX3d points(CrownVertex(kCrownPoints), 3);
  for (int row = 0; row < kTrunkRows; ++row) {
    const Growth growth = GrowthOf(row, survey);
    for (int k = 0; k < kRingPoints; ++k) {
      points.row(TrunkVertex(row, k)) =
          Placed(PointOf(row, k, sex), growth, girth_score, survey.stature_m);
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
