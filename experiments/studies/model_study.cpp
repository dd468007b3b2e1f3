#include "experiments/studies/model_study.h"

#include <algorithm>
#include <map>

#include "body/start_poses.h"
#include "config/build_cache.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/message.h"
#include "experiments/studies/drawn_parts.h"
#include "experiments/studies/study_plan.h"
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
  const std::vector<TurningBone> turning = BonesWithMainAxis();
  const auto special = std::find_if(turning.begin(), turning.end(), [](const TurningBone& bone) {
    return bone.bone == kSpecialBone;
  });
  Require(special != turning.end(), "{} has no main axis",
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

ShownSurface AxesOf(const ModelSkeleton& skeleton, ModelJointType type) {
  ShownSurface axes;
  axes.color = type == ModelJointType::kHinge ? SurfaceColor::kTruth : SurfaceColor::kEstimate;
  for (const ModelJoint& joint : skeleton.joints) {
    if (joint.type != type) continue;
    Append(Arrow(joint.place, joint.place + kAxisLength_m * joint.axis, kAxisWidth_m), axes.mesh);
  }
  return axes;
}

std::vector<SurfaceStrip> DrawSkeleton(const BodyModel& body, const ModelSkeleton& skeleton) {
  const ShownSurface hinges = AxesOf(skeleton, ModelJointType::kHinge);
  const ShownSurface slides = AxesOf(skeleton, ModelJointType::kSlide);
  const ShownSurface surface{body.rest, SurfaceColor::kEstimate, {}};
  return {
      {body.name,
       fmt::format("{} joints; orange: axes of hinges, blue: of slides", skeleton.joints.size()),
       {{"template in the bind pose", 0.0, {surface}},
        {"regions of the links", 0.0, {RegionsOf(body, body.rest.vertices)}},
        {"hinges and slides", 25.0, {BonesOf(body.skeleton), hinges, slides}},
        {"hinges and slides, from the side", 75.0, {BonesOf(body.skeleton), hinges, slides}}}}};
}

std::string CountedUnlessNone(int count, std::string_view noun) {
  return count == 0 ? "" : Counted(count, noun);
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
  const std::vector<TurningBone> turning = BonesWithMainAxis();
  for (int b = 0; b < kBoneCount; ++b) {
    const BoneInfo& bone = Bones()[b];
    const bool is_special = std::any_of(turning.begin(), turning.end(), [b](const TurningBone& t) {
      return static_cast<int>(t.bone) == b;
    });
    tree.nodes.push_back(
        {std::string(bone.name), is_special ? "turns about its main axis" : "", bone.parent});
  }
  return tree;
}

BoneTree TreeOfSkeleton(const ModelSkeleton& skeleton) {
  BoneTree tree;
  tree.title = fmt::format("The hinges and slides of {}", skeleton.name);
  struct Counts {
    int hinges = 0, slides = 0;
  };
  std::vector<Counts> counts;  // of the nodes' joints
  std::map<std::string, int> node_of_place;
  std::vector<int> node_of_joint;
  for (const ModelJoint& joint : skeleton.joints) {
    const auto [place, is_new] =
        node_of_place.try_emplace(joint.at, static_cast<int>(tree.nodes.size()));
    if (is_new) {
      tree.nodes.push_back({joint.at, "", joint.parent < 0 ? -1 : node_of_joint[joint.parent]});
      counts.emplace_back();
    }
    node_of_joint.push_back(place->second);
    Counts& count = counts[static_cast<std::size_t>(place->second)];
    ++(joint.type == ModelJointType::kHinge ? count.hinges : count.slides);
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::string slides = CountedUnlessNone(counts[i].slides, "slide");
    const std::string hinges = CountedUnlessNone(counts[i].hinges, "hinge");
    tree.nodes[i].detail = slides + (slides.empty() || hinges.empty() ? "" : ", ") + hinges;
  }
  return tree;
}

Experiment PlanModelStudy(const fs::path& file, const WorkFolders& work) {
  const auto settings = ReadSettingsFile<ModelStudySettings>(file);
  Experiment experiment = PlanOf(settings, file);
  PlannedRun run;
  run.kind = kModelKind;
  run.resolved = {{"drawing", WriteSettings(settings.drawing)}};
  run.key = CacheKey(run.resolved);
  run.method = settings.drawing.model == DrawnModel::kDynamic ? "dynamic" : "realtime_scape";
  run.variant = "model";
  run.run_id = fmt::format("model.{}.{}", run.method, SettingsHash(run.resolved).substr(0, 8));
  AddRun(std::move(run), work, experiment);
  return experiment;
}

RunRecord CarryOutModelRun(const PlannedRun& run, const fs::path& run_folder) {
  const auto settings =
      ReadSettings<ModelDrawingSettings>(run.resolved.at("drawing"), ResolvedOrigin("drawing"));
  const BodyModel body = Refine(MakeControlBody(settings.body), settings.mesh);
  if (settings.model == DrawnModel::kDynamic) {
    const ModelSkeleton skeleton = ReadModelSkeleton(settings.skeleton, body.skeleton);
    WriteSurfaceStrips(run_folder, DrawSkeleton(body, skeleton));
    WriteBoneTree(run_folder, TreeOfSkeleton(skeleton));
  } else {
    WriteSurfaceStrips(run_folder, DrawBones(body));
    WriteBoneTree(run_folder, TreeOfBones());
  }
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
