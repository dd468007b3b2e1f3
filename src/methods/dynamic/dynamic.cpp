#include "methods/dynamic/dynamic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "math/angles.h"
#include "methods/dynamic/level.h"
#include "methods/dynamic/pose_solver.h"
#include "methods/dynamic/shape_step.h"

namespace vitruvia::dynamic {
namespace {

TrackedMesh MeshOf(const Subject& subject, Mode mode) {
  return mode == Mode::kRigid ? RigidSegments(subject) : SmoothMesh(subject);
}

AssociationLimits LimitsOf(int window_px, double cutoff_m, double facing_cosine) {
  return {window_px, static_cast<float>(cutoff_m), static_cast<float>(facing_cosine)};
}

// The vertices of the pose step; none where it takes all vertices and pixels.
std::vector<int> CoarseVertices(const TrackedMesh& mesh, const AssociationSettings& settings) {
  if (settings.pose_vertex_stride == 1 && settings.pose_pixel_stride == 1) return {};
  return SpreadVertices(mesh, settings.pose_vertex_stride);
}

// Wide enough for what moved since the last frame at first, and narrow enough in the end that the
// points of a hand do not pull at the face behind it.
double PoseCutoff(const AssociationSettings& settings, int iteration, int iterations) {
  const double done = iterations > 1 ? iteration / (iterations - 1.0) : 1.0;
  return settings.cutoff_m * std::pow(settings.last_cutoff_m / settings.cutoff_m, done);
}

// Where an upright body that faces the camera stands: its crown at the highest point of the cloud,
// and the middle of its front where the cloud's middle is. Holds also when only its upper part is
// in view.
Rigidd FirstGuess(const std::vector<Vector3f>& rest, const std::vector<Vector3f>& cloud) {
  const auto mean = [](const std::vector<Vector3f>& points, auto&& weight_of) {
    Vector3d sum = Vector3d::Zero();
    double weights = 0.0;
    for (const Vector3f& p : points) {
      sum += weight_of(p) * p.cast<double>();
      weights += weight_of(p);
    }
    return Vector3d(sum / std::max(weights, 1.0));
  };
  Rigidd guess;
  guess.rotation = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  const Vector3d cloud_mean = mean(cloud, [](const Vector3f&) { return 1.0; });
  const Vector3d front_mean =
      mean(rest, [](const Vector3f& p) { return p.z() > 0.0f ? 1.0 : 0.0; });
  float top = std::numeric_limits<float>::infinity(), crown = -top;
  for (const Vector3f& p : cloud) top = std::min(top, p.y());
  for (const Vector3f& p : rest) crown = std::max(crown, p.y());
  guess.translation = {cloud_mean.x() - front_mean.x(), double{top} + double{crown},
                       cloud_mean.z() + front_mean.z()};
  return guess;
}

}  // namespace

struct Dynamic::Session {
  Session(const Subject& subject, const PinholeCamera& view, const Settings& settings,
          const SkeletonFile& file)
      : camera(view),
        skeleton(subject.skeleton),
        mesh(MeshOf(subject, settings.mode)),
        subject_vertices(static_cast<int>(subject.rest.vertices.size())),
        tree(file, subject.skeleton),
        fine(mesh, view),
        coarse_vertices(CoarseVertices(mesh, settings.association)),
        shape(fine.surface.layout, mesh.vertices, ClosestNeighbors(mesh.vertices, mesh.triangles)),
        normals(fine.surface.layout, mesh.triangles),
        solver(tree,
               coarse_vertices.empty() ? mesh.weights : Subset(mesh, coarse_vertices).weights),
        team(settings.threads) {
    if (!coarse_vertices.empty()) coarse.emplace(Subset(mesh, coarse_vertices), view);
    theta = Eigen::VectorXd::Zero(tree.joint_count());
    all_joints.assign(tree.joint_count(), 1);
    root_joints.assign(tree.joint_count(), 0);
    for (const int joint : tree.ChainOf(static_cast<int>(BoneId::kPelvis))) root_joints[joint] = 1;
  }

  Level& pose_level() { return coarse ? *coarse : fine; }

  // The coarse level's surface follows the fine one's warps.
  void RefreshCoarse() {
    if (!coarse) return;
    for (std::size_t i = 0; i < coarse_vertices.size(); ++i) {
      const int from = fine.surface.layout.slot_of_vertex[coarse_vertices[i]];
      const int to = coarse->surface.layout.slot_of_vertex[i];
      coarse->surface.rest.Set(to, fine.surface.rest.At(from));
      coarse->surface.rest_normals.Set(to, fine.surface.rest_normals.At(from));
    }
  }

