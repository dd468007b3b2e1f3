#include "synth/bodies/mannequin_cage.h"

#include <array>

namespace vitruvia::mannequin {
namespace {

using Ring = std::array<int, kRingPoints>;

// The left half's quads, counter-clockwise seen from outside.
class LeftHalf {
 public:
  LeftHalf() {
    AddTrunk();
    AddCrown();
    AddArm();
    AddLeg();
  }
  std::vector<Quad> quads;

 private:
  void AddTrunk() {
    for (int row = 0; row + 1 < kTrunkRows; ++row) {
      for (int k = 0; k + 1 < kRingPoints; ++k) {
        const bool arm_opening = row == kArmpit && (k == 2 || k == 3);
        if (arm_opening) continue;
        quads.push_back({TrunkVertex(row, k), TrunkVertex(row, k + 1), TrunkVertex(row + 1, k + 1),
                         TrunkVertex(row + 1, k)});
      }
    }
  }

  void AddCrown() {
    const auto rim = [](int k) { return TrunkVertex(kForehead, k); };
    const int front = CrownVertex(0), back = CrownVertex(1);
    quads.push_back({rim(0), rim(1), rim(2), front});
    quads.push_back({front, rim(2), rim(3), back});
    quads.push_back({back, rim(3), rim(4), rim(5)});
  }

  void AddArm() {
    Ring ring{TrunkVertex(kArmpit, 2),   TrunkVertex(kArmpit, 3),   TrunkVertex(kArmpit, 4),
              TrunkVertex(kShoulder, 4), TrunkVertex(kShoulder, 3), TrunkVertex(kShoulder, 2)};
    for (int r = 0; r < kArmRings; ++r) {
      const bool thumb = r == kKnuckles;
      const Ring next = RingOf(r, ArmVertex);
      AddTube(ring, next, thumb ? kRingPoints - 1 : kRingPoints);
      if (thumb) AddThumb({ring[5], ring[0], next[0], next[5]});
      ring = next;
    }
    AddCap(ring);
  }

  void AddThumb(const Quad& base) {
    Quad tip{};
    for (int k = 0; k < kThumbPoints; ++k) tip[k] = ThumbVertex(k);
    for (int k = 0; k < kThumbPoints; ++k) {
      const int next = (k + 1) % kThumbPoints;
      quads.push_back({base[k], base[next], tip[next], tip[k]});
    }
    quads.push_back(tip);
  }

  void AddLeg() {
    Ring ring;
    for (int k = 0; k < kRingPoints; ++k) ring[k] = TrunkVertex(kLegOpening, kRingPoints - 1 - k);
    for (int r = 0; r < kLegRings; ++r) {
      const Ring next = RingOf(r, LegVertex);
      AddTube(ring, next, kRingPoints);
      ring = next;
    }
    AddCap(ring);
  }

  static Ring RingOf(int r, int (*vertex)(int, int)) {
    Ring ring;
    for (int k = 0; k < kRingPoints; ++k) ring[k] = vertex(r, k);
    return ring;
  }

  void AddTube(const Ring& near, const Ring& far, int sides) {
    for (int k = 0; k < sides; ++k) {
      const int next = (k + 1) % kRingPoints;
      quads.push_back({near[k], near[next], far[next], far[k]});
    }
  }

  void AddCap(const Ring& rim) {
    quads.push_back({rim[1], rim[2], rim[3], rim[4]});
    quads.push_back({rim[4], rim[5], rim[0], rim[1]});
  }
};

bool OnMidline(int left_vertex) {
  const bool crown = left_vertex >= CrownVertex(0) && left_vertex < CrownVertex(kCrownPoints);
  const int point = left_vertex % kRingPoints;
  return crown || (left_vertex < CrownVertex(0) && (point == 0 || point == kRingPoints - 1));
}

Cage MakeCage() {
  Cage cage;
  cage.mirror.resize(kLeftVertices);
  for (int v = 0; v < kLeftVertices; ++v) {
    if (OnMidline(v)) {
      cage.mirror[v] = v;
    } else {
      cage.mirror[v] = static_cast<int>(cage.mirror.size());
      cage.mirror.push_back(v);
    }
  }
  cage.quads = LeftHalf().quads;
  const std::size_t left_quads = cage.quads.size();
  for (std::size_t q = 0; q < left_quads; ++q) {
    const auto [a, b, c, d] = cage.quads[q];
    cage.quads.push_back({cage.mirror[a], cage.mirror[d], cage.mirror[c], cage.mirror[b]});
  }
  return cage;
}

}  // namespace

const Cage& TheCage() {
  static const Cage cage = MakeCage();
  return cage;
}

}  // namespace vitruvia::mannequin
