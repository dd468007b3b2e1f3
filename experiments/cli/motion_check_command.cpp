#include "experiments/cli/motion_check_command.h"

#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>

#include "config/json_settings.h"
#include "experiments/cli/motion_check_text.h"
#include "math/rigid.h"
#include "reports/figures/motion_strip.h"
#include "synth/bodies/body_source.h"
#include "synth/scene/scene.h"

namespace vitruvia {
namespace fs = std::filesystem;

namespace {

using Vector3d = Vector3<double>;
using enum BoneId;

constexpr Color kLeftInk{0xC0, 0x30, 0x20}, kRightInk{0x20, 0x50, 0xB0},
    kTrunkInk{0x22, 0x22, 0x22};
constexpr Color kOtherInk{0xB0, 0xB0, 0xB0};
constexpr int kColumns = 8;

struct MotionCheckArguments {
  fs::path file, skeleton, output;
};

// The motion and the body of a scene, or a motion file with the default body.
struct CheckedMotion {
  MotionSettings motion;
  BodySettings body;
};

// 02_01.amc belongs to 02_01.asf or 02.asf, as the CMU database names them.
fs::path SkeletonOf(const fs::path& amc) {
  const std::string stem = amc.stem().string();
  for (const std::string& name : {stem, stem.substr(0, stem.find('_'))}) {
    const fs::path file = amc.parent_path() / (name + ".asf");
    if (fs::exists(file)) return file;
  }
  throw ConfigError(fmt::format(
      "{}: expected the .asf file of its skeleton beside it, or --skeleton", amc.string()));
}

std::string LowerCaseExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension;
}

CheckedMotion CheckedMotionOf(const MotionCheckArguments& a) {
  CheckedMotion checked;
  MotionSettings& motion = checked.motion;
  motion.file = a.file;
  motion.rest_s = motion.blend_s = 0.0;
  const std::string extension = LowerCaseExtension(a.file);
  if (extension == ".bvh") {
    motion.source = MotionSource::kBvh;
  } else if (extension == ".amc") {
    motion.source = MotionSource::kCmu;
    motion.skeleton = a.skeleton.empty() ? SkeletonOf(a.file) : a.skeleton;
  } else if (extension == ".json" && ReadJsonFile(a.file).contains("keyframes")) {
    motion.source = MotionSource::kKeyframes;
  } else if (extension == ".json") {
    const auto scene = ReadSettingsFile<SceneSettings>(a.file);
    checked = {scene.motion, scene.body};
  } else {
    throw ConfigError(fmt::format("{}: expected a .bvh, .amc or key-frame .json file, or a scene",
                                  a.file.string()));
  }
  return checked;
}

// Evenly over the clip, with its first and last frame.
std::vector<double> SharesShown() {
  std::vector<double> shares;
  for (int i = 0; i < kColumns; ++i) shares.push_back(static_cast<double>(i) / (kColumns - 1));
  return shares;
}

Color InkOf(BoneId bone) {
  const std::string_view name = Bones()[static_cast<std::size_t>(bone)].name;
  return name.starts_with("left") ? kLeftInk : name.starts_with("right") ? kRightInk : kTrunkInk;
}

// All joints of the file thin, and over them those that are taken.
StickFigure FigureOf(const MocapPerformer& performer, std::size_t frame) {
  const MocapClip& clip = performer.clip;
  const MocapPose pose = PoseOf(clip, clip.frames[frame]);
  StickFigure figure;
  figure.label = fmt::format("frame {}", frame + 1);
  const auto at = [&](BoneId bone) { return pose.positions[performer.joints.At(bone)]; };
  figure.center = 0.5 * (at(kLeftThigh) + at(kRightThigh));
  for (std::size_t i = 0; i < clip.joints.size(); ++i) {
    const Vector3d tip = pose.positions[i] + pose.rotations[i] * clip.joints[i].tip;
    figure.sticks.push_back({pose.positions[i], tip, {kOtherInk, 1.0}});
    if (clip.joints[i].parent < 0) continue;
    const auto parent = static_cast<std::size_t>(clip.joints[i].parent);
    figure.sticks.push_back({pose.positions[parent], pose.positions[i], {kOtherInk, 1.0}});
  }
  const auto stick = [&](BoneId from, BoneId to) {
    figure.sticks.push_back({at(from), at(to), {InkOf(from), 3.0}});
  };
  for (const auto& [upper, lower, end] : {std::tuple{kLeftUpperArm, kLeftForearm, kLeftHand},
                                          std::tuple{kRightUpperArm, kRightForearm, kRightHand},
                                          std::tuple{kLeftThigh, kLeftShin, kLeftFoot},
                                          std::tuple{kRightThigh, kRightShin, kRightFoot}}) {
    stick(upper, lower);
    stick(lower, end);
  }
  stick(kPelvis, kChest);
  stick(kChest, kHead);
  return figure;
}

StickFigure FigureOf(const Skeleton& skeleton, const Motion& motion, double time_s) {
  const BoneTransforms bones = ForwardKinematics(skeleton, motion.At(time_s).pose);
  StickFigure figure;
  figure.label = fmt::format("{:.2f} s", time_s);
  figure.center = bones[0] * skeleton.joints[0];
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    figure.sticks.push_back({bones[bone] * skeleton.joints[bone],
                             bones[bone] * skeleton.tips[bone],
                             {InkOf(static_cast<BoneId>(bone)), 3.0}});
  }
  return figure;
}

