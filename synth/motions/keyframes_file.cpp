#include "synth/motions/keyframes_file.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "config/did_you_mean.h"
#include "config/json_settings.h"
#include "config/settings_schema.h"
#include "core/error.h"

namespace vitruvia {
namespace {

constexpr double kClosingTolerance_deg = 1e-6;
constexpr std::array<const char*, kSupportCount> kSupportNames = {"left_foot", "right_foot",
                                                                  "left_hand", "right_hand"};

struct NamedPose {
  std::string name;
  MentionedAngles angles;

  void Describe(Fields& f) {
    f.Text("name", name,
           {.meaning = "name of the pose, by which key frames refer to it", .required = true});
    f.Section("angles", angles, {.meaning = "joint angles", .required = true});
  }
};

struct KeyFrameSettings {
  double time_s = 0.0;
  std::string pose;
  bool mirrored = false;
  MentionedAngles angles;
  std::array<double, 2> position_m{};
  RootState root;
  std::vector<std::string> planted;

  void Describe(Fields& f);
  std::string Problem() const;
};

void KeyFrameSettings::Describe(Fields& f) {
  f.Number("time_s", time_s,
           {.meaning = "time of the key frame", .unit = "s", .min = 0.0, .required = true});
  f.Text("pose", pose, {.meaning = "the named pose to begin with; \"\": standing, arms hanging"});
  f.Flag("mirrored", mirrored,
         {.meaning = "left and right change places in the pose, the angles, roll and planted"});
  f.Section("angles", angles, {.meaning = "joint angles"});
  f.Numbers("position_m", position_m,
            {.meaning = "path of the pelvis on the floor, to the subject's left and front at the "
                        "start; the motion by planted limbs is added",
             .unit = "m"});
  f.Number("heading_deg", root.heading_deg,
           {.meaning = "rotation of the body to its left", .unit = "deg"});
  f.Number("pitch_deg", root.pitch_deg,
           {.meaning = "pelvis tipped forward; 180: upside down", .unit = "deg"});
  f.Number("roll_deg", root.roll_deg, {.meaning = "pelvis tipped to the left", .unit = "deg"});
  f.Number("clearance_m", root.clearance_m,
           {.meaning = "height of the lowest point above the floor",
            .unit = "m",
            .min = 0.0,
            .max = 2.0});
  f.Texts("planted", planted,
          {.meaning = "limbs that do not slip on the floor: any of left_foot, right_foot, "
                      "left_hand, right_hand; the pelvis moves instead"});
}

std::string KeyFrameSettings::Problem() const {
  for (const std::string& name : planted) {
    if (std::find(kSupportNames.begin(), kSupportNames.end(), name) != kSupportNames.end()) {
      if (std::count(planted.begin(), planted.end(), name) == 1) continue;
      return fmt::format("planted names \"{}\" twice", name);
    }
    return fmt::format("planted: expected any of {}; got \"{}\"{}", fmt::join(kSupportNames, ", "),
                       name, DidYouMean(name, {kSupportNames.begin(), kSupportNames.end()}, ", "));
  }
  return "";
}

struct MotionFile {
  std::string title;
  bool loop = false;
  bool then_mirrored = false;
  std::vector<NamedPose> poses;
  std::vector<KeyFrameSettings> keyframes;

