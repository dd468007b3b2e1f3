#include "importers/eval_import.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "config/json_settings.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/progress.h"
#include "importers/checked_sequence.h"
#include "importers/eval_file.h"
#include "importers/pixel_fit.h"
#include "sequence/joint_visibility.h"
#include "sequence/sequence.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// Columns and rows are whole numbers and points have seven digits: more than this is another camera
// model, or another order of the points.
constexpr double kLargestResidual_px = 0.1;

// How far a joint is from a marker.
struct MarkerDistance {
  double sum_m = 0.0;
  int count = 0;
  double Mean() const { return sum_m / count; }
};

// All that has to be known of the whole recording before its first frame can be written.
struct Survey {
  PixelFit columns, rows;
  std::map<int, std::map<std::string, MarkerDistance>> markers_of;  // by id of the joint
  int frames = 0, jumps = 0;
  std::optional<int> last_number;

  void Add(const EvalFrame& frame) {
    for (int i = 0; i < kEvalWidth * kEvalHeight; ++i) {
      const Vector3d p = frame.points[static_cast<std::size_t>(i)].cast<double>();
      if (p.z() == 0.0) continue;
      const int column = i % kEvalWidth, row = i / kEvalWidth;
      columns.Add(p.x() / p.z(), column);
      rows.Add(p.y() / p.z(), row);
    }
    for (const auto& [id, joint] : frame.joints) {
      auto& distances = markers_of[id];
      for (const auto& [name, marker] : frame.markers) {
        distances[name].sum_m += (joint - marker).norm();
        ++distances[name].count;
      }
    }
    if (last_number && frame.number != *last_number + 1) ++jumps;
    last_number = frame.number;
    ++frames;
  }
};

void FitCamera(const Survey& survey, const std::string& where, EvalImport& result) {
  const PixelFit &u = survey.columns, &v = survey.rows;
  if (!u.is_determined() || !v.is_determined()) {
    throw DataError(fmt::format(
        "{}: expected points that differ in x/z and y/z to fit the camera to, got {} points", where,
        u.count()));
  }
  result.camera = {kEvalWidth, kEvalHeight, u.focal(), v.focal(), u.center(), v.center()};
  result.points = u.count();
  result.camera_residual_px = std::sqrt((u.SquaredResiduals() + v.SquaredResiduals()) /
                                        (2.0 * static_cast<double>(u.count())));
  const bool is_pinhole = u.focal() > 0.0 && v.focal() > 0.0;
  if (!is_pinhole || result.camera_residual_px > kLargestResidual_px) {
    throw DataError(fmt::format(
        "{}: expected points on the rays of a pinhole camera within {} px, got a residual of "
        "{:.3g} px with fx {:.6g}, fy {:.6g}",
        where, kLargestResidual_px, result.camera_residual_px, u.focal(), v.focal()));
  }
}

// "Left Elbow" and "left-elbow" are left_elbow.
std::string PlainName(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    plain += std::isalnum(letter) != 0 ? static_cast<char>(std::tolower(letter)) : '_';
  }
  return plain;
}

constexpr const char* kUnnamedJoint = "joint_";  // and its id

// The name of each joint's nearest marker, if that is near enough and nearer to no other joint.
std::map<int, std::string> NearestMarkers(const Survey& survey, double within_m) {
  struct Claim {
    int joint = 0;
    double distance_m = 0.0;
  };
  std::map<std::string, Claim> claims;
  for (const auto& [id, distances] : survey.markers_of) {
    const auto nearest = std::min_element(
        distances.begin(), distances.end(),
        [](const auto& a, const auto& b) { return a.second.Mean() < b.second.Mean(); });
    if (nearest == distances.end() || nearest->second.Mean() > within_m) continue;
    const std::string name = PlainName(nearest->first);
    if (name.starts_with(kUnnamedJoint)) continue;
    const Claim claim{id, nearest->second.Mean()};
    const auto [other, is_first] = claims.emplace(name, claim);
    if (!is_first && claim.distance_m < other->second.distance_m) other->second = claim;
  }
  std::map<int, std::string> names;
  for (const auto& [name, claim] : claims) names[claim.joint] = name;
  return names;
}

