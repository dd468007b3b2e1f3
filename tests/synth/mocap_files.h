// Motion capture files written for a test: a performer of given build, posed at will.
#pragma once

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "body/skeleton.h"
#include "math/rotation.h"
#include "synth/motions/bvh.h"
#include "synth/motions/mocap_retarget.h"

namespace vitruvia {

inline std::unique_ptr<Motion> LoadBvh(const std::filesystem::path& bvh, const Skeleton& skeleton,
                                       const MocapSettings& settings = {}) {
  return Retarget(Understand(ReadBvh(bvh), settings, skeleton), skeleton);
}

inline std::unique_ptr<Motion> LoadAsfAmc(const std::filesystem::path& amc,
                                          const std::filesystem::path& asf,
                                          const Skeleton& skeleton,
                                          const AmcSettings& amc_settings = {}) {
  return Retarget(Understand(ReadAsfAmc(amc, asf, amc_settings), {}, skeleton), skeleton);
}

// Angles about x, y and z in degrees by joint name, and where the root is.
struct TestFrame {
  Vector3<double> root = Vector3<double>::Zero();
  std::map<std::string, Vector3<double>> angles_deg;
};

// A BVH file of a performer with the joints of `skeleton`, 100 frames/s; in the T-pose where all
// angles are zero. Unless `zero_pose` says otherwise, that is also where all numbers are zero.
class TestBvh {
 public:
  explicit TestBvh(const Skeleton& skeleton) : skeleton_(skeleton) {}

  double unit = 1.0;  // file units per metre
  std::array<std::string, kBoneCount> names{
      "Hips",        "Spine",    "Chest",      "Neck",         "Head",      "LeftArm",
      "LeftForeArm", "LeftHand", "RightArm",   "RightForeArm", "RightHand", "LeftUpLeg",
      "LeftLeg",     "LeftFoot", "RightUpLeg", "RightLeg",     "RightFoot"};
  // file axes from the skeleton's: x left, y up, z front
  std::function<Vector3<double>(const Vector3<double>&)> to_file = [](const auto& v) { return v; };

  // What turns each bone from where it is when all numbers are zero to where the T-pose has it.
  std::array<Matrix3<double>, kBoneCount> zero_pose = NoTurns();
  // Names of joints in the middle of hands and feet, "" where there is none.
  std::array<std::string, kBoneCount> beyond;
  // Names of fixed joints half-way between a joint's parent and the joint, "" where there is none.
  std::array<std::string, kBoneCount> before;
  // A fixed joint above the hips, which then carry the body's place; "" for none.
  std::string above;
  bool places_are_added = false;  // to the OFFSET of the hips, with `above`

  std::string Text(const std::vector<TestFrame>& frames) const {
    std::string text = "HIERARCHY\n";
    if (!above.empty()) {
      text += "ROOT " + above + "\n{\nOFFSET 0 0 0\n";
      text += "CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n";
    }
    text += Joint(0, above.empty() ? "ROOT" : "JOINT");
    if (!above.empty()) text += "}\n";
    text += fmt::format("MOTION\nFrames: {}\nFrame Time: 0.01\n", frames.size());
    for (const TestFrame& frame : frames) text += Line(frame);
    return text;
  }

 private:
  static std::array<Matrix3<double>, kBoneCount> NoTurns() {
    std::array<Matrix3<double>, kBoneCount> turns;
    turns.fill(Matrix3<double>::Identity());
    return turns;
  }

  // In the axes of `bone`, which it hangs on; -1 for none.
  std::string Offset(const Vector3<double>& offset, int bone) const {
    Vector3<double> v = unit * to_file(offset);
    if (bone >= 0) v = zero_pose[static_cast<std::size_t>(bone)].transpose() * v;
    return fmt::format("OFFSET {:.12f} {:.12f} {:.12f}\n", v.x(), v.y(), v.z());
  }

