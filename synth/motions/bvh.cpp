#include "synth/motions/bvh.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/angles.h"
#include "synth/motions/angle_unit.h"
#include "synth/motions/frame_rate.h"
#include "synth/motions/mocap_words.h"

namespace vitruvia {
namespace {

using Word = MocapWords::Word;
using Vector3d = Vector3<double>;

constexpr int kMaxDepth = 256;  // of nested joints: deeper is no body
// Offsets of a frame that differ from those at rest by less than this share are digits cut off.
constexpr double kSameOffset = 1e-5;

struct JointChannel {
  std::size_t joint = 0;
  int axis = 0;
  bool is_rotation = true;
};

class BvhReader {
 public:
  explicit BvhReader(const std::filesystem::path& file) : words_(file) { clip_.file = file; }

  MocapClip Read() {
    ReadHierarchy();
    const int count = ReadMotionHeader();
    const int first_frame_line = words_.line();
    for (int frame = 0; frame < count; ++frame) ReadFrame(frame, count);
    if (!words_.AtEnd()) {
      words_.Fail(words_.line(), fmt::format("more numbers than {} frames of {} channels take",
                                             count, channels_.size()));
    }
    CheckAngles(first_frame_line);
    SetOffsets();
    SetTips();
    return std::move(clip_);
  }

 private:
  Vector3d TakeVector(std::string_view what) {
    const double x = words_.TakeNumber(what), y = words_.TakeNumber(what);
    return {x, y, words_.TakeNumber(what)};
  }

  void ReadHierarchy() {
    words_.TakeKeyword("HIERARCHY");
    words_.TakeKeyword("ROOT");
    ReadJoint(-1, 0);
    if (!words_.AtEnd() && SameWord(words_.Peek().text, "ROOT")) {
      words_.Fail(words_.line(), "a second ROOT; expected one skeleton per file");
    }
    if (channels_.empty()) words_.Fail(words_.line(), "no joint has channels");
  }

  int ReadMotionHeader() {
    words_.TakeKeyword("MOTION");
    words_.TakeKeyword("Frames:");
    const int count = words_.TakeCount("Frames");
    if (count == 0) words_.Fail(words_.line(), "no frames");
    words_.TakeKeyword("Frame");
    words_.TakeKeyword("Time:");
    const int line = words_.line();
    clip_.frame_s = words_.TakeNumber("Frame Time");
    const std::string problem = FrameTimeProblem(clip_.frame_s);
    if (!problem.empty()) words_.Fail(line, "Frame Time: " + problem);
    const std::string doubt = FrameTimeDoubt(clip_.frame_s);
    if (!doubt.empty()) clip_.warnings.push_back(words_.At(line, "Frame Time: " + doubt));
    return count;
  }

  // The words of a joint's line: names may hold blanks.
  std::string TakeName() {
    const Word first = words_.Take("a joint's name");
    if (first.text == "{") words_.Fail(first.line, "a joint without a name");
    std::string name(first.text);
    while (!words_.AtEnd() && words_.Peek().line == first.line && words_.Peek().text != "{") {
      name += fmt::format(" {}", words_.Take("a name").text);
    }
    return name;
  }

  // From a joint's name to its closing brace.
  void ReadJoint(int parent, int depth) {
    const int line = words_.line();
    if (depth > kMaxDepth) words_.Fail(line, "joints are nested too deeply");
    const std::size_t index = clip_.joints.size();
    clip_.joints.push_back({TakeName(), parent});
    words_.TakeKeyword("{");
    bool has_offset = false, has_channels = false;
    while (true) {
      const Word word = words_.Take("}");
      if (word.text == "}") break;
      if (SameWord(word.text, "OFFSET")) {
        RequireFirst(word, has_offset, index);
        clip_.joints[index].offset = TakeVector("OFFSET");
      } else if (SameWord(word.text, "CHANNELS")) {
        RequireFirst(word, has_channels, index);
        ReadChannels(index);
      } else if (SameWord(word.text, "JOINT")) {
        ReadJoint(static_cast<int>(index), depth + 1);
      } else if (SameWord(word.text, "End")) {
        ReadEndSite(index);
      } else {
        words_.Fail(word.line, fmt::format("expected OFFSET, CHANNELS, JOINT, End Site or a "
                                           "closing brace, got {}",
                                           word.text));
      }
    }
    if (!has_offset) {
      words_.Fail(line, fmt::format("joint {} has no OFFSET", clip_.joints[index].name));
    }
  }

  void RequireFirst(const Word& keyword, bool& seen, std::size_t joint) const {
    if (seen) {
      words_.Fail(keyword.line,
                  fmt::format("joint {} has a second {}", clip_.joints[joint].name, keyword.text));
    }
    seen = true;
  }

  void ReadEndSite(std::size_t joint) {
    words_.TakeKeyword("Site");
    words_.TakeKeyword("{");
    words_.TakeKeyword("OFFSET");
    clip_.joints[joint].tip = TakeVector("OFFSET");
    words_.TakeKeyword("}");
  }

