#include "synth/motions/asf_amc.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/error.h"
#include "math/angles.h"
#include "synth/motions/mocap_words.h"

namespace vitruvia {
namespace {

using Word = MocapWords::Word;
using Vector3d = Vector3<double>;
using Eigen::Quaterniond;

constexpr const char* kRoot = "root";

// One number of a bone's line in a motion file.
struct Channel {
  int axis = 0;  // 0 … 2: x, y, z
  bool is_rotation = true;
};

struct AsfBone {
  std::string name;
  int line = 0;
  int parent = -1;
  Vector3d direction = Vector3d::Zero();  // of the bone at rest, unit length
  double length = 0.0;
  Quaterniond axes = Quaterniond::Identity();  // rest_from_local: what the channels turn about
  std::vector<Channel> channels;
};

struct AsfSkeleton {
  std::vector<AsfBone> bones;  // the root first, parents before children
  double radians_per_unit = kRadiansPerDegree;

  std::optional<int> Find(std::string_view name) const {
    const auto found = std::ranges::find(bones, name, &AsfBone::name);
    if (found == bones.end()) return {};
    return static_cast<int>(found - bones.begin());
  }
};

Quaterniond TurnAbout(int axis, double angle) {
  return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::Unit(axis)));
}

class AsfReader {
 public:
  explicit AsfReader(const std::filesystem::path& file) : words_(file) {}

  AsfSkeleton Read() {
    skeleton_.bones.emplace_back().name = kRoot;
    while (!words_.AtEnd()) {
      const std::vector<Word> line = words_.TakeLine();
      if (line[0].text == ":units") ReadUnits();
      if (line[0].text == ":root") ReadRoot();
      if (line[0].text == ":bonedata") ReadBones();
      if (line[0].text == ":hierarchy") ReadHierarchy();
    }
    if (skeleton_.bones.size() < 2) words_.Fail(words_.line(), "no bones (section :bonedata)");
    return ParentsFirst();
  }

 private:
  bool InSection() const { return !words_.AtEnd() && !words_.Peek().text.starts_with(':'); }

  void ReadUnits() {
    while (InSection()) {
      const std::vector<Word> line = words_.TakeLine();
      if (line[0].text != "angle") continue;
      const std::string_view unit = line.size() == 2 ? line[1].text : "";
      if (unit != "deg" && unit != "rad") {
        words_.Fail(line[0].line, "angle: expected deg or rad");
      }
      skeleton_.radians_per_unit = unit == "deg" ? kRadiansPerDegree : 1.0;
    }
  }

  void ReadRoot() {
    AsfBone& root = skeleton_.bones[0];
    std::vector<Word> axis_order, orientation;
    while (InSection()) {
      const std::vector<Word> line = words_.TakeLine();
      root.line = line[0].line;
      if (line[0].text == "order") root.channels = Channels(line);
      if (line[0].text == "axis") axis_order = line;
      if (line[0].text == "orientation") orientation = line;
    }
    if (root.channels.empty()) words_.Fail(root.line, ":root has no order");
    if (axis_order.size() == 2 && orientation.size() == 4) {
      orientation.push_back(axis_order[1]);
      root.axes = Axes(orientation);
    }
  }

  void ReadBones() {
    while (InSection()) {
      words_.TakeKeyword("begin");
      skeleton_.bones.push_back(ReadBone());
    }
  }

  AsfBone ReadBone() {
    AsfBone bone;
    bone.line = words_.line();
    while (true) {
      if (!InSection()) words_.Fail(words_.line(), "a bone's end is missing");
      const std::vector<Word> line = words_.TakeLine();
      const std::string_view key = line[0].text;
      if (key == "end") break;
      if (key == "name" && line.size() == 2) bone.name = line[1].text;
      if (key == "direction") bone.direction = Numbers(line);
      if (key == "length") bone.length = Length(line);
      if (key == "axis") bone.axes = Axes(line);
      if (key == "dof") bone.channels = Channels(line);
    }
    if (bone.name.empty()) words_.Fail(bone.line, "a bone without name");
    if (skeleton_.Find(bone.name)) {
      words_.Fail(bone.line, fmt::format("a second bone {}", bone.name));
    }
    if (!(bone.direction.norm() > 0.0)) {
      words_.Fail(bone.line, fmt::format("bone {} has no direction", bone.name));
    }
    bone.direction.normalize();
    return bone;
  }

