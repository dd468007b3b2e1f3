// Every setting of Realtime SCAPE does something, and the paper's preset leaves nothing to defaults
// that are not the paper's.
#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "config/settings_schema.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "methods/realtime_scape/realtime_scape.h"
#include "methods/registry.h"
#include "support/arm_stage.h"

namespace vitruvia::realtime_scape {
namespace {

Json At(const std::string& dotted_key, const Json& value) {
  Json json;
  std::string pointer = "/" + dotted_key;
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  json[Json::json_pointer(pointer)] = value;
  return json;
}

std::vector<FieldDescription> Leaves() {
  std::vector<FieldDescription> leaves;
  for (const FieldDescription& field : DescribeSettings("", VisitDefaults<Settings>)) {
    if (field.type != "section") leaves.push_back(field);
  }
  return leaves;
}

// All that a tracker says of a few frames, but for its times.
struct Trace {
  std::vector<TrackResult> results;

  bool operator==(const Trace& other) const {
    return std::equal(results.begin(), results.end(), other.results.begin(), other.results.end(),
                      [](const TrackResult& a, const TrackResult& b) {
                        return a.vertices == b.vertices && a.outcome == b.outcome &&
                               a.iterations == b.iterations && a.energy_rise == b.energy_rise;
                      });
  }
};

const Rigidd kFront{Vector3d(1, -1, -1).asDiagonal(), {0.05, 0.9, 2.8}};

Trace Track(const Json& changes, const std::vector<DepthFrame>& (*frames)()) {
  static const ArmStage stage(1, SkinLinear, kFront);
  RealtimeScape tracker{ReadSettings<Settings>(changes, {"test", ""})};
  tracker.Start(stage.body, stage.camera);
  Trace trace;
  for (const DepthFrame& frame : frames()) trace.results.push_back(tracker.TrackFrame(frame));
  return trace;
}

// An arm swings down. For three frames its lower part is not measured, and it jumps meanwhile.
const std::vector<DepthFrame>& MovingArm() {
  static const std::vector<DepthFrame> frames = [] {
    ArmStage stage(1, SkinLinear, kFront);
    std::vector<DepthFrame> list;
    for (int i = 0; i < 8; ++i) {
      list.push_back(stage.Frame(i, i < 3 ? 0.1 * i : 0.1 * i + 0.6));
      if (i < 3 || i > 5) continue;
      DepthImage& depth = list.back().depth;
      for (int v = 0; v < depth.height(); ++v) {
        for (int u = 215; u < depth.width(); ++u) depth(u, v) = 0.0f;
      }
    }
    return list;
  }();
  return frames;
}

// A body bends its arms and stretches them again. Then three frames show a small square only, and
// the body is back elsewhere, turned by 100 degrees, with its arms bent.
const std::vector<DepthFrame>& ReturningBody() {
  static const std::vector<DepthFrame> frames = [] {
    const Rigidd after = Rigidd{Matrix3<double>::Identity(), {0.5, 0.0, 0.4}} * kFront *
                         Rigidd{ExpSo3<double>({0.0, 1.75, 0.0}), Vector3d::Zero()};
    ArmStage first(1, SkinLinear, kFront), second(1, SkinLinear, after);
    std::vector<DepthFrame> list;
    for (const double angle : {0.0, 0.2, 0.4, 0.6, 0.8, 0.6, 0.4, 0.2}) {
      list.push_back(first.Frame(static_cast<int>(list.size()), angle));
    }
    for (int i = 8; i < 11; ++i) {
      list.push_back({i, i / 30.0, DepthImage(first.camera.width, first.camera.height)});
      for (int v = 40; v < 52; ++v) {
        for (int u = 40; u < 52; ++u) list.back().depth(u, v) = 2.0f;
      }
    }
    for (int i = 11; i < 16; ++i) list.push_back(second.Frame(i, 0.8));
    return list;
  }();
  return frames;
}

struct Change {
  Json value;              // instead of the default
  Json context = Json{};   // other settings, with the change and without
  bool returning = false;  // on frames in which the body is lost
};

// One change for each setting. It has to change the result.
const std::map<std::string, Change>& Changes() {
  const Json cg = At("solver.kind", "cg");
  const Json free = At("free_space_weight", 1.0);
  const Json search = At("start", "search");
  const Json watch = At("watch.lost_above", 0.01);
  const Json unturned = At("facing.margin_m", 0.0);  // the body is turned when it comes back
  static const std::map<std::string, Change> changes = {
      {"cloud.stride", {3}},
      {"cloud.max_depth_m", {2.8}},
      {"cloud.least_neighbors", {6}},
      {"cloud.neighbor_within_m", {0.01, At("cloud.least_neighbors", 6)}},
      {"fit.surface_residual", {"depth"}},
      {"fit.pair_residual", {"plane"}},
      {"fit.visibility_iterations", {1}},
      {"fit.visible_within_m", {0.01}},
      {"fit.near_surface_m", {0.02}},
      {"fit.edge_px", {0}},
      {"fit.behind_surface", {"elsewhere"}},
      {"fit.smooth_m", {0.0}},
      {"fit.window_px", {1, At("fit.association", "window")}},
      {"fit.pair_cutoff_m", {0.02}},
      {"fit.surface_weight", {0.5}},
      {"fit.pair_weight", {0.5}},
      {"fit.surface_stride", {2}},
      {"fit.average_px", {1}},
      {"fit.pixel_sharing", {1}},
      {"fit.kernel", {"tukey"}},
      {"fit.kernel_scale_m", {0.002}},
      {"fit.noise.axial_base_m", {0.01}},
      {"fit.noise.axial_growth_per_m", {0.01}},
      {"fit.noise.axial_near_m", {1.0, At("fit.noise.axial_growth_per_m", 0.01)}},
      {"fit.noise.lateral_rad", {0.01}},
      {"fit.noise.model_deviation_m", {0.02, At("fit.noise.axial_base_m", 0.01)}},
      {"fit.free_space.margin_px", {64, free}},
      {"fit.free_space.reach_m", {0.02, free}},
      {"search.candidates", {"visible"}},
      {"search.seen_share", {0.3}},
      {"search.well_explained_share", {0.3}},
      {"search.owned_m", {0.3}},
      {"search.growth_m", {0.0}},
      {"search.reach_m", {0.0}},
      {"motion.model", {"constant_rotation"}},
      {"motion.velocity_share", {0.3}},
      {"motion.hidden_decay", {0.1}},
      {"joint_rows", {"mean_point"}},
      {"joint_weight", {1.0}},
      {"inertia_weight", {1.0}},
      {"axis_weight", {10.0}},
      {"free_space_weight", {1.0}},
      {"limit_slack_deg", {0.0, At("limit_weight", 10.0)}},
      {"prior_weight", {0.1}},
      {"length_unit_m", {0.1}},
      {"rotation_update", {"linear_orthonormal"}},
      {"stopping.rotation_step_deg", {0.01}},
      {"stopping.translation_step_m", {1e-5}},
      {"stopping.energy_decrease", {0.5}},
      {"stopping.max_iterations", {1}},
      {"stopping.first_frame_iterations", {1}},
      {"solver.kind", {"cg"}},
      {"solver.relative_tolerance", {0.1, cg}},
      {"solver.max_iterations", {5, cg}},
      {"solver.precision", {"float"}},
      {"solver.damping", {10.0}},
      {"solver.watch_energy", {true}},
      {"start", {"search"}},
      {"start_search.coarse_vertices", {100, search}},
      {"start_search.fine_vertices", {300, search}},
      {"start_search.angle_deviation_deg", {10.0, search}},
      {"placement.iterations", {0}},
      {"placement.trim", {0.5}},
      {"placement.initial_offset_m", {{0.1, 0.0, 0.0}}},
      {"placement.initial_rotation_deg", {20.0}},
      {"facing.margin_m", {0.0, {}, true}},
      {"facing.least_decrease", {1.0, {}, true}},
      {"recovery.doubt_threshold", {0.999, unturned, true}},
      {"recovery.patience", {1, unturned, true}},
      {"recovery.pause", {1, unturned, true}},
      {"recovery.agreement_threshold", {0.1, unturned, true}},
      {"recovery.num_refined", {1, unturned, true}},
      {"recovery.margin", {1.0, unturned, true}},
      {"recovery.num_remembered",
       {1, Merged(unturned, At("recovery.min_pose_distance_deg", 2.0)), true}},
      {"recovery.min_pose_distance_deg", {2.0, unturned, true}},
      {"watch.lost_above", {1e-6}},
      {"watch.found_below", {0.5, watch}},
      {"watch.reach_m", {0.01, watch}},
      {"lost_below", {1.0}},
      {"least_points", {100000}},
  };
  return changes;
}

// Settings that must not change the result, with the reason.
const std::map<std::string, std::string>& WithoutEffect() {
  static const std::map<std::string, std::string> reasons = {
      {"fit.rasterizer", "both render the same depth of a closed mesh"},
      {"start_search.headings", "the body looks along a heading that every number of them has"},
      {"start_search.near_m", "the poses keep their order, and the best one is trusted"},
      {"start_search.far_m", "the poses keep their order, and the best one is trusted"},
      {"start_search.near_growth_per_m", "the poses keep their order, and the best one is trusted"},
      {"start_search.least_explained", "decides only whether the pose is trusted, and this one is"},
      {"fit.association", "a kd-tree and a search over all points find the same nearest point"},
      {"limit_weight", "no joint exceeds its range by more than the slack"},
      {"limbs.min_unexplained_m2", "the arm stays within reach of the pairs: limb_finder_test"},
      {"limbs.margin", "no limb is searched"},
      {"limbs.num_targets", "no limb is searched"},
      {"limbs.num_swivels", "no limb is searched"},
      {"limbs.num_refined", "no limb is searched"},
      {"facing.pause", "the other facing is found at once: facing_test"},
      {"recovery.least_usual", "the body agrees fully before it is lost: loss_detector_test"},
      {"recovery.part_gap_m", "the frames show one thing at a time"},
      {"uncertainty.inflation", "says how far joints may be off, and moves none"},
      {"uncertainty.sensor.axial_base_m", "moves no joint: joint_uncertainty_test"},
      {"uncertainty.sensor.axial_growth_per_m", "moves no joint: joint_uncertainty_test"},
      {"uncertainty.sensor.axial_near_m", "moves no joint: joint_uncertainty_test"},
      {"uncertainty.sensor.lateral_rad", "moves no joint: joint_uncertainty_test"},
      {"uncertainty.unconfirmed_inflation", "moves no joint: joint_uncertainty_test"},
      {"uncertainty.bend_deviation_m", "moves no joint: joint_uncertainty_test"},
      {"uncertainty.disagreement_deviation_m", "moves no joint: joint_uncertainty_test"},
      {"uncertainty.lost_deviation_m", "moves no joint: joint_uncertainty_test"},
      {"uncertainty.model_deviation_m", "moves no joint: joint_uncertainty_test"},
      {"uncertainty.unreliable_above_m", "moves no joint: joint_uncertainty_test"},
      {"watch.found_frames", "the arm is not found again before the last frame: body_areas_test"},
      {"watch.other_body_share", "no other body is there: body_areas_test"},
      {"watch.search_pause", "no other body is there: body_areas_test"},
      {"watch.margin", "no other body is there: recovery_test"}};
  return reasons;
}

TEST(RealtimeScapeSettings, EverySettingChangesTheResultOrSaysWhyNot) {
  std::map<std::string, Trace> unchanged;  // by context and frames
  for (const FieldDescription& field : Leaves()) {
    SCOPED_TRACE(field.key);
    if (WithoutEffect().contains(field.key)) continue;
    const auto found = Changes().find(field.key);
    if (found == Changes().end()) {
      ADD_FAILURE() << "a setting without a change that shows what it does";
      continue;
    }
    const Change& change = found->second;
    const auto frames = change.returning ? ReturningBody : MovingArm;
    const Json context = change.context.is_null() ? Json::object() : change.context;
    const std::string name = context.dump() + (change.returning ? " returning" : "");
    if (!unchanged.contains(name)) unchanged[name] = Track(context, frames);
    const Json changed = Merged(context, At(field.key, change.value));
    EXPECT_FALSE(unchanged.at(name) == Track(changed, frames));
  }
}

TEST(RealtimeScapeSettings, WhatMustNotChangeTheResultDoesNot) {
  const Trace moving = Track(Json::object(), MovingArm);
  EXPECT_TRUE(moving == Track(At("fit.rasterizer", "all_triangles"), MovingArm));
  EXPECT_TRUE(moving == Track(At("fit.association", "kd_tree"), MovingArm));
}

// The preset of the paper would otherwise change with a default of ours. Inputs, which are off by
// default, are the user's. What applies only beside another choice than the default is left out, so
// that a variant of the preset can make that choice otherwise.
TEST(RealtimeScapeSettings, ThePapersPresetNamesEveryDefaultThatIsNotThePapers) {
  const auto file =
      std::filesystem::path(VITRUVIA_SOURCE_DIR) / "configs/methods/realtime_scape_paper.json";
  const Json preset = ReadJsonFile(file).at("settings");
  const Json resolved = WriteSettings(ReadSettings<Settings>(preset, {file, "settings"}));
  const Json defaults = WriteSettings(Settings{});
  for (const FieldDescription& field : Leaves()) {
    if (field.origin == "paper" || field.origin == "input") continue;
    std::string pointer = "/" + field.key;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    const Json::json_pointer key(pointer);
    if (!resolved.contains(key) || !defaults.contains(key)) continue;
    EXPECT_TRUE(preset.contains(key))
        << field.key << " (" << field.origin << ", default " << field.default_value << ")";
  }
}

}  // namespace
}  // namespace vitruvia::realtime_scape