  void ReadChannels(std::size_t joint) {
    const std::size_t first = channels_.size();
    const int count = words_.TakeCount("CHANNELS");
    for (int i = 0; i < count; ++i) {
      const Word word = words_.Take("a channel");
      const std::size_t axis = std::string_view("XYZxyz").find(word.text[0]);
      const std::string_view kind = word.text.substr(1);
      const bool is_rotation = SameWord(kind, "rotation");
      if (axis == std::string_view::npos || (!is_rotation && !SameWord(kind, "position"))) {
        words_.Fail(word.line, fmt::format("unknown channel {}", word.text));
      }
      const JointChannel channel{joint, static_cast<int>(axis % 3), is_rotation};
      for (std::size_t before = first; before < channels_.size(); ++before) {
        if (channels_[before].axis == channel.axis &&
            channels_[before].is_rotation == is_rotation) {
          words_.Fail(word.line, fmt::format("joint {} has the channel {} twice",
                                             clip_.joints[joint].name, word.text));
        }
      }
      channels_.push_back(channel);
      moves_joints_ = moves_joints_ || (!is_rotation && joint > 0);
    }
  }

  void ReadFrame(int frame, int count) {
    MocapFrame read;
    read.root_position = clip_.joints[0].offset;
    read.rotations.assign(clip_.joints.size(), Eigen::Quaterniond::Identity());
    if (moves_joints_) {
      for (const MocapJoint& joint : clip_.joints) read.offsets.push_back(joint.offset);
    }
    int line = 0;
    for (const JointChannel& channel : channels_) {
      if (words_.AtEnd()) {
        words_.Fail(words_.line(),
                    fmt::format("the file ends in frame {} of {}", frame + 1, count));
      }
      line = words_.line();
      const double value = words_.TakeNumber("MOTION");
      if (channel.is_rotation) {
        largest_angle_deg_ = std::max(largest_angle_deg_, std::abs(value));
        // Channels multiply in the order in which they are listed.
        read.rotations[channel.joint] =
            read.rotations[channel.joint] *
            Eigen::Quaterniond(
                Eigen::AngleAxisd(kRadiansPerDegree * value, Vector3d::Unit(channel.axis)));
      } else if (channel.joint == 0) {
        read.root_position[channel.axis] = value;
      } else {
        read.offsets[channel.joint][channel.axis] = value;
      }
    }
    if (!words_.AtEnd() && words_.Peek().line == line) {
      words_.Fail(line, fmt::format("frame {} of {} ends in the middle of this line: expected {} "
                                    "numbers, one per channel; this line or one before it has too "
                                    "many or too few",
                                    frame + 1, count, channels_.size()));
    }
    clip_.frames.push_back(std::move(read));
  }

  void CheckAngles(int first_frame_line) {
    const std::string doubt = DegreesDoubt(largest_angle_deg_);
    if (doubt.empty()) return;
    clip_.warnings.push_back(
        words_.At(first_frame_line, doubt + " BVH has degrees; so they are taken"));
  }

  // Whether position channels below the root replace OFFSETs or are added to them.
  void SetOffsets() {
    if (!moves_joints_) return;
    double if_replacing = 0.0, if_added = 0.0;  // how far the joints move from their OFFSETs
    ForEachTranslation([&](double& value, double offset) {
      if_replacing += std::abs(value - offset);
      if_added += std::abs(value);
    });
    const bool replace = if_replacing <= if_added;
    if (!replace) ForEachTranslation([](double& value, double offset) { value += offset; });
    clip_.notes.push_back(fmt::format(
        "{}: position channels of joints below the root {} (on average {:.3g} from the OFFSETs; "
        "{:.3g} otherwise)",
        clip_.file.string(), replace ? "replace the OFFSETs" : "are added to the OFFSETs",
        std::min(if_replacing, if_added) / NumTranslations(),
        std::max(if_replacing, if_added) / NumTranslations()));
    DropOffsetsAtRest();
  }

  template <class Action>
  void ForEachTranslation(Action&& action) {
    for (MocapFrame& frame : clip_.frames) {
      for (const JointChannel& channel : channels_) {
        if (channel.is_rotation || channel.joint == 0) continue;
        action(frame.offsets[channel.joint][channel.axis],
               clip_.joints[channel.joint].offset[channel.axis]);
      }
    }
  }

  double NumTranslations() {
    double count = 0.0;
    ForEachTranslation([&](double&, double) { ++count; });
    return count;
  }

  // Six channels on every joint of a rigid skeleton are redundant.
  void DropOffsetsAtRest() {
    for (const MocapFrame& frame : clip_.frames) {
      for (std::size_t i = 1; i < clip_.joints.size(); ++i) {
        const Vector3d& rest = clip_.joints[i].offset;
        if ((frame.offsets[i] - rest).norm() > kSameOffset * rest.norm()) return;
      }
    }
    for (MocapFrame& frame : clip_.frames) frame.offsets.clear();
  }

  // A joint without an end site ends at the mean of its children.
  void SetTips() {
    std::vector<Vector3d> sums(clip_.joints.size(), Vector3d::Zero());
    std::vector<int> counts(clip_.joints.size(), 0);
    for (const MocapJoint& joint : clip_.joints) {
      if (joint.parent < 0) continue;
      sums[static_cast<std::size_t>(joint.parent)] += joint.offset;
      ++counts[static_cast<std::size_t>(joint.parent)];
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (counts[i] > 0) clip_.joints[i].tip = sums[i] / counts[i];
    }
  }

  MocapWords words_;
  MocapClip clip_;
  std::vector<JointChannel> channels_;
  bool moves_joints_ = false;
  double largest_angle_deg_ = 0.0;
};

}  // namespace

MocapClip ReadBvh(const std::filesystem::path& file) { return BvhReader(file).Read(); }

}  // namespace vitruvia