// Ids in their order, with names.
std::map<int, std::string> NameJoints(const Survey& survey, const EvalImportSettings& settings) {
  const std::map<int, std::string> markers = NearestMarkers(survey, settings.marker_within_m);
  std::set<std::string> taken;
  for (const EvalJointName& told : settings.joints) taken.insert(told.name);
  std::map<int, std::string> names;
  for (const auto& [id, distances] : survey.markers_of) {
    const auto told =
        std::find_if(settings.joints.begin(), settings.joints.end(),
                     [id = id](const EvalJointName& joint) { return joint.id == id; });
    const auto marker = markers.find(id);
    if (told != settings.joints.end()) {
      names[id] = told->name;
    } else if (marker != markers.end() && !taken.contains(marker->second)) {
      names[id] = marker->second;
    } else {
      names[id] = fmt::format("{}{}", kUnnamedJoint, id);
    }
  }
  return names;
}

void RequireNamedJointsThere(const Survey& survey, const EvalImportSettings& settings,
                             const std::string& where) {
  for (const EvalJointName& told : settings.joints) {
    if (survey.markers_of.contains(told.id)) continue;
    std::vector<int> ids;
    for (const auto& [id, distances] : survey.markers_of) ids.push_back(id);
    throw DataError(fmt::format("{}: joint {} (\"{}\") is seen in no frame; seen are: {}", where,
                                told.id, told.name, fmt::join(ids, ", ")));
  }
}

// Depth of what lies near the person's joints and markers, or of everything.
DepthImage DepthOf(const EvalFrame& frame, double person_within_m) {
  std::vector<Vector3d> anchors;
  for (const auto& [id, place] : frame.joints) anchors.push_back(place);
  for (const auto& [name, place] : frame.markers) anchors.push_back(place);
  const auto belongs = [&](const Vector3f& p) {
    return person_within_m == 0.0 ||
           std::any_of(anchors.begin(), anchors.end(), [&](const Vector3d& anchor) {
             return (p.cast<double>() - anchor).norm() <= person_within_m;
           });
  };
  DepthImage depth(kEvalWidth, kEvalHeight);
  for (std::size_t i = 0; i < frame.points.size(); ++i) {
    const Vector3f& p = frame.points[i];
    if (p.z() > 0.0f && belongs(p)) depth.pixels()[i] = p.z();
  }
  return depth;
}

JointTruth JointsOf(const EvalFrame& frame, const std::map<int, std::string>& names,
                    const DepthImage& depth, const PinholeCamera& camera) {
  JointTruth truth;
  for (const auto& [id, name] : names) {
    const auto joint = frame.joints.find(id);
    const bool is_known = joint != frame.joints.end();
    truth.known.push_back(is_known);
    truth.positions.push_back(is_known ? joint->second : Vector3d::Zero());
    truth.visible.push_back(
        is_known && SeesJoint(joint->second, JointBelowSkin(FindJoint(name)), depth, camera));
  }
  return truth;
}

SequenceInfo InfoOf(const EvalImport& imported, const std::vector<fs::path>& files,
                    const EvalImportSettings& settings, int frames) {
  SequenceInfo info;
  info.camera = imported.camera;
  info.depth_unit_m = settings.depth_unit_m;
  info.fps = settings.fps;
  info.frames = frames;
  info.joints = imported.joints;
  info.surface = false;
  info.subject = !settings.subject.empty();
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.filename().string());
  info.provenance = {{"made_by", "vitruvia import"},
                     {"format", "Stanford EVAL"},
                     {"files", names},
                     {"import", WriteSettings(settings)},
                     {"camera_residual_px", imported.camera_residual_px},
                     {"jumps_of_frame_numbers", imported.jumps},
                     {"joints_only_in_file", imported.unmatched.only_in_sequence},
                     {"joints_only_in_skeleton", imported.unmatched.only_in_skeleton},
                     {"build", Provenance()}};
  return info;
}

