#include "synth/motions/bvh.h"

#include <cmath>

#include "core/error.h"
#include "math/angles.h"
#include "synth/motions/mocap_words.h"

namespace vitruvia {
namespace {

using Word = MocapWords::Word;
using Vector3d = Vector3<double>;

constexpr int kMaxDepth = 256;  // of nested joints: deeper is no body

struct JointChannel {
  std::size_t joint = 0;
  int axis = 0;
  bool is_rotation = true;
};

class BvhReader {
 public:
  explicit BvhReader(const std::filesystem::path& file) : words_(file) { clip_.file = file; }

  MocapClip Read() {
    words_.TakeKeyword("HIERARCHY");
    words_.TakeKeyword("ROOT");
    ReadJoint(-1, 0);
    if (channels_.empty()) words_.Fail(words_.line(), "no joint has channels");
    words_.TakeKeyword("MOTION");
    words_.TakeKeyword("Frames:");
    const int count = words_.TakeCount("Frames");
    if (count == 0) words_.Fail(words_.line(), "no frames");
    words_.TakeKeyword("Frame");
    words_.TakeKeyword("Time:");
    clip_.frame_s = words_.TakeNumber("Frame Time");
    if (!(clip_.frame_s > 0.0)) words_.Fail(words_.line(), "Frame Time: expected above 0");
    for (int frame = 0; frame < count; ++frame) ReadFrame(frame, count);
    if (!words_.AtEnd()) {
      words_.Fail(words_.line(), fmt::format("more numbers than {} frames of {} channels take",
                                             count, channels_.size()));
    }
    SetTips();
    return std::move(clip_);
  }

 private:
  Vector3d TakeVector(std::string_view what) {
    const double x = words_.TakeNumber(what), y = words_.TakeNumber(what);
    return {x, y, words_.TakeNumber(what)};
  }

  // From a joint's name to its closing brace.
  void ReadJoint(int parent, int depth) {
    const Word name = words_.Take("a joint's name");
    if (depth > kMaxDepth) words_.Fail(name.line, "joints are nested too deeply");
    const auto index = static_cast<int>(clip_.joints.size());
    clip_.joints.push_back({std::string(name.text), parent});
    // Some exporters write names with blanks; the brace ends them.
    while (words_.Take("{").text != "{") {
    }
    while (true) {
      const Word word = words_.Take("}");
      if (word.text == "}") return;
      if (word.text == "OFFSET") {
        clip_.joints[static_cast<std::size_t>(index)].offset = TakeVector("OFFSET");
      } else if (word.text == "CHANNELS") {
        ReadChannels(static_cast<std::size_t>(index));
      } else if (word.text == "JOINT") {
        ReadJoint(index, depth + 1);
      } else if (word.text == "End") {
        ReadEndSite(static_cast<std::size_t>(index));
      } else {
        words_.Fail(word.line, fmt::format("expected OFFSET, CHANNELS, JOINT, End Site or a "
                                           "closing brace, got {}",
                                           word.text));
      }
    }
  }

  void ReadEndSite(std::size_t joint) {
    words_.TakeKeyword("Site");
    words_.TakeKeyword("{");
    words_.TakeKeyword("OFFSET");
    clip_.joints[joint].tip = TakeVector("OFFSET");
    words_.TakeKeyword("}");
  }

  void ReadChannels(std::size_t joint) {
    const int count = words_.TakeCount("CHANNELS");
    for (int i = 0; i < count; ++i) {
      const Word word = words_.Take("a channel");
      const std::size_t axis = std::string_view("XYZ").find(word.text[0]);
      const std::string_view kind = word.text.substr(1);
      if (axis == std::string_view::npos || (kind != "position" && kind != "rotation")) {
        words_.Fail(word.line, fmt::format("unknown channel {}", word.text));
      }
      channels_.push_back({joint, static_cast<int>(axis), kind == "rotation"});
    }
  }

  void ReadFrame(int frame, int count) {
    MocapFrame read;
    read.root_position = clip_.joints[0].offset;
    read.rotations.assign(clip_.joints.size(), Eigen::Quaterniond::Identity());
    for (const JointChannel& channel : channels_) {
      if (words_.AtEnd()) {
        words_.Fail(words_.line(),
                    fmt::format("the file ends in frame {} of {}", frame + 1, count));
      }
      const double value = words_.TakeNumber("MOTION");
      if (channel.is_rotation) {
        // Channels multiply in the order in which they are listed.
        read.rotations[channel.joint] =
            read.rotations[channel.joint] *
            Eigen::Quaterniond(
                Eigen::AngleAxisd(kRadiansPerDegree * value, Vector3d::Unit(channel.axis)));
      } else if (channel.joint == 0) {
        read.root_position[channel.axis] = value;
      }
    }
    clip_.frames.push_back(std::move(read));
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
};

}  // namespace

MocapClip ReadBvh(const std::filesystem::path& file) { return BvhReader(file).Read(); }

}  // namespace vitruvia