  PinholeCamera camera;
  Skeleton skeleton;
  TrackedMesh mesh;
  int subject_vertices;  // of the mesh's, the first ones
  KinematicTree tree;
  Level fine;
  std::optional<Level> coarse;
  std::vector<int> coarse_vertices;  // the fine level's vertex of each of the coarse level's
  ShapeStep shape;
  RestNormals normals;
  PoseSolver solver;
  WorkerTeam team;
  std::vector<char> all_joints, root_joints;

  bool placed = false;
  Rigidd camera_from_start;  // T_world
  Eigen::VectorXd theta;
  Eigen::VectorXd theta_before, step;  // of the last frame; from it to where this one begins
  TreePose pose;
  PoseEquations equations;

  // Of the frame at hand.
  int frames = 0;
  int iterations = 0;
  bool converged = false, solved = true;
  double matched_share = 0.0;  // of its best iteration
  StepTimes times;
};

Dynamic::Dynamic(const Settings& settings)
    : Dynamic(settings, ReadSkeletonFile(settings.skeleton)) {}

Dynamic::Dynamic(const Settings& settings, SkeletonFile skeleton)
    : settings_(settings), skeleton_(std::move(skeleton)) {}

Dynamic::~Dynamic() = default;

void Dynamic::Start(const Subject& subject, const PinholeCamera& camera) {
  CheckBodyModel(subject, fmt::format("Dynamic cannot use subject {}", subject.name));
  session_ = std::make_unique<Session>(subject, camera, settings_, skeleton_);
}

TrackResult Dynamic::TrackFrame(const DepthFrame& frame) {
  Require(session_ != nullptr, "TrackFrame called before Start");
  BeginFrame(frame);
  Session& s = *session_;
  if (!s.fine.cloud.points.empty()) {
    const bool first = !s.placed;
    if (first) Place();
    FitPose(first);
    FitShape(first);
  }
  return Result();
}

void Dynamic::BeginFrame(const DepthFrame& frame) {
  Session& s = *session_;
  Require(frame.depth.width() == s.camera.width && frame.depth.height() == s.camera.height,
          "frame {} is {}×{} pixels, the camera {}×{}", frame.index, frame.depth.width(),
          frame.depth.height(), s.camera.width, s.camera.height);
  s.times.ms.fill(0.0);
  s.times.watch.LapMs();
  s.iterations = 0;
  s.converged = false;
  s.solved = true;
  s.matched_share = 0.0;
  const auto max_depth = static_cast<float>(settings_.max_depth_m);
  CloudFromDepth(frame.depth, s.camera, 1, max_depth, s.fine.cloud);
  if (s.coarse) {
    CloudFromDepth(frame.depth, s.camera, settings_.association.pose_pixel_stride, max_depth,
                   s.coarse->cloud);
  }
  s.times.Lap(kCloud);
}

// Moves the root's joints alone until the rest pose stands where the first frame's points are.
void Dynamic::Place() {
  Session& s = *session_;
  const PlacementSettings& settings = settings_.placement;
  s.camera_from_start = FirstGuess(s.mesh.vertices, s.fine.cloud.points);
  const AssociationLimits limits =
      LimitsOf(settings.window_px, settings.cutoff_m, settings_.association.facing_cosine);
  Level& level = s.pose_level();
  for (int i = 0; i < settings.iterations; ++i) {
    s.tree.Pose(s.camera_from_start, s.theta, s.pose);
    level.Match(s.pose, limits, s.team, s.times);
    level.Assemble(s.tree, s.pose, s.team, s.equations, s.times);
    s.solver.Step(s.tree, s.equations, s.root_joints, {settings_.pose.damping, 0.0, 0.0}, s.theta);
    s.times.Lap(kSolve);
  }
  s.placed = true;
}

// A frame begins where the joints would be if they went on as they did, or a share of that.
void Dynamic::Predict() {
  Session& s = *session_;
  s.step = settings_.pose.prediction * (s.theta - s.theta_before);
  s.theta_before = s.theta;
  s.theta += s.step;
  s.tree.Clamp(s.theta);
}

void Dynamic::FitPose(bool first) {
  Session& s = *session_;
  const PoseSettings& settings = settings_.pose;
  const AssociationSettings& a = settings_.association;
  const int limit = first ? settings.first_frame_iterations : settings.iterations;
  Level& level = s.pose_level();
  if (!first) Predict();
  while (s.iterations < limit && !s.converged && s.solved) {
    const AssociationLimits limits =
        LimitsOf(a.window_px, PoseCutoff(a, s.iterations, limit), a.facing_cosine);
    s.tree.Pose(s.camera_from_start, s.theta, s.pose);
    level.Match(s.pose, limits, s.team, s.times);
    s.matched_share = std::max(s.matched_share, level.MatchedShare());
    level.Assemble(s.tree, s.pose, s.team, s.equations, s.times);
    const StepSize step = s.solver.Step(
        s.tree, s.equations, s.all_joints,
        {settings.damping, settings.default_pose_weight, settings.held_below_share}, s.theta);
    s.times.Lap(kSolve);
    ++s.iterations;
    s.solved = s.solver.solved();
    s.converged = s.solved && step.rotation_rad < settings.rotation_step_deg * kRadiansPerDegree &&
                  step.translation_m < settings.translation_step_m;
  }
  if (first) s.theta_before = s.theta;
  for (int k = 0; k < s.tree.joint_count(); ++k) {  // what is held does not go on by prediction
    if (s.iterations > 0 && s.solver.IsHeld(k)) s.theta[k] = s.theta_before[k];
  }
  if (!first && IsLost()) s.theta = s.theta_before;  // the few points left would carry it away
  s.tree.Pose(s.camera_from_start, s.theta, s.pose);
}

bool Dynamic::IsLost() const {
  return session_->matched_share < settings_.lost_below || !session_->solved;
}

void Dynamic::FitShape(bool first) {
  Session& s = *session_;
  const ShapeSettings& settings = settings_.shape;
  const AssociationSettings& a = settings_.association;
  const bool every_frame = settings_.mode == Mode::kFull;
  const bool now = (every_frame && !IsLost()) || (settings_.mode == Mode::kShapeMatch && first);
  if (now) {
    const ShapeWeights weights{static_cast<float>(settings.magnitude_weight),
                               static_cast<float>(settings.neighbor_weight)};
    const AssociationLimits limits = LimitsOf(a.window_px, settings.cutoff_m, a.facing_cosine);
    const int iterations = first ? settings.first_frame_iterations : settings.iterations;
    for (int i = 0; i < iterations; ++i) {
      s.fine.Match(s.pose, limits, s.team, s.times);
      s.shape.Iterate(s.fine.observations, weights, s.team, s.fine.surface);
      s.times.Lap(kShape);
    }
    s.normals.Update(s.team, s.fine.surface);
    s.RefreshCoarse();
    s.times.Lap(kNormals);
  }
  s.fine.motions = MotionsOf<float>(s.pose);
  const auto& patches = s.fine.surface.layout.patches;
  s.team.For(static_cast<int>(patches.size()), 4, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) PosePatch(patches[i], s.fine.motions, s.fine.surface);
  });
  s.times.Lap(kSkin);
}