std::string JumpWarning(int jumps, int frames, const std::string& where) {
  if (jumps == 0) return "";
  return fmt::format(
      "{}: {} of {} frames do not have the number after their predecessor's: frames on both sides "
      "are taken as neighbours in time",
      where, jumps, frames);
}

}  // namespace

void EvalJointName::Describe(Fields& f) {
  f.Integer("id", id, {.meaning = "the joint's number in the file", .required = true});
  f.Text("name", name,
         {.meaning = "name of the joint; only the skeleton's joints (FORMAT.md) are scored",
          .required = true});
}

std::string EvalJointName::Problem() const {
  return PlainName(name) == name && !name.empty()
             ? ""
             : fmt::format("name \"{}\": expected small letters, digits and _", name);
}

void EvalImportSettings::Describe(Fields& f) {
  f.List("joints", joints,
         {.meaning = "names of the file's joints that their nearest markers do not determine"});
  f.Number("marker_within_m", marker_within_m,
           {.meaning = "a joint takes the name of its nearest marker up to this distance, on "
                       "average over all frames",
            .unit = "m",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.File(
      "subject", subject,
      {.meaning = "folder of the person's template: mesh.ply, subject.json, weights.bin; without "
                  "it the sequence has no subject, and an experiment has to name one"});
  f.Number("person_within_m", person_within_m,
           {.meaning = "points farther than this from all joints and markers are background and "
                       "dropped (this uses the truth); 0: all points are kept",
            .unit = "m",
            .min = 0.0,
            .max = 10.0});
  f.Number("depth_unit_m", depth_unit_m,
           {.meaning = "step of the stored depth", .unit = "m", .min = 1e-6, .max = 0.1});
  f.Number("fps", fps, {.meaning = "frames per second", .min = 1e-3, .max = 1e4});
}

std::string EvalImportSettings::Problem() const {
  std::set<int> ids;
  std::set<std::string> names;
  for (const EvalJointName& joint : joints) {
    if (!ids.insert(joint.id).second) return fmt::format("joints: id {} stands twice", joint.id);
    if (!names.insert(joint.name).second)
      return fmt::format("joints: the name \"{}\" stands twice", joint.name);
  }
  return "";
}

EvalImport ImportEvalSequence(const std::vector<fs::path>& files,
                              const EvalImportSettings& settings, const fs::path& folder) {
  std::optional<BodyModel> subject;
  if (!settings.subject.empty()) subject = ReadBodyModel(settings.subject);
  std::vector<EvalFile> parts(files.begin(), files.end());
  const std::string where = files.front().string();
  Survey survey;
  for (const EvalFile& part : parts) {
    for (int i = 0; i < part.frames(); ++i) survey.Add(part.ReadFrame(i));
  }
  EvalImport result;
  FitCamera(survey, where, result);
  RequireNamedJointsThere(survey, settings, where);
  const std::map<int, std::string> names = NameJoints(survey, settings);
  for (const auto& [id, name] : names) result.joints.push_back(name);
  result.unmatched = FindUnmatchedJoints(result.joints);
  result.jumps = survey.jumps;

  SequenceWriter writer(folder, InfoOf(result, files, settings, survey.frames), subject);
  Progress progress("import " + folder.filename().string(), survey.frames);
  for (const EvalFile& part : parts) {
    for (int i = 0; i < part.frames(); ++i) {
      const EvalFrame frame = part.ReadFrame(i);
      const DepthImage depth = DepthOf(frame, settings.person_within_m);
      writer.Append(depth, JointsOf(frame, names, depth, result.camera));
      progress.Advance();
    }
  }
  PublishChecked(writer, folder, {JumpWarning(result.jumps, survey.frames, where)});
  return result;
}

}  // namespace vitruvia
