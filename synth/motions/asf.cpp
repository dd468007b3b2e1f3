#include "synth/motions/asf.h"

#include <algorithm>
#include <set>

#include "config/did_you_mean.h"
#include "core/error.h"

namespace vitruvia {
namespace {

using Word = MocapWords::Word;
using Vector3d = Vector3<double>;
using Eigen::Quaterniond;

constexpr const char* kRoot = "root";

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

// The keys of a section or bone: each known and at most once.
class Keys {
 public:
  Keys(const MocapWords& words, std::string section, std::vector<std::string> known)
      : words_(words), section_(std::move(section)), known_(std::move(known)) {}

  // The key in lower case.
  std::string Next(const Word& word) {
    std::string key = LowerCase(word.text);
    if (std::ranges::find(known_, key) == known_.end()) {
      FailUnknown(words_, word, "key of " + section_, known_);
    }
    if (!seen_.insert(key).second) {
      words_.Fail(word.line, fmt::format("{} has a second {}", section_, key));
    }
    return key;
  }
  bool Has(const std::string& key) const { return seen_.contains(key); }

 private:
  const MocapWords& words_;
  std::string section_;
  std::vector<std::string> known_;
  std::set<std::string> seen_;
};

class AsfReader {
 public:
  explicit AsfReader(const std::filesystem::path& file) : words_(file) {}

  AsfSkeleton Read() {
    skeleton_.bones.emplace_back().name = kRoot;
    Keys sections(words_, "the file",
                  {":version", ":name", ":units", ":documentation", ":root", ":bonedata",
                   ":hierarchy", ":skin"});
    while (!words_.AtEnd()) {
      const std::vector<Word> line = words_.TakeLine();
      const std::string section = sections.Next(line[0]);
      if (section == ":units") {
        ReadUnits();
      } else if (section == ":root") {
        ReadRoot();
      } else if (section == ":bonedata") {
        ReadBones();
      } else if (section == ":hierarchy") {
        ReadHierarchy();
      } else {
        SkipSection();
      }
    }
    if (skeleton_.bones.size() < 2) words_.Fail(words_.line(), "no bones (section :bonedata)");
    if (!knows_angle_unit_) {
      skeleton_.warnings.push_back(
          words_.At(words_.line(),
                    "the file does not say the unit of its angles (:units, angle deg or "
                    "rad); degrees are assumed"));
    }
    return ParentsFirst();
  }

 private:
  bool InSection() const { return !words_.AtEnd() && !words_.Peek().text.starts_with(':'); }

  void SkipSection() {
    while (InSection()) words_.TakeLine();
  }

  void ReadUnits() {
    Keys keys(words_, ":units", {"mass", "length", "angle"});
    while (InSection()) {
      const std::vector<Word> line = words_.TakeLine();
      if (keys.Next(line[0]) != "angle") continue;
      const std::string unit = line.size() == 2 ? LowerCase(line[1].text) : "";
      const bool degrees = unit == "deg" || unit == "degrees";
      if (!degrees && unit != "rad" && unit != "radians") {
        words_.Fail(line[0].line, "angle: expected deg or rad");
      }
      skeleton_.radians_per_unit = degrees ? kRadiansPerDegree : 1.0;
      knows_angle_unit_ = true;
    }
  }