  void Describe(Fields& f) {
    f.Text("title", title, {.meaning = "what the motion is"});
    f.Flag("loop", loop,
           {.meaning = "the motion repeats for ever; the last key frame must equal the first"});
    f.Flag("then_mirrored", then_mirrored,
           {.meaning = "append the motion with left and right exchanged; the last key frame is the "
                       "mirrored first"});
    f.List("poses", poses, {.meaning = "poses that key frames refer to"});
    f.List("keyframes", keyframes, {.meaning = "the key frames", .required = true});
  }
};

// What is wrong with the file as a whole, "" if nothing. Asked after reading, since a misspelt key
// explains missing key frames better.
std::string ProblemOf(const MotionFile& file) {
  const auto& [title, loop, then_mirrored, poses, keyframes] = file;
  if (keyframes.empty()) return "keyframes: expected at least one key frame, got an empty list";
  if (keyframes[0].time_s != 0.0) {
    return fmt::format("keyframes[0].time_s: expected 0 s, got {:g} s", keyframes[0].time_s);
  }
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    if (keyframes[i].time_s > keyframes[i - 1].time_s) continue;
    return fmt::format("keyframes[{}].time_s: expected more than the {:g} s before it, got {:g} s",
                       i, keyframes[i - 1].time_s, keyframes[i].time_s);
  }
  if ((loop || then_mirrored) && keyframes.size() < 2) {
    return "keyframes: expected at least two of a motion that repeats, got 1";
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (poses[i].name == poses[j].name) {
        return fmt::format("poses[{}].name: \"{}\" is taken by poses[{}]", i, poses[i].name, j);
      }
    }
  }
  return "";
}

void SwapSides(std::array<bool, kSupportCount>& planted) {
  std::swap(planted[kLeftFoot], planted[kRightFoot]);
  std::swap(planted[kLeftHand], planted[kRightHand]);
}

// The path is mirrored about the frontal direction at `origin`, which it goes on from.
KeyFrame MirroredAfter(const RootState& origin, const RootState& start, KeyFrame key) {
  key.angles = Mirrored(key.angles);
  key.root.left_m = origin.left_m - (key.root.left_m - start.left_m);
  key.root.forward_m = origin.forward_m + (key.root.forward_m - start.forward_m);
  key.root.heading_deg = origin.heading_deg - (key.root.heading_deg - start.heading_deg);
  key.root.roll_deg *= -1.0;
  SwapSides(key.planted);
  return key;
}

KeyFrame Resolved(const KeyFrameSettings& settings, const std::vector<NamedPose>& poses,
                  const std::string& where) {
  KeyFrame key;
  key.time_s = settings.time_s;
  if (!settings.pose.empty()) {
    std::vector<std::string> names;
    for (const NamedPose& pose : poses) names.push_back(pose.name);
    const auto found = std::find(names.begin(), names.end(), settings.pose);
    if (found == names.end()) {
      throw ConfigError(
          fmt::format("{}.pose: expected the name of a pose in this file ({}), got \"{}\"{}", where,
                      fmt::join(names, ", "), settings.pose, DidYouMean(settings.pose, names)));
    }
    poses[static_cast<std::size_t>(found - names.begin())].angles.ApplyTo(key.angles);
  }
  settings.angles.ApplyTo(key.angles);
  for (int side = 0; side < kSideCount; ++side) {
    const auto& angles = key.angles.sides_deg[static_cast<std::size_t>(side)];
    const double swing = std::hypot(angles[kShoulderFlexion], angles[kShoulderAbduction]);
    if (swing <= kMaxShoulderSwing_deg) continue;
    throw ConfigError(fmt::format(
        "{}.angles.{}_shoulder: flexion_deg {:g} and abduction_deg {:g} make a swing of {:.1f} "
        "deg; expected at most {:g} deg",
        where, side == kLeft ? "left" : "right", angles[kShoulderFlexion],
        angles[kShoulderAbduction], swing, kMaxShoulderSwing_deg));
  }
  key.root = settings.root;
  key.root.left_m = settings.position_m[0];
  key.root.forward_m = settings.position_m[1];
  for (std::size_t i = 0; i < kSupportCount; ++i) {
    key.planted[i] = std::count(settings.planted.begin(), settings.planted.end(),
                                std::string(kSupportNames[i])) > 0;
  }
  if (settings.mirrored) {
    key.angles = Mirrored(key.angles);
    key.root.roll_deg *= -1.0;
    SwapSides(key.planted);
  }
  return key;
}

