#include "synth/motions/asf_amc.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "synth/motions/angle_unit.h"
#include "synth/motions/asf.h"

namespace vitruvia {
namespace {

using Word = MocapWords::Word;
using Vector3d = Vector3<double>;
using Eigen::Quaterniond;

// Rates that differ by less are the same, written with few digits.
constexpr double kSameRate = 1e-3;
// Frames that may be made up between two neighbours of a file: 10 s at 120 frames/s.
constexpr int kLongestGap = 1200;

struct NumberedFrame {
  int number = 0, line = 0;
  MocapFrame frame;
};

class AmcReader {
 public:
  AmcReader(const std::filesystem::path& file, const std::filesystem::path& asf,
            const AsfSkeleton& skeleton, const AmcSettings& settings)
      : words_(file),
        asf_(asf),
        skeleton_(skeleton),
        settings_(settings),
        radians_per_unit_(skeleton.radians_per_unit) {
    for (const AsfBone& bone : skeleton.bones) {
      for (const AsfChannel& channel : bone.channels) {
        moves_bones_ = moves_bones_ || (!channel.is_rotation && bone.parent >= 0);
      }
    }
  }

  std::vector<MocapFrame> Read(std::vector<std::string>& warnings) {
    ReadHeader();
    std::vector<NumberedFrame> frames;
    while (!words_.AtEnd()) {
      const int line = words_.line();
      const int number = words_.TakeCount("frame number");
      if (!frames.empty() && number <= frames.back().number) {
        words_.Fail(line, fmt::format("frame number {} after {}; expected {}: frames are repeated "
                                      "or out of order",
                                      number, frames.back().number, frames.back().number + 1));
      }
      frames.push_back({number, line, ReadFrame()});
    }
    if (frames.empty()) words_.Fail(words_.line(), "no frames");
    CheckAngles(warnings);
    return WithoutGaps(std::move(frames), warnings);
  }

 private:
  void ReadHeader() {
    while (!words_.AtEnd() && words_.Peek().text.starts_with(':')) {
      const std::vector<Word> line = words_.TakeLine();
      if (SameWord(line[0].text, ":degrees")) {
        radians_per_unit_ = kRadiansPerDegree;
      } else if (SameWord(line[0].text, ":radians")) {
        radians_per_unit_ = 1.0;
      } else if (SameWord(line[0].text, ":samples-per-second")) {
        ReadRate(line);
      } else if (!SameWord(line[0].text, ":fully-specified")) {
        FailUnknown(words_, line[0], "header word",
                    {":fully-specified", ":degrees", ":radians", ":samples-per-second"});
      }
    }
  }

  void ReadRate(const std::vector<Word>& line) const {
    if (line.size() != 2) words_.Fail(line[0].line, ":samples-per-second: expected one number");
    const double fps = words_.Number(line[1], ":samples-per-second");
    if (std::abs(fps - settings_.fps) <= kSameRate * settings_.fps) return;
    words_.Fail(line[0].line, fmt::format("the file has {:g} frames/s, but the motion's amc_fps is "
                                          "{:g}; expected the same",
                                          fps, settings_.fps));
  }

  bool AtFrameNumber() const {
    const char first = words_.Peek().text[0];
    return first >= '0' && first <= '9';
  }

  MocapFrame ReadFrame() {
    const int first_line = words_.line();
    MocapFrame frame;
    frame.rotations.assign(skeleton_.bones.size(), Quaterniond::Identity());
    if (moves_bones_) frame.offsets.assign(skeleton_.bones.size(), Vector3d::Zero());
    std::vector<bool> seen(skeleton_.bones.size(), false);
    while (!words_.AtEnd() && !AtFrameNumber()) {
      const std::vector<Word> line = words_.TakeLine();
      const auto bone = skeleton_.Find(line[0].text);
      if (!bone) {
        words_.Fail(line[0].line,
                    fmt::format("unknown bone {} (not in {})", line[0].text, asf_.string()));
      }
      const auto index = static_cast<std::size_t>(*bone);
      if (seen[index]) words_.Fail(line[0].line, fmt::format("{} twice in a frame", line[0].text));
      seen[index] = true;
      SetBone(line, index, frame);
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!seen[i] && !skeleton_.bones[i].channels.empty()) {
        words_.Fail(first_line, fmt::format("the frame that begins here lacks {}: the file is cut "
                                            "short or belongs to another skeleton",
                                            skeleton_.bones[i].name));
      }
    }
    return frame;
  }

  void SetBone(const std::vector<Word>& line, std::size_t index, MocapFrame& frame) {
    const AsfBone& bone = skeleton_.bones[index];
    if (line.size() != bone.channels.size() + 1) {
      words_.Fail(line[0].line, fmt::format("{}: {} numbers, expected {}", bone.name,
                                            line.size() - 1, bone.channels.size()));
    }
    Quaterniond turned = Quaterniond::Identity();
    Vector3d moved = Vector3d::Zero();
    for (std::size_t i = 0; i < bone.channels.size(); ++i) {
      const AsfChannel& channel = bone.channels[i];
      const double value = words_.Number(line[i + 1], bone.name);
      if (channel.is_rotation) {
        largest_angle_ = std::max(largest_angle_, radians_per_unit_ * std::abs(value));
        turned = TurnAbout(channel.axis, radians_per_unit_ * value) * turned;
      } else {
        moved[channel.axis] = value;
      }
    }
    frame.rotations[index] = bone.axes * turned * bone.axes.conjugate();
    if (bone.parent < 0) {
      frame.root_position = moved;
    } else if (moves_bones_) {
      frame.offsets[index] = bone.axes * moved;  // from the parent's end, which is added later
    }
  }

