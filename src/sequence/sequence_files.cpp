#include "sequence/sequence_files.h"

#include <set>

#include "core/error.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr int kMostFrames = 1000000;  // six digits in the names of frames

// The header as it stands in the file. Everything that a reader relies on is required: a default
// silently taken for a camera that was never stated would spoil every number that follows.
struct SequenceHeader {
  std::string format;
  int version = 0;
  SequenceInfo info;

  void Describe(Fields& f) {
    f.Text("format", format, {.meaning = "always \"vitruvia-sequence\"", .required = true});
    f.Integer("version", version, {.meaning = "of the format", .required = true});
    f.Section("camera", info.camera, {.meaning = "intrinsics", .required = true});
    f.Number("depth_unit_m", info.depth_unit_m,
             {.meaning = "metres that a depth value of 1 stands for",
              .unit = "m",
              .min = 1e-9,
              .max = 1.0,
              .required = true});
    f.Number("fps", info.fps,
             {.meaning = "frames per second", .min = 1e-3, .max = 1e5, .required = true});
    f.Integer("frames", info.frames,
              {.meaning = "number of frames", .min = 1, .max = kMostFrames, .required = true});
    f.Texts("joints", info.joints,
            {.meaning = "names, in the order of truth/joints.json; none: there is no such file",
             .required = true});
    f.Flag("surface", info.surface,
           {.meaning = "whether there is a true surface: truth/mesh.ply and truth/vertices.bin"});
    f.Flag("subject", info.subject, {.meaning = "whether there is a subject/"});
    f.FreeJson("provenance", info.provenance, {.meaning = "how the sequence was made"});
  }

  std::string Problem() const {
    if (format != kSequenceFormat) {
      return fmt::format("format is \"{}\", expected \"{}\"", format, kSequenceFormat);
    }
    if (version != kSequenceVersion) {
      return fmt::format("version is {}, expected {}", version, kSequenceVersion);
    }
    return SequenceInfoProblem(info);
  }
};

// The first key of `complete` that `json` lacks, as a dotted path; "" if there is none. A section
// that is required still lets its own keys fall back to defaults; a file of data must not.
std::string MissingKey(const Json& json, const Json& complete) {
  for (const auto& [key, value] : complete.items()) {
    const auto found = json.find(key);
    if (found == json.end()) return key;
    if (!value.is_object()) continue;
    if (const std::string missing = MissingKey(*found, value); !missing.empty()) {
      return key + "." + missing;
    }
  }
  return "";
}

[[noreturn]] void Damaged(const fs::path& file, const std::string& problem) {
  throw DataError(fmt::format("{}: {}", file.string(), problem));
}

// A JSON file of data; what would be a wrong config is damaged data here.
Json ReadDataJson(const fs::path& file) {
  try {
    return ReadJsonFile(file);
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  }
}

// The member `key` of an object, checked to be a list of that many items.
const Json& List(const Json& object, const std::string& key, std::size_t count,
                 const std::string& where, const fs::path& file) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end()) {
    Damaged(file, fmt::format("{}{}: missing", where, key));
  }
  if (!found->is_array()) Damaged(file, fmt::format("{}{}: expected a list", where, key));
  if (found->size() != count) {
    Damaged(file, fmt::format("{}{}: expected {} items, got {}", where, key, count, found->size()));
  }
  return *found;
}

JointTruth ParsedJoints(const Json& json, const SequenceInfo& info, const std::string& where,
                        const fs::path& file) {
  const std::size_t count = info.joints.size();
  const Json& positions = List(json, "positions", count, where, file);
  const Json& visible = List(json, "visible", count, where, file);
  JointTruth joints;
  for (std::size_t j = 0; j < count; ++j) {
    const Json& p = positions[j];
    const bool is_point =
        p.is_array() && p.size() == 3 && p[0].is_number() && p[1].is_number() && p[2].is_number();
    const bool is_unknown = p.is_null() && visible[j] == false;
    if (!(is_point || is_unknown) || !visible[j].is_boolean()) {
      Damaged(file, fmt::format("{}joint \"{}\": expected three numbers and a visible flag of true "
                                "or false, or null and false, got {} and {}",
                                where, info.joints[j], p.dump(), visible[j].dump()));
    }
    if (is_unknown) {
      joints.positions.emplace_back(Vector3<double>::Zero());
    } else {
      joints.positions.emplace_back(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    }
    joints.visible.push_back(visible[j].get<bool>());
    joints.known.push_back(is_point);
  }
  return joints;
}

}  // namespace

