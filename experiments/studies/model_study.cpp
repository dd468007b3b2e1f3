#include "experiments/studies/model_study.h"

#include <algorithm>
#include <map>

#include "body/start_poses.h"
#include "config/build_cache.h"
#include "core/build_info.h"
#include "core/error.h"
#include "experiments/plan/experiment_config.h"
#include "experiments/studies/drawn_parts.h"
#include "methods/dynamic/kinematic_tree.h"
#include "methods/realtime_scape/terms/main_axes.h"
#include "records/surface_strips.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr double kBoneWidth_m = 0.06, kBoneBase = 0.2;  // of a drawn bone
constexpr double kAxisLength_m = 0.16, kAxisWidth_m = 0.03;
constexpr double kEnlargement = 3.5;    // of the special bone that is drawn by itself
constexpr double kEnlargedAxis = 0.45;  // length of its axis as a share of the drawing's height
constexpr BoneId kSpecialBone = BoneId::kLeftForearm;
constexpr const char* kDrawnPose = "walking, left leg in front";

ShownSurface RegionsOf(const BodyModel& body, const std::vector<Vector3f>& vertices) {
  ShownSurface regions{{vertices, body.rest.triangles}, SurfaceColor::kBone, {}};
  for (const auto& heaviest : body.weights.bones) regions.values.push_back(heaviest[0]);
  return regions;
}

ShownSurface BonesOf(const Skeleton& skeleton) {
  ShownSurface bones;
  bones.color = SurfaceColor::kBone;
  for (int b = 0; b < kBoneCount; ++b) {
    const TriangleMesh part =
        Spindle(skeleton.joints[b], skeleton.tips[b], kBoneWidth_m, kBoneBase);
    Append(part, bones.mesh);
    bones.values.insert(bones.values.end(), part.vertices.size(), static_cast<float>(b));
  }
  return bones;
}

std::vector<Vector3f> Posed(const BodyModel& body) {
  JointPose pose = JointPose::Rest(body.skeleton);
  for (const StartPose& start : StartPoses()) {
    if (std::string_view(start.name) == kDrawnPose) SetRotations(start.pose, pose);
  }
  std::vector<Vector3f> posed;
  SkinLinear(body.rest.vertices, body.weights, ForwardKinematics(body.skeleton, pose), posed);
  return posed;
}

// The triangles whose vertices belong to the bone above all.
TriangleMesh RegionOf(const BodyModel& body, BoneId bone) {
  TriangleMesh region;
  std::vector<std::int32_t> index(body.rest.vertices.size(), -1);
  for (const Triangle& triangle : body.rest.triangles) {
    const bool belongs = std::all_of(triangle.begin(), triangle.end(), [&](std::int32_t v) {
      return body.weights.bones[static_cast<std::size_t>(v)][0] == static_cast<int>(bone);
    });
    if (!belongs) continue;
    Triangle& copy = region.triangles.emplace_back(triangle);
    for (std::int32_t& v : copy) {
      std::int32_t& place = index[static_cast<std::size_t>(v)];
      if (place < 0) {
        place = static_cast<std::int32_t>(region.vertices.size());
        region.vertices.push_back(body.rest.vertices[static_cast<std::size_t>(v)]);
      }
      v = place;
    }
  }
  return region;
}

// The special bone, enlarged round the body's middle, and its axis as an arrow.
std::vector<ShownSurface> EnlargedBone(const BodyModel& body) {
  const auto& axes = realtime_scape::MainAxes();
  const auto special =
      std::find_if(axes.begin(), axes.end(),
                   [](const realtime_scape::MainAxis& axis) { return axis.bone == kSpecialBone; });
  Require(special != axes.end(), "{} has no main axis",
          Bones()[static_cast<int>(kSpecialBone)].name);
  const auto middle_of = [](const std::vector<Vector3f>& vertices) {
    return Vector3f(BoundingBox(vertices).center());
  };
  TriangleMesh region = RegionOf(body, kSpecialBone);
  const Vector3f from = middle_of(region.vertices), to = middle_of(body.rest.vertices);
  for (Vector3f& v : region.vertices) v = to + static_cast<float>(kEnlargement) * (v - from);
  const Vector3d start = to.cast<double>();
  const double length_m = kEnlargedAxis * body.attributes.height_m;
  const TriangleMesh arrow = Arrow(start, start + length_m * special->axis, 0.2 * length_m);
  const std::vector<float> bone(region.vertices.size(), static_cast<float>(kSpecialBone));
  return {{region, SurfaceColor::kBone, bone}, {arrow, SurfaceColor::kTruth, {}}};
}