TrackResult Dynamic::Result() const {
  Session& s = *session_;
  TrackResult result;
  if (s.fine.cloud.points.empty()) {
    result.outcome = Outcome::kNoData;
    result.message = "the frame holds no measurement; pose and shape are carried over";
  } else if (IsLost()) {
    result.outcome = Outcome::kLost;
    result.message = s.solved
                         ? fmt::format(
                               "{:.0f} % of the points found a vertex within {:g} m; pose "
                               "and shape are carried over",
                               100.0 * s.matched_share, settings_.association.cutoff_m)
                         : "the normal equations could not be solved; the pose is carried over";
  } else if (s.converged) {
    result.outcome = Outcome::kConverged;
  } else {
    result.outcome = Outcome::kIterationLimit;
    result.message = fmt::format("stopped after {} iterations", s.iterations);
  }
  result.vertices.resize(s.subject_vertices);
  for (int v = 0; v < s.subject_vertices; ++v) {
    result.vertices[v] = s.placed ? s.fine.surface.posed.At(s.fine.surface.layout.slot_of_vertex[v])
                                  : s.mesh.vertices[v];
  }
  for (int bone = 0; bone < kBoneCount; ++bone) {
    result.camera_from_rest.push_back(s.placed ? s.pose.camera_from_rest[bone].ToRigid()
                                               : Rigidd{});
  }
  result.joints = PosedJoints(s.skeleton, result.camera_from_rest);
  result.iterations = s.iterations;
  result.energies = {{"data", s.equations.energy}};
  if (s.placed) result.condition = s.solver.condition();
  s.times.Lap(kResult);
  for (int k = 0; k < kStepCount; ++k) result.step_ms.push_back({kStepNames[k], s.times.ms[k]});
  return result;
}

}  // namespace vitruvia::dynamic