  void CheckAngles(std::vector<std::string>& warnings) const {
    const std::string doubt = radians_per_unit_ == 1.0
                                  ? RadiansDoubt(largest_angle_)
                                  : DegreesDoubt(largest_angle_ / kRadiansPerDegree);
    if (doubt.empty()) return;
    warnings.push_back(words_.At(1, fmt::format("{} ({} here or angle {} in the .asf)", doubt,
                                                radians_per_unit_ == 1.0 ? ":DEGREES" : ":RADIANS",
                                                radians_per_unit_ == 1.0 ? "deg" : "rad")));
  }

  std::vector<MocapFrame> WithoutGaps(std::vector<NumberedFrame> frames,
                                      std::vector<std::string>& warnings) const {
    std::vector<MocapFrame> filled;
    int gaps = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (i > 0 && frames[i].number != frames[i - 1].number + 1) {
        FillGap(frames[i - 1], frames[i], filled);
        ++gaps;
      }
      filled.push_back(std::move(frames[i].frame));
    }
    if (gaps > 0) {
      warnings.push_back(words_.At(
          frames[0].line, fmt::format("{} of {} frames are interpolated over {} gaps in the frame "
                                      "numbers",
                                      filled.size() - frames.size(), filled.size(), gaps)));
    }
    return filled;
  }

  // Frames between two of the file. (`before` itself is already in `filled`.)
  void FillGap(const NumberedFrame& before, const NumberedFrame& after,
               std::vector<MocapFrame>& filled) const {
    const int missing = after.number - before.number - 1;
    const std::string jump = fmt::format(
        "the frame numbers jump from {} to {}: {} frames are "
        "missing",
        before.number, after.number, missing);
    if (settings_.gaps == FrameGaps::kRefuse) {
      words_.Fail(after.line, jump + " (amc_gaps: interpolate fills them)");
    }
    if (missing > kLongestGap) {
      words_.Fail(after.line, fmt::format("{}; expected at most {}", jump, kLongestGap));
    }
    const MocapFrame from = filled.back();
    for (int i = 1; i <= missing; ++i) {
      const double share = static_cast<double>(i) / (missing + 1);
      MocapFrame frame = from;
      frame.root_position += share * (after.frame.root_position - from.root_position);
      for (std::size_t bone = 0; bone < frame.rotations.size(); ++bone) {
        frame.rotations[bone] = from.rotations[bone].slerp(share, after.frame.rotations[bone]);
      }
      for (std::size_t bone = 0; bone < frame.offsets.size(); ++bone) {
        frame.offsets[bone] += share * (after.frame.offsets[bone] - from.offsets[bone]);
      }
      filled.push_back(std::move(frame));
    }
  }

  MocapWords words_;
  const std::filesystem::path& asf_;
  const AsfSkeleton& skeleton_;
  const AmcSettings& settings_;
  double radians_per_unit_;
  double largest_angle_ = 0.0;  // radians
  bool moves_bones_ = false;
};

}  // namespace

void AmcSettings::Describe(Fields& f) {
  f.Number(
      "amc_fps", fps,
      {.meaning = "frame rate of the .amc file, which most such files do not state; the default is "
                  "the rate of CMU's clips; a file that states a different rate is rejected",
       .unit = "frames/s",
       .min = 5.0,
       .max = 2000.0,
       .origin = Origin::kGuessed});
  f.Choice("amc_gaps", gaps,
           {{"refuse", FrameGaps::kRefuse}, {"interpolate", FrameGaps::kInterpolate}},
           {.meaning = "treatment of gaps in the frame numbers of the .amc file: reject the file, "
                       "or interpolate the missing frames between their neighbours"});
}

MocapClip ReadAsfAmc(const std::filesystem::path& amc, const std::filesystem::path& asf,
                     const AmcSettings& settings) {
  const AsfSkeleton skeleton = ReadAsf(asf);
  MocapClip clip;
  clip.file = amc;
  clip.frame_s = 1.0 / settings.fps;
  clip.warnings = skeleton.warnings;
  for (const AsfBone& bone : skeleton.bones) {
    MocapJoint joint{bone.name, bone.parent, Vector3d::Zero(), bone.length * bone.direction};
    if (bone.parent >= 0) joint.offset = clip.joints[static_cast<std::size_t>(bone.parent)].tip;
    clip.joints.push_back(std::move(joint));
  }
  clip.frames = AmcReader(amc, asf, skeleton, settings).Read(clip.warnings);
  for (MocapFrame& frame : clip.frames) {
    for (std::size_t i = 0; i < frame.offsets.size(); ++i) {
      frame.offsets[i] += clip.joints[i].offset;
    }
  }
  return clip;
}

}  // namespace vitruvia