std::vector<SurfaceStrip> DrawBones(const BodyModel& body) {
  const ShownSurface surface{body.rest, SurfaceColor::kEstimate, {}};
  const ShownSurface regions = RegionsOf(body, body.rest.vertices);
  return {{body.name,
           fmt::format("{} vertices, {} bones", body.rest.vertices.size(), kBoneCount),
           {{"template in the rest pose", 0.0, {surface}},
            {"regions of the bones", 0.0, {regions}},
            {"regions, from behind", 180.0, {regions}},
            {"bones", 0.0, {BonesOf(body.skeleton)}},
            {"left forearm, enlarged, and its main axis", 20.0, EnlargedBone(body)},
            {"posed by linear blend skinning", 30.0, {RegionsOf(body, Posed(body))}}}}};
}

ShownSurface AxesOf(const dynamic::KinematicTree& tree, dynamic::JointType type) {
  ShownSurface axes;
  axes.color = type == dynamic::JointType::kHinge ? SurfaceColor::kTruth : SurfaceColor::kEstimate;
  for (const dynamic::TreeJoint& joint : tree.joints()) {
    if (joint.type != type) continue;
    Append(Arrow(joint.place, joint.place + kAxisLength_m * joint.axis, kAxisWidth_m), axes.mesh);
  }
  return axes;
}

std::vector<SurfaceStrip> DrawSkeleton(const BodyModel& body, const fs::path& skeleton_file) {
  const dynamic::KinematicTree tree(dynamic::ReadSkeletonFile(skeleton_file), body.skeleton);
  const ShownSurface hinges = AxesOf(tree, dynamic::JointType::kHinge);
  const ShownSurface slides = AxesOf(tree, dynamic::JointType::kPrismatic);
  const ShownSurface surface{body.rest, SurfaceColor::kEstimate, {}};
  return {{body.name,
           fmt::format("{} joints; orange: axes of hinges, blue: of slides", tree.joint_count()),
           {{"template in the bind pose", 0.0, {surface}},
            {"regions of the links", 0.0, {RegionsOf(body, body.rest.vertices)}},
            {"hinges and slides", 25.0, {BonesOf(body.skeleton), hinges, slides}},
            {"hinges and slides, from the side", 75.0, {BonesOf(body.skeleton), hinges, slides}}}}};
}

