#include "synth/motions/mocap_joints.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string_view>

#include "core/error.h"

namespace vitruvia {
namespace {

// Names of a limb's joint without its side, the surest first: where a rig has both LeftArm and
// LeftShoulder, the arm begins at LeftArm; where it has only LeftShoulder, there.
struct LimbNames {
  BoneId left, right;
  const char* what;
  std::initializer_list<std::string_view> names;
};

const std::array<LimbNames, 6>& Limbs() {
  using enum BoneId;
  static const std::array<LimbNames, 6> kLimbs{{
      {kLeftUpperArm,
       kRightUpperArm,
       "upper arm",
       {"arm", "upperarm", "uparm", "humerus", "shoulder"}},
      {kLeftForearm,
       kRightForearm,
       "forearm",
       {"forearm", "lowerarm", "lowarm", "radius", "elbow"}},
      {kLeftHand, kRightHand, "hand", {"hand", "wrist"}},
      {kLeftThigh, kRightThigh, "thigh", {"upleg", "upperleg", "thigh", "femur", "hip"}},
      {kLeftShin,
       kRightShin,
       "shin",
       {"leg", "lowerleg", "lowleg", "shin", "calf", "tibia", "knee"}},
      {kLeftFoot, kRightFoot, "foot", {"foot", "ankle"}},
  }};
  return kLimbs;
}

// Lower case letters and digits only, without a rig's prefix.
std::string Normalized(std::string_view name) {
  name = name.substr(name.rfind(':') + 1);  // npos + 1 is 0
  std::string result;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter)) result += static_cast<char>(std::tolower(letter));
  }
  for (const std::string_view prefix : {"mixamorig", "bip01", "bip001", "jbip"}) {
    if (result.starts_with(prefix)) result.erase(0, prefix.size());
  }
  return result;
}

class JointFinder {
 public:
  explicit JointFinder(const MocapClip& clip) : clip_(clip) {
    for (const MocapJoint& joint : clip.joints) names_.push_back(Normalized(joint.name));
  }

  MocapJoints Find() {
    found_.joints.fill(-1);
    for (const LimbNames& limb : Limbs()) {
      FindSide(limb, limb.left, "left");
      FindSide(limb, limb.right, "right");
    }
    At(BoneId::kHead) = IndexOf("head");
    if (At(BoneId::kHead) < 0) missing_.push_back("head");
    ThrowIfMissing();
    CheckLimb(BoneId::kLeftUpperArm, BoneId::kLeftForearm, BoneId::kLeftHand);
    CheckLimb(BoneId::kRightUpperArm, BoneId::kRightForearm, BoneId::kRightHand);
    CheckLimb(BoneId::kLeftThigh, BoneId::kLeftShin, BoneId::kLeftFoot);
    CheckLimb(BoneId::kRightThigh, BoneId::kRightShin, BoneId::kRightFoot);
    At(BoneId::kPelvis) = CommonAncestor(At(BoneId::kLeftThigh), At(BoneId::kRightThigh));
    At(BoneId::kChest) = CommonAncestor(At(BoneId::kLeftUpperArm), At(BoneId::kRightUpperArm));
    SetSources();
    return found_;
  }

 private:
  int& At(BoneId bone) { return found_.joints[static_cast<std::size_t>(bone)]; }
  MocapBoneSource& Source(BoneId bone) { return found_.sources[static_cast<std::size_t>(bone)]; }
  int Parent(int joint) const { return clip_.joints[static_cast<std::size_t>(joint)].parent; }

  int IndexOf(const std::string& name) const {
    const auto found = std::ranges::find(names_, name);
    return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
  }

  void FindSide(const LimbNames& limb, BoneId bone, const std::string& side) {
    for (const std::string_view name : limb.names) {
      for (const std::string& prefix : {side, side.substr(0, 1)}) {
        for (const std::string& candidate :
             {prefix + std::string(name), std::string(name) + prefix}) {
          if (At(bone) < 0) At(bone) = IndexOf(candidate);
        }
      }
    }
    if (At(bone) < 0) missing_.push_back(side + " " + limb.what);
  }

  void ThrowIfMissing() const {
    if (missing_.empty()) return;
    std::string missing, names;
    for (const std::string& part : missing_) missing += (missing.empty() ? "" : ", ") + part;
    for (const MocapJoint& joint : clip_.joints) names += (names.empty() ? "" : ", ") + joint.name;
    throw DataError(
        fmt::format("{}: cannot tell which joint is the {}; expected names such as "
                    "LeftArm, LeftForeArm, LeftHand, LeftUpLeg, LeftLeg, LeftFoot and "
                    "Head, or CMU's; the file has {}",
                    clip_.file.string(), missing, names));
  }

  bool Descends(int joint, int ancestor) const {
    while (joint >= 0 && joint != ancestor) joint = Parent(joint);
    return joint >= 0;
  }

  void CheckLimb(BoneId first, BoneId second, BoneId third) {
    if (At(first) != At(second) && At(second) != At(third) && Descends(At(second), At(first)) &&
        Descends(At(third), At(second))) {
      return;
    }
    const auto name = [&](BoneId bone) {
      return clip_.joints[static_cast<std::size_t>(At(bone))].name;
    };
    throw DataError(fmt::format("{}: {}, {} and {} do not follow each other in the joint tree",
                                clip_.file.string(), name(first), name(second), name(third)));
  }

  int CommonAncestor(int a, int b) const {
    while (!Descends(b, a)) a = Parent(a);
    return a;
  }

  // The last joint but one on the way from `begin` to `end`, or half-way between the two where
  // nothing lies between.
  MocapBoneSource Between(int begin, int end) const {
    const int middle = Parent(end);
    if (middle != begin && Descends(middle, begin)) return {middle, middle, 0.0};
    return {begin, end, 0.5};
  }

  void SetSources() {
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      found_.sources[bone] = {found_.joints[bone], found_.joints[bone], 0.0};
    }
    Source(BoneId::kAbdomen) = Between(At(BoneId::kPelvis), At(BoneId::kChest));
    Source(BoneId::kNeck) = Between(At(BoneId::kChest), At(BoneId::kHead));
    // A joint between elbow and wrist turns the lower end of the forearm; the whole bone takes
    // half.
    for (const auto& [forearm, hand] : {std::pair{BoneId::kLeftForearm, BoneId::kLeftHand},
                                        std::pair{BoneId::kRightForearm, BoneId::kRightHand}}) {
      Source(forearm) = {At(forearm), Parent(At(hand)), 0.5};
    }
  }

  const MocapClip& clip_;
  std::vector<std::string> names_;
  std::vector<std::string> missing_;
  MocapJoints found_;
};

}  // namespace

MocapJoints FindMocapJoints(const MocapClip& clip) { return JointFinder(clip).Find(); }

}  // namespace vitruvia
