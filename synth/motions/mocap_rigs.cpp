#include "synth/motions/mocap_rigs.h"

namespace vitruvia {

using enum BoneId;

const std::array<LimbJointInfo, kLimbJointCount>& LimbJoints() {
  static const std::array<LimbJointInfo, kLimbJointCount> kJoints{{
      {"shoulder", kLeftUpperArm, kRightUpperArm},
      {"elbow", kLeftForearm, kRightForearm},
      {"wrist", kLeftHand, kRightHand},
      {"hip", kLeftThigh, kRightThigh},
      {"knee", kLeftShin, kRightShin},
      {"ankle", kLeftFoot, kRightFoot},
      {"head", kHead, kHead},
  }};
  return kJoints;
}

// Names of bones stand for the joints at their near ends. A rig with both kinds of names (an ankle
// and a foot, a wrist and a hand, a shoulder and an upper arm) is recognised by the whole row: the
// foot of SMPL is the ball of the foot, its hand the middle of the hand; the wrist of CMU's Acclaim
// files is a joint inside the forearm; the shoulder of Mixamo and Xsens MVN is the collar bone.
std::span<const MocapRig> MocapRigs() {
  // A joint that is called wrist or ankle is that joint in any rig but CMU's.
  static const std::vector<std::string_view> kWrist{"wrist", "hand"}, kAnkle{"ankle", "foot"};
  static const std::vector<MocapRig> kRigs{
      // name, mark; shoulder, elbow, wrist, hip, knee, ankle, head
      {"CMU Acclaim",
       "",
       {{{"humerus"}, {"radius"}, {"hand"}, {"femur"}, {"tibia"}, {"foot"}, {"head"}}}},
      {"CMU Acclaim converted to BVH",
       "lhipjoint",
       {{{"shoulder"}, {"elbow"}, {"hand"}, {"hip"}, {"knee"}, {"ankle"}, {"head"}}}},
      {"SMPL, Kinect, Xsens BVH",
       "",
       {{{"shoulder"}, {"elbow"}, {"wrist"}, {"hip"}, {"knee"}, {"ankle"}, {"head"}}}},
      {"Mixamo, MotionBuilder, LAFAN",
       "",
       {{{"arm"}, {"forearm"}, kWrist, {"upleg"}, {"leg"}, kAnkle, {"head"}}}},
      {"3ds Max Biped",
       "",
       {{{"upperarm"}, {"forearm"}, kWrist, {"thigh"}, {"calf"}, kAnkle, {"head"}}}},
      {"Unreal", "", {{{"upperarm"}, {"lowerarm"}, kWrist, {"thigh"}, {"calf"}, kAnkle, {"head"}}}},
      {"Xsens MVN",
       "",
       {{{"upperarm"}, {"forearm"}, kWrist, {"upperleg"}, {"lowerleg"}, kAnkle, {"head"}}}},
      {"Unity, VRM",
       "",
       {{{"upperarm"}, {"lowerarm"}, kWrist, {"upperleg"}, {"lowerleg"}, kAnkle, {"head"}}}},
      {"Blender", "", {{{"upperarm"}, {"forearm"}, kWrist, {"thigh"}, {"shin"}, kAnkle, {"head"}}}},
      {"Rokoko", "", {{{"arm"}, {"forearm"}, kWrist, {"thigh"}, {"shin"}, kAnkle, {"head"}}}},
      {"Poser, Daz",
       "",
       {{{"shldr", "shldrbend"},
         {"forearm", "forearmbend"},
         kWrist,
         {"thigh", "thighbend"},
         {"shin"},
         kAnkle,
         {"head"}}}},
      {"OptiTrack", "", {{{"uarm"}, {"farm"}, kWrist, {"thigh"}, {"shin"}, kAnkle, {"head"}}}},
      {"names of several rigs",
       "",
       {{{"arm", "upperarm", "uparm", "uarm", "humerus", "shldr", "shoulder"},
         {"forearm", "lowerarm", "lowarm", "farm", "radius", "elbow"},
         kWrist,
         {"upleg", "upperleg", "uleg", "thigh", "femur", "hip"},
         {"leg", "lowerleg", "lowleg", "shin", "calf", "tibia", "knee"},
         kAnkle,
         {"head"}}}},
  };
  return kRigs;
}

}  // namespace vitruvia