  void ReadHierarchy() {
    words_.TakeKeyword("begin");
    while (true) {
      if (!InSection()) words_.Fail(words_.line(), "the hierarchy's end is missing");
      const std::vector<Word> line = words_.TakeLine();
      if (line[0].text == "end") return;
      const int parent = Known(line[0]);
      for (std::size_t i = 1; i < line.size(); ++i) {
        const int child = Known(line[i]);
        AsfBone& bone = skeleton_.bones[static_cast<std::size_t>(child)];
        if (child == 0 || bone.parent >= 0) {
          words_.Fail(line[i].line, fmt::format("{} has two parents", bone.name));
        }
        bone.parent = parent;
      }
    }
  }

  int Known(const Word& word) const {
    const auto bone = skeleton_.Find(word.text);
    if (!bone) words_.Fail(word.line, fmt::format("unknown bone {}", word.text));
    return *bone;
  }

  Vector3d Numbers(const std::vector<Word>& line) const {
    if (line.size() < 4) {
      words_.Fail(line[0].line, fmt::format("{}: expected three numbers", line[0].text));
    }
    return {words_.Number(line[1], line[0].text), words_.Number(line[2], line[0].text),
            words_.Number(line[3], line[0].text)};
  }

  double Length(const std::vector<Word>& line) const {
    const double length = line.size() == 2 ? words_.Number(line[1], "length") : -1.0;
    if (length < 0.0) words_.Fail(line[0].line, "length: expected one number ≥ 0");
    return length;
  }

  // "axis a b c XYZ": the turn about x by a first, then y, then z.
  Quaterniond Axes(const std::vector<Word>& line) const {
    const Vector3d angles = Numbers(line);
    Quaterniond axes = Quaterniond::Identity();
    const std::string_view order = line.size() == 5 ? line[4].text : "";
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::size_t axis = std::string_view("XYZ").find(order[i]);
      if (axis == std::string_view::npos) break;
      axes = TurnAbout(static_cast<int>(axis),
                       skeleton_.radians_per_unit * angles[static_cast<Eigen::Index>(i)]) *
             axes;
    }
    std::string sorted(order);
    std::ranges::sort(sorted);
    if (sorted != "XYZ") words_.Fail(line[0].line, "expected three angles and their order");
    return axes;
  }

  // "rx ry rz" of a bone, "TX TY TZ RX RY RZ" of the root; "l" (a bone's stretch) is not supported.
  std::vector<Channel> Channels(const std::vector<Word>& line) const {
    std::vector<Channel> channels;
    for (std::size_t i = 1; i < line.size(); ++i) {
      std::string name(line[i].text);
      for (char& c : name) c = static_cast<char>(c | 0x20);  // to lower case
      const std::size_t axis =
          name.size() == 2 ? std::string_view("xyz").find(name[1]) : std::string_view::npos;
      if (axis == std::string_view::npos || (name[0] != 'r' && name[0] != 't')) {
        words_.Fail(line[i].line, fmt::format("unknown degree of freedom {}", line[i].text));
      }
      channels.push_back({static_cast<int>(axis), name[0] == 'r'});
    }
    return channels;
  }

  // Bones in an order where parents come first.
  AsfSkeleton ParentsFirst() const {
    AsfSkeleton ordered{{skeleton_.bones[0]}, skeleton_.radians_per_unit};
    std::vector<int> old_index{0};
    for (std::size_t next = 0; next < ordered.bones.size(); ++next) {
      for (std::size_t i = 1; i < skeleton_.bones.size(); ++i) {
        if (skeleton_.bones[i].parent != old_index[next]) continue;
        ordered.bones.push_back(skeleton_.bones[i]);
        ordered.bones.back().parent = static_cast<int>(next);
        old_index.push_back(static_cast<int>(i));
      }
    }
    for (const AsfBone& bone : skeleton_.bones) {
      if (!ordered.Find(bone.name)) {
        words_.Fail(bone.line, fmt::format("bone {} does not hang on the root", bone.name));
      }
    }
    return ordered;
  }

  MocapWords words_;
  AsfSkeleton skeleton_;
};

