#include "synth/bodies/mannequin_weights.h"

#include <initializer_list>
#include <utility>

#include "body/skeleton.h"
#include "synth/bodies/mannequin_cage.h"

namespace vitruvia::mannequin {
namespace {

using enum BoneId;
using Share = std::pair<BoneId, double>;
using Shares = std::initializer_list<Share>;

// Subdivision smooths these weights over about one ring to either side, so a joint needs little
// more than one ring with weights of both bones.
class LeftWeights {
 public:
  LeftWeights() : weights_(Eigen::MatrixXf::Zero(kLeftVertices, kBoneCount)) {
    SetPelvisAndSpine();
    SetShoulder();
    SetHead();
    SetArm();
    SetLeg();
  }
  const Eigen::MatrixXf& get() const { return weights_; }

 private:
  void Set(int vertex, Shares shares) {
    weights_.row(vertex).setZero();
    for (const auto& [bone, share] : shares) {
      weights_(vertex, static_cast<int>(bone)) = static_cast<float>(share);
    }
  }
  void SetRow(int row, Shares shares) {
    for (int k = 0; k < kRingPoints; ++k) Set(TrunkVertex(row, k), shares);
  }
  void SetArmRing(int ring, Shares shares) {
    for (int k = 0; k < kRingPoints; ++k) Set(ArmVertex(ring, k), shares);
  }
  void SetLegRing(int ring, Shares shares) {
    for (int k = 0; k < kRingPoints; ++k) Set(LegVertex(ring, k), shares);
  }

  void SetPelvisAndSpine() {
    const auto opening = [](int k) { return TrunkVertex(kLegOpening, k); };
    for (const int midline : {0, 5}) {
      Set(opening(midline), {{kPelvis, 0.7}, {kLeftThigh, 0.15}, {kRightThigh, 0.15}});
    }
    Set(opening(1), {{kPelvis, 0.45}, {kLeftThigh, 0.55}});
    Set(opening(2), {{kPelvis, 0.45}, {kLeftThigh, 0.55}});
    Set(opening(3), {{kPelvis, 0.5}, {kLeftThigh, 0.5}});
    Set(opening(4), {{kPelvis, 0.4}, {kLeftThigh, 0.6}});
    SetRow(kHip, {{kPelvis, 1.0}});
    Set(TrunkVertex(kHip, 1), {{kPelvis, 0.95}, {kLeftThigh, 0.05}});
    Set(TrunkVertex(kHip, 2), {{kPelvis, 0.85}, {kLeftThigh, 0.15}});
    Set(TrunkVertex(kHip, 3), {{kPelvis, 0.85}, {kLeftThigh, 0.15}});
    Set(TrunkVertex(kHip, 4), {{kPelvis, 0.75}, {kLeftThigh, 0.25}});
    SetRow(kWaist, {{kPelvis, 0.4}, {kAbdomen, 0.6}});
    SetRow(kRibs, {{kAbdomen, 0.5}, {kChest, 0.5}});
    SetRow(kBreast, {{kChest, 1.0}});
  }

  void SetShoulder() {
    SetRow(kArmpit, {{kChest, 1.0}});
    Set(TrunkVertex(kArmpit, 2), {{kChest, 0.75}, {kLeftUpperArm, 0.25}});
    Set(TrunkVertex(kArmpit, 3), {{kChest, 0.6}, {kLeftUpperArm, 0.4}});
    Set(TrunkVertex(kArmpit, 4), {{kChest, 0.75}, {kLeftUpperArm, 0.25}});
    SetRow(kShoulder, {{kChest, 1.0}});
    Set(TrunkVertex(kShoulder, 2), {{kChest, 0.6}, {kLeftUpperArm, 0.4}});
    Set(TrunkVertex(kShoulder, 3), {{kChest, 0.6}, {kLeftUpperArm, 0.4}});
    Set(TrunkVertex(kShoulder, 4), {{kChest, 0.6}, {kLeftUpperArm, 0.4}});
  }

  void SetHead() {
    SetRow(kNeckBase, {{kChest, 0.65}, {kNeck, 0.35}});
    SetRow(kThroat, {{kNeck, 0.6}, {kHead, 0.4}});
    for (int row = kChin; row < kTrunkRows; ++row) SetRow(row, {{kHead, 1.0}});
    for (const int nape : {4, 5}) Set(TrunkVertex(kChin, nape), {{kNeck, 0.3}, {kHead, 0.7}});
    for (int k = 0; k < kCrownPoints; ++k) Set(CrownVertex(k), {{kHead, 1.0}});
  }

  void SetArm() {
    SetArmRing(kDeltoid, {{kChest, 0.08}, {kLeftUpperArm, 0.92}});
    SetArmRing(kBiceps, {{kLeftUpperArm, 1.0}});
    SetArmRing(kElbow, {{kLeftUpperArm, 0.5}, {kLeftForearm, 0.5}});
    SetArmRing(kForearm, {{kLeftForearm, 1.0}});
    SetArmRing(kLowerForearm, {{kLeftForearm, 1.0}});
    SetArmRing(kWrist, {{kLeftForearm, 0.5}, {kLeftHand, 0.5}});
    for (int ring = kPalm; ring < kArmRings; ++ring) SetArmRing(ring, {{kLeftHand, 1.0}});
    for (int k = 0; k < kThumbPoints; ++k) Set(ThumbVertex(k), {{kLeftHand, 1.0}});
  }

  void SetLeg() {
    SetLegRing(kUpperThigh, {{kPelvis, 0.06}, {kLeftThigh, 0.94}});
    SetLegRing(kMidThigh, {{kLeftThigh, 1.0}});
    SetLegRing(kAboveKnee, {{kLeftThigh, 0.85}, {kLeftShin, 0.15}});
    SetLegRing(kBelowKnee, {{kLeftThigh, 0.15}, {kLeftShin, 0.85}});
    SetLegRing(kCalf, {{kLeftShin, 1.0}});
    SetLegRing(kLowerCalf, {{kLeftShin, 1.0}});
    SetLegRing(kAnkle, {{kLeftShin, 0.6}, {kLeftFoot, 0.4}});
    for (int ring = kHeel; ring < kLegRings; ++ring) SetLegRing(ring, {{kLeftFoot, 1.0}});
    Set(LegVertex(kHeel, 4), {{kLeftShin, 0.2}, {kLeftFoot, 0.8}});
  }

  Eigen::MatrixXf weights_;
};

}  // namespace

Eigen::MatrixXf CageWeights() {
  const Eigen::MatrixXf left = LeftWeights().get();
  const Cage& cage = TheCage();
  Eigen::MatrixXf weights(cage.vertex_count(), kBoneCount);
  weights.topRows(kLeftVertices) = left;
  for (int v = 0; v < kLeftVertices; ++v) {
    if (cage.mirror[v] == v) continue;
    for (int bone = 0; bone < kBoneCount; ++bone) {
      weights(cage.mirror[v], Bones()[bone].mirror) = left(v, bone);
    }
  }
  return weights;
}

}  // namespace vitruvia::mannequin
