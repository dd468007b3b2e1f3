#include "body/start_poses.h"

#include <array>
#include <utility>
#include <vector>

namespace vitruvia {
namespace {

AnatomicalPose BothSides(std::initializer_list<std::pair<SideAngle, double>> angles_deg) {
  AnatomicalPose pose;
  for (auto& side : pose.sides_deg) {
    for (const auto& [angle, value] : angles_deg) side[angle] = value;
  }
  return pose;
}

AnatomicalPose With(AnatomicalPose pose, Side side,
                    std::initializer_list<std::pair<SideAngle, double>> angles_deg) {
  for (const auto& [angle, value] : angles_deg) pose.sides_deg[side][angle] = value;
  return pose;
}

AnatomicalPose WithSpine(AnatomicalPose pose, double flexion_deg) {
  pose.midline_deg[kSpineFlexion] = flexion_deg;
  return pose;
}

std::vector<StartPose> MakeStartPoses() {
  const AnatomicalPose hanging = BothSides({{kShoulderAbduction, 8}, {kElbowFlexion, 8}});
  const AnatomicalPose walk = With(
      With(hanging, kLeft,
           {{kShoulderFlexion, -20}, {kElbowFlexion, 15}, {kHipFlexion, 25}, {kKneeFlexion, 8}}),
      kRight,
      {{kShoulderFlexion, 20}, {kElbowFlexion, 20}, {kHipFlexion, -15}, {kKneeFlexion, 25}});
  const AnatomicalPose left_up = With(
      hanging, kLeft, {{kShoulderFlexion, 90}, {kShoulderAbduction, 120}, {kElbowFlexion, 10}});
  const AnatomicalPose left_knee_up = With(hanging, kLeft, {{kHipFlexion, 80}, {kKneeFlexion, 80}});
  std::vector<StartPose> poses{
      {"T-pose", BothSides({{kShoulderAbduction, 90}})},
      {"A-pose", BothSides({{kShoulderAbduction, 45}, {kHipAbduction, 8}})},
      {"arms down", hanging},
      {"forearms raised", BothSides({{kShoulderAbduction, 10}, {kElbowFlexion, 90}})},
      {"hands at the chest",
       BothSides({{kShoulderFlexion, 35}, {kShoulderAbduction, 15}, {kElbowFlexion, 125}})},
      {"arms forward", BothSides({{kShoulderFlexion, 85}, {kElbowFlexion, 10}})},
      {"arms up", BothSides({{kShoulderAbduction, 150}, {kElbowFlexion, 10}})},
      {"sitting", BothSides({{kShoulderFlexion, 25},
                             {kShoulderAbduction, 8},
                             {kElbowFlexion, 50},
                             {kHipFlexion, 85},
                             {kKneeFlexion, 85}})},
      {"sitting, arms down", BothSides({{kShoulderFlexion, 5},
                                        {kShoulderAbduction, 12},
                                        {kElbowFlexion, 15},
                                        {kHipFlexion, 80},
                                        {kKneeFlexion, 85}})},
      {"sitting, bent forward", WithSpine(BothSides({{kShoulderFlexion, 0},
                                                     {kShoulderAbduction, 15},
                                                     {kElbowFlexion, 15},
                                                     {kHipFlexion, 90},
                                                     {kKneeFlexion, 90}}),
                                          45)},
      {"half squat", WithSpine(BothSides({{kShoulderFlexion, 40},
                                          {kShoulderAbduction, 12},
                                          {kElbowFlexion, 20},
                                          {kHipFlexion, 60},
                                          {kKneeFlexion, 70},
                                          {kDorsiflexion, 10}}),
                               15)},
      {"bent forward", WithSpine(BothSides({{kShoulderFlexion, 60},
                                            {kElbowFlexion, 10},
                                            {kHipFlexion, 40},
                                            {kKneeFlexion, 10}}),
                                 35)},
      {"crouching", WithSpine(BothSides({{kShoulderFlexion, 50},
                                         {kElbowFlexion, 40},
                                         {kHipFlexion, 110},
                                         {kKneeFlexion, 120},
                                         {kDorsiflexion, 15}}),
                              25)},
      {"walking, left leg in front", walk},
      {"left arm up", left_up},
      {"left knee up", left_knee_up},
  };
  for (const auto& [name, pose] :
       {StartPose{"walking, right leg in front", walk}, StartPose{"right arm up", left_up},
        StartPose{"right knee up", left_knee_up}}) {
    poses.push_back({name, Mirrored(pose)});
  }
  return poses;
}

std::vector<SideAngles> MakeArmPoses() {
  std::vector<SideAngles> poses;
  const auto add = [&](double flexion, double abduction, double rotation, double elbow) {
    SideAngles& pose = poses.emplace_back();
    pose[kShoulderFlexion] = flexion;
    pose[kShoulderAbduction] = abduction;
    pose[kShoulderRotation] = rotation;
    pose[kElbowFlexion] = elbow;
  };
  constexpr std::array<std::pair<double, double>, 11> kSwings{{{0, 10},
                                                               {45, 10},
                                                               {90, 10},
                                                               {140, 20},
                                                               {0, 50},
                                                               {0, 90},
                                                               {0, 140},
                                                               {60, 60},
                                                               {-30, 15},
                                                               {100, 100},
                                                               {40, -25}}};
  for (const auto& [flexion, abduction] : kSwings) {
    add(flexion, abduction, 0, 8);
    for (const double elbow : {50, 105}) {
      for (const double rotation : {-45, 0, 50}) add(flexion, abduction, rotation, elbow);
    }
  }
  return poses;
}

std::vector<SideAngles> MakeLegPoses() {
  std::vector<SideAngles> poses;
  for (const double flexion : {-15, 5, 30, 60, 90}) {
    for (const double knee : {5, 45, 90}) {
      if (flexion < 0 && knee > 45) continue;
      for (const double abduction : {3, 20}) {
        SideAngles& pose = poses.emplace_back();
        pose[kHipFlexion] = flexion;
        pose[kHipAbduction] = abduction;
        pose[kKneeFlexion] = knee;
      }
    }
  }
  return poses;
}

}  // namespace

std::span<const StartPose> StartPoses() {
  static const std::vector<StartPose> poses = MakeStartPoses();
  return poses;
}

std::span<const SideAngles> ArmPoses() {
  static const std::vector<SideAngles> poses = MakeArmPoses();
  return poses;
}

std::span<const SideAngles> LegPoses() {
  static const std::vector<SideAngles> poses = MakeLegPoses();
  return poses;
}

}  // namespace vitruvia