  void ReadRoot() {
    AsfBone& root = skeleton_.bones[0];
    Keys keys(words_, ":root", {"order", "axis", "position", "orientation"});
    std::vector<Word> axis_order, orientation;
    while (InSection()) {
      const std::vector<Word> line = words_.TakeLine();
      root.line = line[0].line;
      const std::string key = keys.Next(line[0]);
      if (key == "order") root.channels = Channels(line);
      if (key == "axis") axis_order = line;
      if (key == "position") Numbers(line);
      if (key == "orientation") orientation = line;
    }
    if (root.channels.empty()) words_.Fail(root.line, ":root has no order");
    if (orientation.empty()) return;
    if (axis_order.size() != 2) words_.Fail(root.line, ":root has an orientation but no axis");
    orientation.push_back(axis_order[1]);
    root.axes = Axes(orientation);
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
    Keys keys(
        words_, "a bone",
        {"id", "name", "direction", "length", "axis", "dof", "limits", "bodymass", "cofmass"});
    while (true) {
      if (!InSection()) words_.Fail(words_.line(), "a bone's end is missing");
      const std::vector<Word> line = words_.TakeLine();
      if (SameWord(line[0].text, "end")) break;
      if (line[0].text.starts_with('(') && keys.Has("limits")) continue;
      const std::string key = keys.Next(line[0]);
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
    for (const char* required : {"direction", "length", "axis"}) {
      if (!keys.Has(required)) {
        words_.Fail(bone.line, fmt::format("bone {} has no {}", bone.name, required));
      }
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
      if (SameWord(line[0].text, "end")) return;
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

  // "key a b c".
  Vector3d Numbers(const std::vector<Word>& line) const {
    if (line.size() != 4) {
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
    if (line.size() != 5) words_.Fail(line[0].line, "expected three angles and their order");
    const Vector3d angles = Numbers({line.begin(), line.begin() + 4});
    Quaterniond axes = Quaterniond::Identity();
    const std::string order = LowerCase(line[4].text);
    for (std::size_t i = 0; i < std::min<std::size_t>(order.size(), 3); ++i) {
      const std::size_t axis = std::string_view("xyz").find(order[i]);
      if (axis == std::string_view::npos) break;
      axes = TurnAbout(static_cast<int>(axis),
                       skeleton_.radians_per_unit * angles[static_cast<Eigen::Index>(i)]) *
             axes;
    }
    std::string sorted(order);
    std::ranges::sort(sorted);
    if (sorted != "xyz") words_.Fail(line[0].line, "expected three angles and their order");
    return axes;
  }

  // "rx ry rz" of a bone, "TX TY TZ RX RY RZ" of the root; "l" (a bone's stretch) is not supported.
  std::vector<AsfChannel> Channels(const std::vector<Word>& line) const {
    std::vector<AsfChannel> channels;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const std::string name = LowerCase(line[i].text);
      const std::size_t axis =
          name.size() == 2 ? std::string_view("xyz").find(name[1]) : std::string_view::npos;
      if (axis == std::string_view::npos || (name[0] != 'r' && name[0] != 't')) {
        words_.Fail(line[i].line, fmt::format("unknown degree of freedom {}", line[i].text));
      }
      for (const AsfChannel& before : channels) {
        if (before.axis == static_cast<int>(axis) && before.is_rotation == (name[0] == 'r')) {
          words_.Fail(line[i].line, fmt::format("the degree of freedom {} twice", line[i].text));
        }
      }
      channels.push_back({static_cast<int>(axis), name[0] == 'r'});
    }
    return channels;
  }

  // Bones in an order where parents come first.
  AsfSkeleton ParentsFirst() const {
    AsfSkeleton ordered{{skeleton_.bones[0]}, skeleton_.radians_per_unit, skeleton_.warnings};
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
  bool knows_angle_unit_ = false;
};

}  // namespace

std::optional<int> AsfSkeleton::Find(std::string_view name) const {
  const auto found = std::ranges::find(bones, name, &AsfBone::name);
  if (found == bones.end()) return {};
  return static_cast<int>(found - bones.begin());
}

Quaterniond TurnAbout(int axis, double angle) {
  return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::Unit(axis)));
}

AsfSkeleton ReadAsf(const std::filesystem::path& file) { return AsfReader(file).Read(); }

void FailUnknown(const MocapWords& words, const MocapWords::Word& word, std::string_view what,
                 const std::vector<std::string>& known) {
  const std::string nearest = NearestWord(LowerCase(word.text), known);
  words.Fail(word.line, fmt::format("unknown {} {}{}; expected one of {}", what, word.text,
                                    nearest.empty() ? "" : fmt::format(" (is {} meant?)", nearest),
                                    fmt::join(known, ", ")));
}

}  // namespace vitruvia
