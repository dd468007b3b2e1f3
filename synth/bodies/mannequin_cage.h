// The mannequin's cage: its vertices and quads, the same for all subjects.
//
// The left half is a lattice of named loops; the right half is its mirror image, and both share the
// midline. The trunk's rows run from the legs' openings to the forehead, each from the front
// midline over the left side to the back midline. Arm and leg are tubes of six points a ring that
// leave the trunk at an opening of six edges and end in a cap of two quads.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace vitruvia::mannequin {

inline constexpr int kRingPoints = 6;

// Trunk rows, upwards. A row's points: 0 front midline, 1 front, 2 front of the arm's or leg's
// opening, 3 side, 4 back, 5 back midline. (The left leg's opening is row 0; its lowest edge is
// the crotch between points 0 and 5.)
enum TrunkRow {
  kLegOpening,
  kHip,
  kWaist,
  kRibs,
  kBreast,
  kArmpit,
  kShoulder,
  kNeckBase,
  kThroat,
  kChin,
  kMouth,
  kNose,
  kEyes,
  kBrow,
  kForehead,
  kTrunkRows
};
inline constexpr int kCrownPoints = 2;  // on the midline above the forehead row

// Arm rings, outwards. A ring's points: 0 bottom front, 1 bottom, 2 bottom back, 3 top back, 4 top,
// 5 top front.
enum ArmRing {
  kDeltoid,
  kBiceps,
  kElbow,
  kForearm,
  kLowerForearm,
  kWrist,
  kPalm,
  kKnuckles,
  kFingers,
  kArmRings
};
inline constexpr int kThumbPoints =
    4;  // between palm and knuckles: bottom and top at the palm's
        // side, then top and bottom at the knuckles' — see the quads

// Leg rings, downwards. A ring's points: 0 inner back, 1 back, 2 outer back, 3 outer front, 4
// front, 5 inner front. From the heel on the rings turn forwards: 4 is on top, 1 on the sole.
enum LegRing {
  kUpperThigh,
  kMidThigh,
  kAboveKnee,
  kBelowKnee,
  kCalf,
  kLowerCalf,
  kAnkle,
  kHeel,
  kInstep,
  kBall,
  kToes,
  kLegRings
};

// Indices of the left half's vertices, which come first.
constexpr int TrunkVertex(int row, int point) { return kRingPoints * row + point; }
constexpr int CrownVertex(int k) { return kRingPoints * kTrunkRows + k; }
constexpr int ArmVertex(int ring, int point) {
  return CrownVertex(kCrownPoints) + kRingPoints * ring + point;
}
constexpr int ThumbVertex(int k) { return ArmVertex(kArmRings, 0) + k; }
constexpr int LegVertex(int ring, int point) {
  return ThumbVertex(kThumbPoints) + kRingPoints * ring + point;
}
inline constexpr int kLeftVertices = LegVertex(kLegRings, 0);

struct Cage {
  std::vector<Quad> quads;
  std::vector<int> mirror;  // V: each vertex's counterpart, itself on the midline

  int vertex_count() const { return static_cast<int>(mirror.size()); }
};
const Cage& TheCage();

}  // namespace vitruvia::mannequin