// The first angle in which two poses differ, "" if there is none.
std::string Difference(const KeyFrame& a, const KeyFrame& b) {
  const auto differs = [](double x, double y) { return std::abs(x - y) > kClosingTolerance_deg; };
  const auto text = [](const std::string& joint, const char* key, double x, double y) {
    return fmt::format("{}.{} is {:g} and {:g}", joint, key, x, y);
  };
  for (const JointInfo& joint : MidlineJoints()) {
    for (std::size_t i = 0; i < joint.angles.size(); ++i) {
      const std::size_t k = static_cast<std::size_t>(joint.first) + i;
      const double x = a.angles.midline_deg[k], y = b.angles.midline_deg[k];
      if (differs(x, y)) return text(joint.name, joint.angles[i].key, x, y);
    }
  }
  for (const JointInfo& joint : SideJoints()) {
    for (std::size_t i = 0; i < joint.angles.size(); ++i) {
      const std::size_t k = static_cast<std::size_t>(joint.first) + i;
      for (std::size_t side = 0; side < kSideCount; ++side) {
        const double x = a.angles.sides_deg[side][k], y = b.angles.sides_deg[side][k];
        if (!differs(x, y)) continue;
        return text(fmt::format("{}_{}", side == kLeft ? "left" : "right", joint.name),
                    joint.angles[i].key, x, y);
      }
    }
  }
  if (differs(a.root.pitch_deg, b.root.pitch_deg)) {
    return text("the pelvis", "pitch_deg", a.root.pitch_deg, b.root.pitch_deg);
  }
  if (differs(a.root.roll_deg, b.root.roll_deg)) {
    return text("the pelvis", "roll_deg", a.root.roll_deg, b.root.roll_deg);
  }
  if (differs(a.root.clearance_m, b.root.clearance_m)) {
    return text("the body", "clearance_m", a.root.clearance_m, b.root.clearance_m);
  }
  return "";
}

void AppendMirrored(std::vector<KeyFrame>& keys, const std::string& file) {
  const KeyFrame first = keys.front(), last = keys.back();
  const std::string difference = Difference(last, MirroredAfter(last.root, first.root, first));
  if (!difference.empty()) {
    throw ConfigError(
        fmt::format("{}: then_mirrored: expected the last key frame to be the mirror "
                    "image of the first: {}",
                    file, difference));
  }
  const std::size_t count = keys.size();
  for (std::size_t i = 1; i < count; ++i) {
    keys.push_back(MirroredAfter(last.root, first.root, keys[i]));
    keys.back().time_s += last.time_s;
  }
}

void CheckLoop(const std::vector<KeyFrame>& keys, const std::string& file) {
  const std::string difference = Difference(keys.back(), keys.front());
  const double turned = keys.back().root.heading_deg - keys.front().root.heading_deg;
  if (difference.empty() && std::abs(std::remainder(turned, 360.0)) <= kClosingTolerance_deg) {
    return;
  }
  throw ConfigError(fmt::format(
      "{}: loop: expected the motion to end as it begins: {}", file,
      difference.empty() ? fmt::format("it turns by {:g} degrees, no multiple of 360", turned)
                         : difference));
}

}  // namespace

void VisitMotionFile(Fields& fields) { VisitDefaults<MotionFile>(fields); }

KeyframeSequence ReadKeyframes(const std::filesystem::path& file) {
  const auto settings = ReadSettingsFile<MotionFile>(file);
  if (const std::string problem = ProblemOf(settings); !problem.empty()) {
    throw ConfigError(fmt::format("{}: {}", file.string(), problem));
  }
  KeyframeSequence sequence;
  sequence.loop = settings.loop;
  for (std::size_t i = 0; i < settings.keyframes.size(); ++i) {
    sequence.keys.push_back(Resolved(settings.keyframes[i], settings.poses,
                                     fmt::format("{}: keyframes[{}]", file.string(), i)));
  }
  if (settings.then_mirrored) AppendMirrored(sequence.keys, file.string());
  if (settings.loop) CheckLoop(sequence.keys, file.string());
  return sequence;
}

}  // namespace vitruvia
