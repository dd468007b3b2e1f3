#include "methods/dynamic/skeleton_file.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "body/skeleton.h"
#include "config/did_you_mean.h"
#include "config/json_settings.h"

namespace vitruvia::dynamic {
namespace {

std::vector<std::string> JointNames() {
  std::vector<std::string> names;
  for (const BoneInfo& bone : Bones()) names.emplace_back(bone.joint);
  return names;
}

std::vector<std::string> BoneNames() {
  std::vector<std::string> names;
  for (const BoneInfo& bone : Bones()) names.emplace_back(bone.name);
  return names;
}

std::string PlaceProblem(const JointSettings& joint) {
  if (FindJoint(joint.at) < 0) {
    return fmt::format("at: no joint of a subject is called \"{}\"{}", joint.at,
                       DidYouMean(joint.at, JointNames()));
  }
  if (!joint.bone.empty() && FindBone(joint.bone) < 0) {
    return fmt::format("bone: no bone of a subject is called \"{}\"{}", joint.bone,
                       DidYouMean(joint.bone, BoneNames()));
  }
  return "";
}

std::string AxisProblem(const JointSettings& joint) {
  const auto& [x, y, z] = joint.axis;
  const bool has_axis = x != 0.0 || y != 0.0 || z != 0.0;
  if (!joint.towards.empty() && has_axis) return "both axis and towards are given; expected one";
  if (!joint.towards.empty()) {
    if (joint.towards == joint.at) return "towards: names the joint's own place";
    if (FindJoint(joint.towards) >= 0) return "";
    return fmt::format("towards: no joint of a subject is called \"{}\"{}", joint.towards,
                       DidYouMean(joint.towards, JointNames()));
  }
  return has_axis ? "" : "axis: (0, 0, 0) has no direction";
}

std::string LimitProblem(const JointSettings& joint) {
  const bool hinge = joint.type == JointType::kHinge;
  const LimitSettings& limit = hinge ? joint.limit_deg : joint.limit_m;
  const char* key = hinge ? "limit_deg" : "limit_m";
  if (limit.lower > limit.upper) {
    return fmt::format("{}: lower {:g} is above upper {:g}", key, limit.lower, limit.upper);
  }
  if (limit.lower > 0.0 || limit.upper < 0.0) {
    return fmt::format("{}: {:g} … {:g} does not hold 0, the bind pose", key, limit.lower,
                       limit.upper);
  }
  return "";
}

// The first joint that does not hang on the world, if there is one.
std::string CycleProblem(const std::vector<JointSettings>& joints,
                         const std::map<std::string, std::size_t>& index) {
  for (const JointSettings& joint : joints) {
    const JointSettings* at = &joint;
    std::string chain = joint.name;
    for (std::size_t steps = 0; at->parent != kWorld; ++steps) {
      at = &joints[index.at(at->parent)];
      if (steps < joints.size()) chain += " → " + at->name;
      if (at == &joint || steps == joints.size()) {
        return fmt::format("joint \"{}\": its parents go round in a circle: {}", joint.name, chain);
      }
    }
  }
  return "";
}

}  // namespace

void LimitSettings::Describe(Fields& f) {
  f.Number("lower", lower, {.meaning = "lower limit of the joint value", .required = true});
  f.Number("upper", upper, {.meaning = "upper limit of the joint value", .required = true});
}

void JointSettings::Describe(Fields& f) {
  f.Text("name", name,
         {.meaning = "name of the joint and of the link that it carries", .required = true});
  f.Choice("type", type, {{"hinge", JointType::kHinge}, {"prismatic", JointType::kPrismatic}},
           {.meaning = "rotation about the axis (eq. 1) or translation along it (eq. 2)",
            .required = true});
  f.Text("parent", parent,
         {.meaning = "the joint whose link carries this joint, or \"world\"", .required = true});
  f.Text("at", at,
         {.meaning = "joint of the subject's skeleton where this one sits", .required = true});
  f.Numbers("axis", axis, {.meaning = "direction in the bind pose, subject frame; any length"});
  f.Text("towards", towards,
         {.meaning = "instead of axis: the joint of the subject's skeleton that it points at"});
  if (f.Applies(type == JointType::kHinge)) {
    f.Section("limit_deg", limit_deg,
              {.meaning = "range of a hinge, degrees", .unit = "deg", .required = true});
  }
  if (f.Applies(type == JointType::kPrismatic)) {
    f.Section("limit_m", limit_m,
              {.meaning = "range of a prismatic joint, metres", .unit = "m", .required = true});
  }
  f.Number("prior", prior,
           {.meaning = "factor on default_pose_weight for this joint's prior about its default 0",
            .min = 0.0,
            .max = 1e6,
            .origin = Origin::kPaper,
            .source = "paper B, sec. 4.2: all joints alike"});
  f.Text("bone", bone, {.meaning = "bone of the subject's skeleton that moves with the link"});
}

void SkeletonFile::Describe(Fields& f) {
  f.Text("name", name, {.meaning = "name of the skeleton", .required = true});
  f.Text("description", description, {.meaning = "purpose of the skeleton"});
  f.List("joints", joints, {.meaning = "hinges and prismatic joints", .required = true});
}

std::string SkeletonFile::Problem() const {
  std::map<std::string, std::size_t> index;
  std::map<std::string, std::string> mover;  // of each bone
  std::vector<std::string> names{kWorld};
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const JointSettings& joint = joints[i];
    if (joint.name.empty() || joint.name == kWorld) {
      return fmt::format("joints[{}]: \"{}\" is no name for a joint", i, joint.name);
    }
    if (!index.emplace(joint.name, i).second) {
      return fmt::format("joint \"{}\": there are two of that name", joint.name);
    }
    names.push_back(joint.name);
    for (const std::string& problem :
         {PlaceProblem(joint), AxisProblem(joint), LimitProblem(joint)}) {
      if (!problem.empty()) return fmt::format("joint \"{}\": {}", joint.name, problem);
    }
    if (joint.bone.empty()) continue;
    const auto [other, is_first] = mover.emplace(joint.bone, joint.name);
    if (!is_first) {
      return fmt::format("joint \"{}\": bone \"{}\" already moves with \"{}\"", joint.name,
                         joint.bone, other->second);
    }
  }
  for (const JointSettings& joint : joints) {
    if (joint.parent == kWorld || index.contains(joint.parent)) continue;
    return fmt::format("joint \"{}\": there is no parent \"{}\"{}", joint.name, joint.parent,
                       DidYouMean(joint.parent, names));
  }
  const std::string_view root = Bones()[0].name;
  if (!mover.contains(std::string(root))) {
    return fmt::format("no joint moves the bone \"{}\", on which all others hang", root);
  }
  return CycleProblem(joints, index);
}

SkeletonFile ReadSkeletonFile(const std::filesystem::path& file) {
  return ReadSettingsFile<SkeletonFile>(file);
}

}  // namespace vitruvia::dynamic