std::string SequenceFiles::FrameName(int frame) { return fmt::format("{:06}.png", frame); }

std::string SequenceInfoProblem(const SequenceInfo& info) {
  if (info.camera.width < 1 || info.camera.height < 1) {
    return fmt::format("camera: an image of {}×{} pixels is empty", info.camera.width,
                       info.camera.height);
  }
  if (info.frames < 1) return "frames: the sequence is empty";
  if (!(info.depth_unit_m > 0.0) || !(info.fps > 0.0)) {
    return fmt::format("depth_unit_m is {} and fps {}, expected both above 0", info.depth_unit_m,
                       info.fps);
  }
  std::set<std::string> names;
  for (const std::string& name : info.joints) {
    if (name.empty()) return "joints: a name is empty";
    if (!names.insert(name).second) return fmt::format("joints: \"{}\" stands twice", name);
  }
  return "";
}

SequenceInfo ReadSequenceInfo(const fs::path& file) {
  const Json json = ReadDataJson(file);
  SequenceHeader header;
  try {
    header = ReadSettings<SequenceHeader>(json, {file, ""});
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  }
  Json complete = WriteSettings(header);
  for (const char* optional : {"surface", "subject", "provenance"}) complete.erase(optional);
  if (const std::string missing = MissingKey(json, complete); !missing.empty()) {
    Damaged(file, fmt::format("{}: missing", missing));
  }
  return header.info;
}

Json SequenceInfoJson(const SequenceInfo& info) {
  Json json = WriteSettings(SequenceHeader{kSequenceFormat, kSequenceVersion, info});
  // That something is there goes without saying: complete sequences keep their hash.
  if (info.surface) json.erase("surface");
  if (info.subject) json.erase("subject");
  return json;
}

std::string JointTruthProblem(const JointTruth& joints, std::size_t joint_count) {
  if (joints.positions.size() != joint_count || joints.visible.size() != joint_count) {
    return fmt::format("expected {} joints, got {} positions and {} visible flags", joint_count,
                       joints.positions.size(), joints.visible.size());
  }
  if (!joints.known.empty() && joints.known.size() != joint_count) {
    return fmt::format("expected {} joints, got {} known flags", joint_count, joints.known.size());
  }
  for (std::size_t j = 0; j < joint_count; ++j) {
    if (!joints.Knows(j) && joints.visible[j])
      return fmt::format("joint {} is visible and not known", j);
    if (joints.Knows(j) && !joints.positions[j].allFinite())
      return fmt::format("joint {} is not finite", j);
  }
  return "";
}

std::vector<JointTruth> ReadJointTruth(const fs::path& file, const SequenceInfo& info) {
  const Json json = ReadDataJson(file);
  const Json& names = List(json, "joints", info.joints.size(), "", file);
  for (std::size_t j = 0; j < info.joints.size(); ++j) {
    if (names[j] != info.joints[j]) {
      Damaged(file, fmt::format("joints[{}]: expected \"{}\" as in sequence.json, got {}", j,
                                info.joints[j], names[j].dump()));
    }
  }
  const Json& frames = List(json, "frames", static_cast<std::size_t>(info.frames), "", file);
  std::vector<JointTruth> truth;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    truth.push_back(ParsedJoints(frames[i], info, fmt::format("frames[{}].", i), file));
  }
  return truth;
}

Json JointTruthJson(const std::vector<std::string>& names, const std::vector<JointTruth>& frames) {
  Json json = {{"joints", names}, {"frames", Json::array()}};
  for (const JointTruth& joints : frames) {
    Json positions = Json::array();
    for (std::size_t j = 0; j < joints.positions.size(); ++j) {
      const Vector3<double>& p = joints.positions[j];
      positions.push_back(joints.Knows(j) ? Json({p.x(), p.y(), p.z()}) : Json(nullptr));
    }
    json["frames"].push_back({{"positions", positions}, {"visible", joints.visible}});
  }
  return json;
}

}  // namespace vitruvia