  std::string Joint(std::size_t bone, const std::string& keyword) const {
    const int parent = Bones()[bone].parent;
    const Vector3<double>& joint = skeleton_.joints[bone];
    const Vector3<double> from_parent =
        parent < 0 ? joint : joint - skeleton_.joints[static_cast<std::size_t>(parent)];
    const bool halved = !before[bone].empty();
    std::string text;
    if (halved) {
      text += "JOINT " + before[bone] + "\n{\n" + Offset(0.5 * from_parent, parent);
      text += "CHANNELS 3 Zrotation Yrotation Xrotation\n";
    }
    text += keyword + " " + names[bone] + "\n{\n";
    text += Offset((halved ? 0.5 : 1.0) * from_parent, parent);
    text += parent < 0 ? "CHANNELS 6 Xposition Yposition Zposition" : "CHANNELS 3";
    text += " Zrotation Yrotation Xrotation\n";
    bool leaf = true;
    for (std::size_t child = bone + 1; child < kBoneCount; ++child) {
      if (Bones()[child].parent != static_cast<int>(bone)) continue;
      text += Joint(child, "JOINT");
      leaf = false;
    }
    if (leaf) text += End(bone);
    return text + (halved ? "}\n}\n" : "}\n");
  }

  std::string End(std::size_t bone) const {
    const Vector3<double> tip = skeleton_.tips[bone] - skeleton_.joints[bone];
    const auto site = [&](double share) {
      return "End Site\n{\n" + Offset(share * tip, static_cast<int>(bone)) + "}\n";
    };
    if (beyond[bone].empty()) return site(1.0);
    return "JOINT " + beyond[bone] + "\n{\n" + Offset(0.5 * tip, static_cast<int>(bone)) +
           "CHANNELS 3 Zrotation Yrotation Xrotation\n" + site(0.5) + "}\n";
  }

  static Matrix3<double> Turn(double degrees, const Vector3<double>& axis) {
    return ExpSo3<double>(degrees / 57.29577951308232 * axis);
  }

  // z, y and x that multiply to a rotation, degrees.
  static Vector3<double> Angles(const Matrix3<double>& r) {
    const Vector3<double> zyx(std::atan2(r(1, 0), r(0, 0)), std::asin(-r(2, 0)),
                              std::atan2(r(2, 1), r(2, 2)));
    return 57.29577951308232 * zyx;
  }

  void AddJoint(std::size_t bone, const TestFrame& frame, std::string& line) const {
    const auto found = frame.angles_deg.find(names[bone]);
    const Vector3<double> angles =
        found == frame.angles_deg.end() ? Vector3<double>::Zero() : found->second;
    const Matrix3<double> turned = Turn(angles.z(), Vector3<double>::UnitZ()) *
                                   Turn(angles.y(), Vector3<double>::UnitY()) *
                                   Turn(angles.x(), Vector3<double>::UnitX());
    const int parent = Bones()[bone].parent;
    const Matrix3<double> of_parent =
        parent < 0 ? Matrix3<double>::Identity() : zero_pose[static_cast<std::size_t>(parent)];
    const Vector3<double> zyx = Angles(of_parent.transpose() * turned * zero_pose[bone]);
    if (!before[bone].empty()) line += " 0 0 0";
    line += fmt::format(" {:.12f} {:.12f} {:.12f}", zyx[0], zyx[1], zyx[2]);
    if (!beyond[bone].empty()) line += " 0 0 0";
    for (std::size_t child = bone + 1; child < kBoneCount; ++child) {
      if (Bones()[child].parent == static_cast<int>(bone)) AddJoint(child, frame, line);
    }
  }

  std::string Line(const TestFrame& frame) const {
    const Vector3<double> start = places_are_added ? Vector3<double>::Zero() : skeleton_.joints[0];
    const Vector3<double> root = unit * to_file(start + frame.root);
    std::string line = above.empty() ? "" : "0 0 0 0 0 0 ";
    line += fmt::format("{:.12f} {:.12f} {:.12f}", root.x(), root.y(), root.z());
    AddJoint(0, frame, line);
    return line + "\n";
  }