StickFigureRow BodyRow(const Skeleton& skeleton, const Motion& motion) {
  StickFigureRow row{"the body that does it: from the front, from the side", {}};
  for (const double share : SharesShown()) {
    row.figures.push_back(FigureOf(skeleton, motion, share * motion.duration_s()));
  }
  return row;
}

StickFigureRow FileRow(const MocapPerformer& performer) {
  StickFigureRow row{
      "the file's joints (left red, right blue, those that are not taken grey): from the front, "
      "from the side",
      {}};
  const auto last = static_cast<double>(performer.clip.frames.size() - 1);
  for (const double share : SharesShown()) {
    row.figures.push_back(FigureOf(performer, static_cast<std::size_t>(share * last)));
  }
  return row;
}

fs::path PictureStem(const MotionCheckArguments& a) {
  if (a.output.empty()) return a.file.stem().string() + "_check";
  fs::path stem = a.output;
  if (LowerCaseExtension(stem) == ".png") stem.replace_extension();
  return stem;
}

void CheckMotion(const MotionCheckArguments& a) {
  const CheckedMotion checked = CheckedMotionOf(a);
  const Skeleton skeleton = MakeControlBody(checked.body).skeleton;
  std::vector<StickFigureRow> rows;
  if (checked.motion.source != MotionSource::kKeyframes) {
    const MocapPerformer performer = LoadPerformer(checked.motion, skeleton);
    fmt::print("{}", DescribePerformer(performer));
    rows.push_back(FileRow(performer));
  }
  const std::unique_ptr<Motion> motion = LoadMotion(checked.motion, skeleton);
  fmt::print("motion:    {:.3f} s{}\n", motion->duration_s(),
             motion->repeats() ? ", repeated for ever" : "");
  rows.push_back(BodyRow(skeleton, *motion));
  const std::vector<std::string> warnings = motion->warnings();
  for (const std::string& warning : warnings) fmt::print("warning: {}\n", warning);
  fmt::print("{} warnings\n", warnings.size());
  const fs::path stem = PictureStem(a);
  WriteMotionStrip(stem, checked.motion.file.filename().string(), rows);
  fmt::print("picture:   {}.png\n", stem.string());
}

}  // namespace

void AddMotionCheckCommand(CLI::App& import) {
  auto a = std::make_shared<MotionCheckArguments>();
  CLI::App* motion = import.add_subcommand(
      "motion", "Check a motion file: print its interpretation and draw stick figures");
  motion
      ->add_option("--check", a->file,
                   "a .bvh or .amc file, a .json file of key frames, or a scene with its motion's "
                   "settings")
      ->required();
  motion->add_option("--skeleton", a->skeleton,
                     "the .asf file of an .amc; without it, that of the same name beside it");
  motion->add_option("-o,--output", a->output,
                     "the picture, .png (an .svg is written beside it); without it, "
                     "<FILE>_check.png in the current folder");
  motion->callback([a] { CheckMotion(*a); });
}

}  // namespace vitruvia