std::string Counted(int count, const char* what) {
  return count == 0 ? "" : fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

void ModelDrawingSettings::Describe(Fields& f) {
  f.Choice(
      "model", model,
      {{"realtime_scape", DrawnModel::kRealtimeScape}, {"dynamic", DrawnModel::kDynamic}},
      {.meaning = "whose model is drawn: the 17 bones with their regions and main axes, or the "
                  "hinges and slides of a skeleton file"});
  f.Section("body", body, {.meaning = "the person"});
  f.Section("mesh", mesh, {.meaning = "how the template is made of the person's body"});
  f.File("skeleton", skeleton, {.meaning = "skeleton file of the model dynamic"});
}

std::string ModelDrawingSettings::Problem() const {
  if ((model == DrawnModel::kDynamic) == skeleton.empty())
    return "skeleton: expected a skeleton file for the model dynamic and none for another";
  return "";
}

void ModelStudySettings::Describe(Fields& f) {
  f.Text("kind", kind, {.meaning = "kind of the experiment: model_drawing", .required = true});
  f.Text("title", title, {.meaning = "title of the report", .required = true});
  f.Text("description", description,
         {.meaning = "what the experiment shows, printed at the head of the report"});
  f.Section("drawing", drawing, {.meaning = "whose model is drawn, and on which body"});
}

BoneTree TreeOfBones() {
  BoneTree tree;
  tree.title = "The tree of the 17 bones";
  const auto& axes = realtime_scape::MainAxes();
  for (int b = 0; b < kBoneCount; ++b) {
    const BoneInfo& bone = Bones()[b];
    const bool is_special = std::any_of(
        axes.begin(), axes.end(),
        [b](const realtime_scape::MainAxis& axis) { return static_cast<int>(axis.bone) == b; });
    tree.nodes.push_back(
        {std::string(bone.name), is_special ? "turns about its main axis" : "", bone.parent});
  }
  return tree;
}

BoneTree TreeOfSkeleton(const fs::path& skeleton_file) {
  const dynamic::SkeletonFile file = dynamic::ReadSkeletonFile(skeleton_file);
  BoneTree tree;
  tree.title = fmt::format("The hinges and slides of {}", file.name);
  struct Counts {
    int hinges = 0, slides = 0;
  };
  std::map<std::string, int> node_of_joint, node_of_place;
  std::vector<Counts> counts;
  // Parents may stand later in the file: joints are taken as soon as theirs is there.
  std::vector<const dynamic::JointSettings*> open;
  for (const dynamic::JointSettings& joint : file.joints) open.push_back(&joint);
  while (!open.empty()) {
    std::erase_if(open, [&](const dynamic::JointSettings* joint) {
      const bool hangs_on_world = joint->parent == dynamic::kWorld;
      if (!hangs_on_world && !node_of_joint.contains(joint->parent)) return false;
      const auto [place, is_new] =
          node_of_place.try_emplace(joint->at, static_cast<int>(tree.nodes.size()));
      if (is_new) {
        tree.nodes.push_back({joint->at, "", hangs_on_world ? -1 : node_of_joint[joint->parent]});
        counts.emplace_back();
      }
      node_of_joint[joint->name] = place->second;
      Counts& count = counts[static_cast<std::size_t>(place->second)];
      ++(joint->type == dynamic::JointType::kHinge ? count.hinges : count.slides);
      return true;
    });
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::string slides = Counted(counts[i].slides, "slide");
    const std::string hinges = Counted(counts[i].hinges, "hinge");
    tree.nodes[i].detail = slides + (slides.empty() || hinges.empty() ? "" : ", ") + hinges;
  }
  return tree;
}

Experiment PlanModelStudy(const fs::path& file, const WorkFolders& work) {
  const auto settings = ReadSettingsFile<ModelStudySettings>(file);
  Experiment experiment;
  experiment.record.name = ConfigName(file);
  experiment.record.title = settings.title;
  experiment.record.description = settings.description;
  PlannedRun& run = experiment.runs.emplace_back();
  run.kind = kModelKind;
  run.resolved = {{"drawing", WriteSettings(settings.drawing)}};
  run.key = CacheKey(run.resolved);
  run.method = settings.drawing.model == DrawnModel::kDynamic ? "dynamic" : "realtime_scape";
  run.variant = "model";
  run.run_id = fmt::format("model.{}.{}", run.method, SettingsHash(run.resolved).substr(0, 8));
  run.experiment = experiment.record.name;
  run.work = work;
  experiment.record.run_ids.push_back(run.run_id);
  return experiment;
}

RunRecord CarryOutModelRun(const PlannedRun& run, const fs::path& run_folder) {
  const auto settings =
      ReadSettings<ModelDrawingSettings>(run.resolved.at("drawing"), ResolvedOrigin("drawing"));
  const BodyModel body = Refine(MakeControlBody(settings.body), settings.mesh);
  const bool is_dynamic = settings.model == DrawnModel::kDynamic;
  WriteSurfaceStrips(run_folder,
                     is_dynamic ? DrawSkeleton(body, settings.skeleton) : DrawBones(body));
  WriteBoneTree(run_folder, is_dynamic ? TreeOfSkeleton(settings.skeleton) : TreeOfBones());
  RunRecord record;
  record.run_id = run.run_id;
  record.experiment = run.experiment;
  record.variant = run.variant;
  record.method = run.method;
  record.config = WithPortablePaths(run.resolved);
  record.provenance = TimedProvenance();
  record.summary = {{"run_id", run.run_id}, {"variant", run.variant}, {"method", run.method}};
  return record;
}

}  // namespace vitruvia