class AmcReader {
 public:
  AmcReader(const std::filesystem::path& file, const std::filesystem::path& asf,
            const AsfSkeleton& skeleton)
      : words_(file), asf_(asf), skeleton_(skeleton) {}

  std::vector<MocapFrame> Read() {
    double radians_per_unit = skeleton_.radians_per_unit;
    while (!words_.AtEnd() && words_.Peek().text.starts_with(':')) {
      const std::string_view keyword = words_.TakeLine()[0].text;
      if (keyword == ":DEGREES") radians_per_unit = kRadiansPerDegree;
      if (keyword == ":RADIANS") radians_per_unit = 1.0;
    }
    std::vector<MocapFrame> frames;
    while (!words_.AtEnd()) {
      words_.TakeCount("frame number");
      frames.push_back(ReadFrame(radians_per_unit));
    }
    if (frames.empty()) words_.Fail(words_.line(), "no frames");
    return frames;
  }

 private:
  bool AtFrameNumber() const {
    const char first = words_.Peek().text[0];
    return first >= '0' && first <= '9';
  }

  MocapFrame ReadFrame(double radians_per_unit) {
    const int first_line = words_.line();
    MocapFrame frame;
    frame.rotations.assign(skeleton_.bones.size(), Quaterniond::Identity());
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
      SetBone(line, skeleton_.bones[index], radians_per_unit, frame.rotations[index],
              frame.root_position);
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

  void SetBone(const std::vector<Word>& line, const AsfBone& bone, double radians_per_unit,
               Quaterniond& rotation, Vector3d& root_position) const {
    if (line.size() != bone.channels.size() + 1) {
      words_.Fail(line[0].line, fmt::format("{}: {} numbers, expected {}", bone.name,
                                            line.size() - 1, bone.channels.size()));
    }
    Quaterniond turned = Quaterniond::Identity();
    for (std::size_t i = 0; i < bone.channels.size(); ++i) {
      const Channel& channel = bone.channels[i];
      const double value = words_.Number(line[i + 1], bone.name);
      if (channel.is_rotation) {
        turned = TurnAbout(channel.axis, radians_per_unit * value) * turned;
      } else if (bone.parent < 0) {
        root_position[channel.axis] = value;
      }
    }
    rotation = bone.axes * turned * bone.axes.conjugate();
  }

  MocapWords words_;
  const std::filesystem::path& asf_;
  const AsfSkeleton& skeleton_;
};

}  // namespace

MocapClip ReadAsfAmc(const std::filesystem::path& amc, const std::filesystem::path& asf) {
  const AsfSkeleton skeleton = AsfReader(asf).Read();
  MocapClip clip;
  clip.file = amc;
  clip.frame_s = kAmcFrame_s;
  for (const AsfBone& bone : skeleton.bones) {
    MocapJoint joint{bone.name, bone.parent, Vector3d::Zero(), bone.length * bone.direction};
    if (bone.parent >= 0) joint.offset = clip.joints[static_cast<std::size_t>(bone.parent)].tip;
    clip.joints.push_back(std::move(joint));
  }
  clip.frames = AmcReader(amc, asf, skeleton).Read();
  return clip;
}

}  // namespace vitruvia