  Skeleton skeleton_;
};

// A skeleton like CMU's: arms along ±x, legs 20° apart with the feet turned along, local axes that
// differ from the world's. Units of some 5.6 cm.
inline constexpr const char* kTestAsf = R"(# a comment
:version 1.10
:name TEST
:units
  mass 1.0
  length 0.45
  angle deg
:documentation
  nothing: of note
:root
  order TX TY TZ RX RY RZ
  axis XYZ
  position 0 0 0
  orientation 0 0 0
:bonedata
  begin
    id 1
    name lhipjoint
    direction 0.8 -0.6 0
    length 2
    axis 0 0 0 XYZ
  end
  begin
    id 2
    name lfemur
    direction 0.342020143 -0.939692621 0
    length 8
    axis 0 0 20 XYZ
    dof rx ry rz
    limits (-160.0 20.0)
           (-70.0 70.0)
           (-60.0 70.0)
  end
  begin id 3
    name ltibia
    direction 0.342020143 -0.939692621 0
    length 7
    axis 0 0 20 XYZ
    dof rx
  end
  begin
    name lfoot
    direction 0.0885213 -0.2432103 0.9659258
    length 3
    axis -90 0 20 XYZ
    dof rx rz
  end
  begin
    name rhipjoint
    direction -0.8 -0.6 0
    length 2
    axis 0 0 0 XYZ
  end
  begin
    name rfemur
    direction -0.342020143 -0.939692621 0
    length 8
    axis 0 0 -20 XYZ
    dof rx ry rz
  end
  begin
    name rtibia
    direction -0.342020143 -0.939692621 0
    length 7
    axis 0 0 -20 XYZ
    dof rx
  end
  begin
    name rfoot
    direction -0.0885213 -0.2432103 0.9659258
    length 3
    axis -90 0 -20 XYZ
    dof rx rz
  end
  begin
    name lowerback
    direction 0 1 0
    length 2
    axis 0 0 0 XYZ
    dof rx ry rz
  end
  begin
    name thorax
    direction 0 1 0
    length 4
    axis 0 0 0 XYZ
    dof rx ry rz
  end
  begin
    name neck
    direction 0 1 0
    length 2
    axis 0 0 0 XYZ
    dof rx ry rz
  end
  begin
    name head
    direction 0 1 0
    length 3
    axis 0 0 0 XYZ
    dof rx ry rz
  end
  begin
    name lclavicle
    direction 1 0 0
    length 3
    axis 0 0 0 XYZ
  end
  begin
    name lhumerus
    direction 1 0 0
    length 5
    axis 180 -30 -90 XYZ
    dof rx ry rz
  end
  begin
    name lradius
    direction 1 0 0
    length 4
    axis 180 -30 -90 XYZ
    dof rx
  end
  begin
    name lhand
    direction 1 0 0
    length 2
    axis 0 90 90 XYZ
    dof rx rz
  end
  begin
    name rclavicle
    direction -1 0 0
    length 3
    axis 0 0 0 XYZ
  end
  begin
    name rhumerus
    direction -1 0 0
    length 5
    axis 180 30 90 XYZ
    dof rx ry rz
  end
  begin
    name rradius
    direction -1 0 0
    length 4
    axis 180 30 90 XYZ
    dof rx
  end
  begin
    name rhand
    direction -1 0 0
    length 2
    axis 0 -90 -90 XYZ
    dof rx rz
  end
:hierarchy
  begin
    root lhipjoint rhipjoint lowerback
    lhipjoint lfemur
    lfemur ltibia
    ltibia lfoot
    rhipjoint rfemur
    rfemur rtibia
    rtibia rfoot
    lowerback thorax
    thorax neck lclavicle rclavicle
    neck head
    lclavicle lhumerus
    lhumerus lradius
    lradius lhand
    rclavicle rhumerus
    rhumerus rradius
    rradius rhand
  end
)";

// One frame of a motion for it: the bones that are not named are as in the rest pose.
inline std::string AmcFrame(int number, const std::map<std::string, std::string>& values) {
  static const std::map<std::string, std::string> kRest{
      {"root", "0 17 0 0 0 0"}, {"lfemur", "0 0 0"}, {"ltibia", "0"},       {"lfoot", "0 0"},
      {"rfemur", "0 0 0"},      {"rtibia", "0"},     {"rfoot", "0 0"},      {"lowerback", "0 0 0"},
      {"thorax", "0 0 0"},      {"neck", "0 0 0"},   {"head", "0 0 0"},     {"lhumerus", "0 0 0"},
      {"lradius", "0"},         {"lhand", "0 0"},    {"rhumerus", "0 0 0"}, {"rradius", "0"},
      {"rhand", "0 0"}};
  std::string text = fmt::format("{}\n", number);
  for (const auto& [bone, rest] : kRest) {
    const auto found = values.find(bone);
    text += bone + " " + (found == values.end() ? rest : found->second) + "\n";
  }
  return text;
}

inline std::string Amc(const std::string& frames) {
  return "#!OML:ASF test\n:FULLY-SPECIFIED\n:DEGREES\n" + frames;
}

}  // namespace vitruvia
