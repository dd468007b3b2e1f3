#include "synth/motions/mocap_joints.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "config/did_you_mean.h"
#include "core/error.h"
#include "synth/motions/mocap_rigs.h"

namespace vitruvia {
namespace {

constexpr std::size_t Index(BoneId bone) { return static_cast<std::size_t>(bone); }

std::string_view JointName(BoneId bone) { return Bones()[Index(bone)].joint; }

bool IsSeparator(char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }

// How many first characters all names but the root's share, up to the last separator among them:
// the rig's own prefix, as in "m_avg_L_Hip" or "Bip01 L Thigh".
std::size_t SharedPrefix(const std::vector<std::string>& names) {
  if (names.size() < 2) return 0;
  std::string_view shared = names[1];
  for (std::size_t i = 2; i < names.size(); ++i) {
    const auto differs = std::ranges::mismatch(shared, names[i]);
    shared = shared.substr(0, static_cast<std::size_t>(differs.in1 - shared.begin()));
  }
  while (!shared.empty() && !IsSeparator(shared.back())) shared.remove_suffix(1);
  return shared.size();
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

std::vector<std::string> NormalizedNames(const MocapClip& clip) {
  std::vector<std::string> names;
  for (const MocapJoint& joint : clip.joints) names.push_back(joint.name);
  const std::size_t prefix = SharedPrefix(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = Normalized(i == 0 ? names[i] : names[i].substr(prefix));
  }
  // A word at the end of all names, as in "left_hip_jnt".
  for (const std::string_view suffix : {"joint", "jnt", "bone"}) {
    const auto has = [&](const std::string& name) { return name.ends_with(suffix); };
    if (!std::all_of(names.begin() + 1, names.end(), has)) continue;
    for (std::string& name : names) {
      if (has(name)) name.erase(name.size() - suffix.size());
    }
  }
  return names;
}

class JointFinder {
 public:
  JointFinder(const MocapClip& clip, const std::vector<MocapJointName>& named)
      : clip_(clip), names_(NormalizedNames(clip)) {
    given_.fill(-1);
    for (const MocapJointName& name : named) TakeGiven(name);
  }

  MocapJoints Find() {
    FindRig();
    SkipCollarBones(LimbJoint::kShoulder, LimbJoint::kElbow);
    SkipCollarBones(LimbJoint::kHip, LimbJoint::kKnee);
    CheckLimb(BoneId::kLeftUpperArm, BoneId::kLeftForearm, BoneId::kLeftHand);
    CheckLimb(BoneId::kRightUpperArm, BoneId::kRightForearm, BoneId::kRightHand);
    CheckLimb(BoneId::kLeftThigh, BoneId::kLeftShin, BoneId::kLeftFoot);
    CheckLimb(BoneId::kRightThigh, BoneId::kRightShin, BoneId::kRightFoot);
    SetTrunk(BoneId::kPelvis, BoneId::kLeftThigh, BoneId::kRightThigh);
    SetTrunk(BoneId::kChest, BoneId::kLeftUpperArm, BoneId::kRightUpperArm);
    SetSources();
    return found_;
  }

 private:
  using Joints = std::array<int, kBoneCount>;

  int& At(BoneId bone) { return found_.joints[Index(bone)]; }
  MocapBoneSource& Source(BoneId bone) { return found_.sources[Index(bone)]; }
  int Parent(int joint) const { return clip_.joints[static_cast<std::size_t>(joint)].parent; }
  bool Has(int joint, int ancestor) const { return Descends(clip_, joint, ancestor); }

  const std::string& Name(int joint) const {
    return clip_.joints[static_cast<std::size_t>(joint)].name;
  }
  std::string ParentName(int joint) const {
    return Parent(joint) < 0 ? "nothing" : Name(Parent(joint));
  }

  template <class... Args>
  [[noreturn]] void Fail(fmt::format_string<Args...> text, Args&&... args) const {
    throw DataError(clip_.file.string() + ": " + fmt::format(text, std::forward<Args>(args)...));
  }

  void TakeGiven(const MocapJointName& name) {
    const int bone = FindJoint(name.ours);
    Require(bone >= 0, "{} is no joint of the skeleton", name.ours);
    int& given = given_[static_cast<std::size_t>(bone)];
    std::vector<std::string> of_file;
    for (std::size_t i = 0; i < clip_.joints.size(); ++i) {
      of_file.push_back(clip_.joints[i].name);
      if (of_file.back() != name.file) continue;
      if (given >= 0) FailTwoOfOneName(given, static_cast<int>(i), name.ours);
      given = static_cast<int>(i);
    }
    if (given >= 0) return;
    const std::string nearest = NearestWord(name.file, of_file);
    Fail("there is no joint {}, which the motion's joints take for {}{}", name.file, name.ours,
         nearest.empty() ? "" : fmt::format(" (is {} meant?)", nearest));
  }

  [[noreturn]] void FailTwoOfOneName(int first, int second, std::string_view ours) const {
    const std::string remedy =
        Name(first) == Name(second)
            ? "rename one of them in the file"
            : fmt::format(R"(add {{"file": "{}", "ours": "{}"}} to the motion's joints, or {})",
                          Name(first), ours, Name(second));
    Fail(
        "two joints have one name, {} and {} (the first below {}, the second below {}), and "
        "either may be the {}: {}",
        Name(first), Name(second), ParentName(first), ParentName(second), ours, remedy);
  }

  void FindRig() {
    for (const MocapRig& rig : MocapRigs()) {
      if (!rig.mark.empty() && std::ranges::find(names_, rig.mark) == names_.end()) continue;
      found_.rig = rig.name;
      found_.joints = given_;
      missing_.clear();
      for (std::size_t i = 0; i < kLimbJointCount; ++i)
        FindLimbJoint(LimbJoints()[i], rig.names[i]);
      if (missing_.empty()) return;
    }
    ThrowMissing();
  }

  void FindLimbJoint(const LimbJointInfo& joint, const std::vector<std::string_view>& names) {
    if (joint.left == joint.right) {
      if (At(joint.left) < 0) At(joint.left) = WithName(std::string(names[0]), joint.left);
      if (At(joint.left) < 0) missing_.emplace_back(joint.what);
      return;
    }
    const bool one_is_given = (At(joint.left) < 0) != (At(joint.right) < 0);
    for (const std::string_view name : names) {
      for (const auto& [left, right] : SidesOf(std::string(name))) {
        if (At(joint.left) >= 0 && At(joint.right) >= 0) return;
        const int on_left = At(joint.left) >= 0 ? At(joint.left) : WithName(left, joint.left);
        const int on_right = At(joint.right) >= 0 ? At(joint.right) : WithName(right, joint.right);
        if (on_left < 0 && on_right < 0) continue;
        if (on_left < 0 || on_right < 0) {
          if (one_is_given) continue;
          return AddMissing(joint, names);
        }
        At(joint.left) = on_left;
        At(joint.right) = on_right;
      }
    }
    AddMissing(joint, names);
  }

  // The side that has none of the names; both if each has one, but of different kinds.
  void AddMissing(const LimbJointInfo& joint, const std::vector<std::string_view>& names) {
    bool on_left = At(joint.left) >= 0, on_right = At(joint.right) >= 0;
    if (on_left && on_right) return;
    for (const std::string_view name : names) {
      for (const auto& [left, right] : SidesOf(std::string(name))) {
        on_left = on_left || WithName(left, joint.left) >= 0;
        on_right = on_right || WithName(right, joint.right) >= 0;
      }
    }
    if (!on_left || on_right) missing_.push_back(fmt::format("left {}", joint.what));
    if (!on_right || on_left) missing_.push_back(fmt::format("right {}", joint.what));
  }

  static std::array<std::pair<std::string, std::string>, 4> SidesOf(const std::string& name) {
    return {{{"left" + name, "right" + name},
             {name + "left", name + "right"},
             {"l" + name, "r" + name},
             {name + "l", name + "r"}}};
  }

  // The joint of that name, -1 if there is none; where there are several, nobody can tell.
  int WithName(const std::string& name, BoneId bone) const {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end()) return -1;
    const auto second = std::find(found + 1, names_.end(), name);
    const auto index = static_cast<int>(found - names_.begin());
    if (second != names_.end()) {
      FailTwoOfOneName(index, static_cast<int>(second - names_.begin()), JointName(bone));
    }
    return index;
  }

  [[noreturn]] void ThrowMissing() const {
    std::string names;
    for (const MocapJoint& joint : clip_.joints) names += (names.empty() ? "" : ", ") + joint.name;
    Fail(
        "cannot tell which joint is the {}; expected names of one kind on both sides, such as "
        "LeftArm, LeftForeArm, LeftHand, LeftUpLeg, LeftLeg, LeftFoot and Head, or the motion's "
        "joints to say it; the file has {}",
        fmt::join(missing_, ", "), names);
  }

  // In some rigs the collar bone is called shoulder, or a bone of the pelvis hip. The joint that
  // begins the limb then lies below it under another name of the same joint.
  void SkipCollarBones(LimbJoint first, LimbJoint second) {
    const LimbJointInfo& begin = LimbJoints()[static_cast<std::size_t>(first)];
    const LimbJointInfo& end = LimbJoints()[static_cast<std::size_t>(second)];
    const auto& names = MocapRigs().back().names;
    const auto& of_begin = names[static_cast<std::size_t>(first)];
    const auto& of_end = names[static_cast<std::size_t>(second)];
    const int left = LowestBetween(begin.left, end.left, of_begin);
    const int right = LowestBetween(begin.right, end.right, of_begin);
    RequireNoneBetween(begin.left, end.left, of_end);
    RequireNoneBetween(begin.right, end.right, of_end);
    const bool both_by_name = given_[Index(begin.left)] < 0 && given_[Index(begin.right)] < 0;
    if (both_by_name && (left < 0) != (right < 0)) {
      FailEither(left < 0 ? begin.right : begin.left, left < 0 ? right : left);
    }
    if (left >= 0) At(begin.left) = left;
    if (right >= 0) At(begin.right) = right;
  }

  // The lowest joint between the two ends of a bone that has one of the names, with a side, and
  // some length below it; -1 if there is none or if the user has said where the bone begins.
  int LowestBetween(BoneId begin, BoneId end, const std::vector<std::string_view>& names) const {
    const int first = found_.joints[Index(begin)], last = found_.joints[Index(end)];
    if (given_[Index(begin)] >= 0 || !Has(last, first)) return -1;
    Vector3<double> to_last = Vector3<double>::Zero();
    for (int joint = last; joint != first; joint = Parent(joint)) {
      if (joint != last && to_last.norm() > 0.0 && HasSideName(joint, names)) return joint;
      to_last += clip_.joints[static_cast<std::size_t>(joint)].offset;
    }
    return -1;
  }

  bool HasSideName(int joint, const std::vector<std::string_view>& names) const {
    return std::ranges::any_of(names, [&](std::string_view name) {
      return std::ranges::any_of(SidesOf(std::string(name)), [&](const auto& sides) {
        return names_[static_cast<std::size_t>(joint)] == sides.first ||
               names_[static_cast<std::size_t>(joint)] == sides.second;
      });
    });
  }

  void RequireNoneBetween(BoneId begin, BoneId end,
                          const std::vector<std::string_view>& names) const {
    const int between = LowestBetween(begin, end, names);
    if (between >= 0) FailEither(begin, between);
  }

  [[noreturn]] void FailEither(BoneId bone, int other) const {
    Fail(R"(cannot tell whether {} or {}, which lies below it, is the {}; add {{"file": "{}", )"
         R"("ours": "{}"}} to the motion's joints, or {})",
         Name(found_.joints[Index(bone)]), Name(other), JointName(bone), Name(other),
         JointName(bone), Name(found_.joints[Index(bone)]));
  }

  void CheckLimb(BoneId first, BoneId second, BoneId third) {
    if (At(first) != At(second) && At(second) != At(third) && Has(At(second), At(first)) &&
        Has(At(third), At(second))) {
      return;
    }
    Fail("{}, {} and {} do not follow each other in the joint tree", Name(At(first)),
         Name(At(second)), Name(At(third)));
  }

  void SetTrunk(BoneId bone, BoneId left, BoneId right) {
    if (At(bone) >= 0) return;
    int common = At(left);
    while (!Has(At(right), common)) common = Parent(common);
    At(bone) = common;
  }

  // The last joint but one on the way from `begin` to `end`, or half-way between the two where
  // nothing lies between.
  MocapBoneSource Between(int begin, int end) const {
    const int middle = Parent(end);
    if (middle >= 0 && middle != begin && Has(middle, begin)) return {middle, middle, 0.0};
    return {begin, end, 0.5};
  }

  void SetSources() {
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      found_.sources[bone] = {found_.joints[bone], found_.joints[bone], 0.0};
    }
    if (At(BoneId::kAbdomen) < 0) {
      Source(BoneId::kAbdomen) = Between(At(BoneId::kPelvis), At(BoneId::kChest));
    }
    if (At(BoneId::kNeck) < 0) {
      Source(BoneId::kNeck) = Between(At(BoneId::kChest), At(BoneId::kHead));
    }
    // A joint between elbow and wrist turns the lower end of the forearm; the whole bone takes
    // half.
    for (const auto& [forearm, hand] : {std::pair{BoneId::kLeftForearm, BoneId::kLeftHand},
                                        std::pair{BoneId::kRightForearm, BoneId::kRightHand}}) {
      Source(forearm) = {At(forearm), Parent(At(hand)), 0.5};
    }
  }

  const MocapClip& clip_;
  std::vector<std::string> names_;
  Joints given_;
  std::vector<std::string> missing_;
  MocapJoints found_;
};

}  // namespace

void MocapJointName::Describe(Fields& f) {
  f.Text("file", file, {.meaning = "name of a joint in the motion file", .required = true});
  f.Text("ours", ours,
         {.meaning = "the joint of the skeleton that it is (FORMAT.md): left_shoulder, left_elbow, "
                     "left_wrist, left_hip, left_knee, left_ankle, the same on the right, head, "
                     "pelvis, waist, chest or neck",
          .required = true});
}

std::string MocapJointName::Problem() const {
  if (FindJoint(ours) >= 0) return "";
  std::vector<std::string> known;
  for (const BoneInfo& bone : Bones()) known.emplace_back(bone.joint);
  return fmt::format("ours: expected a joint of the skeleton ({}), got \"{}\"",
                     fmt::join(known, ", "), ours);
}

MocapJoints FindMocapJoints(const MocapClip& clip, const std::vector<MocapJointName>& named) {
  return JointFinder(clip, named).Find();
}

}  // namespace vitruvia
