#include "methods/realtime_scape/realtime_scape.h"

#include <numbers>

#include "core/error.h"
#include "core/timer.h"
#include "matching/visibility.h"
#include "methods/realtime_scape/axis_term.h"
#include "methods/realtime_scape/placement.h"

namespace vitruvia::realtime_scape {
namespace {

// The steps of algorithm 1 as table 1 of the paper times them, by line number.
enum TimedStep {
  kCloudTree,
  kRender,
  kVisibleTree,
  kClassify,
  kCorrespond,
  kAssemble,
  kSolve,
  kUpdate,
  kStepCount
};
constexpr std::array<const char*, kStepCount> kStepNames = {
    "2 kd-tree of P", "5 render",   "6 kd-tree of V", "7 classify",
    "8 correspond",   "9 assemble", "10 solve",       "11 update"};

constexpr std::array<const char*, 4> kEnergyNames = {"fit", "joint", "inertia", "axis"};

}  // namespace

struct RealtimeScape::Session {
  Session(const Subject& subject, const PinholeCamera& view, const Settings& settings)
      : camera(view),
        model(subject),
        joint_term(model, settings.joint_rows),
        zbuffer(view),
        equations(kBoneCount) {}

  PinholeCamera camera;
  Model model;
  JointTerm joint_term;
  ZBuffer zbuffer;

  bool placed = false;
  BodyPose pose;
  LocalRotations previous;

  // Workspace, reused from frame to frame.
  PointCloud cloud;
  KdTree cloud_tree, visible_tree;
  PosedSurface surface;
  const DepthImage* rendered = nullptr;  // the z-buffer's, of the current surface
  std::vector<int> visible, unexplained;
  std::vector<Vector3f> visible_positions;
  FitData fit;
  PairFinder pair_finder;
  BlockNormalEquations equations;
  ConjugateGradients solver;
  Eigen::VectorXd increment;
  ConjugateGradientsSummary solver_summary;
  std::array<double, 4> energies{};
  std::array<double, kStepCount> step_ms{};
  Stopwatch watch;

  void Lap(TimedStep step) { step_ms[step] += watch.LapMs(); }
};

RealtimeScape::RealtimeScape(const Settings& settings) : settings_(settings) {}

RealtimeScape::~RealtimeScape() = default;

void RealtimeScape::Start(const Subject& subject, const PinholeCamera& camera) {
  const std::string problem =
      WeightsProblem(subject.weights, subject.rest.vertices.size(), kBoneCount);
  Require(problem.empty(), "Realtime SCAPE cannot use subject {}: {}", subject.name, problem);
  session_ = std::make_unique<Session>(subject, camera, settings_);
}

TrackResult RealtimeScape::TrackFrame(const DepthFrame& frame) {
  Require(session_ != nullptr, "TrackFrame called before Start");
  const bool first = !session_->placed;
  BeginFrame(frame);
  if (session_->cloud.points.empty()) return Result(false, 0);

  const int limit =
      first ? settings_.stopping.first_frame_iterations : settings_.stopping.max_iterations;
  int iterations = 0;
  bool stopped_small = false;
  while (iterations < limit && !stopped_small) {
    Render();
    BuildVisibleTree();
    Classify(frame);
    FindPairs();
    Assemble();
    Solve();
    stopped_small = IsSmall(Update());
    ++iterations;
  }
  return Result(stopped_small, iterations);
}

// Line 1 and 2: start from the last frame's pose; build the tree of P.
void RealtimeScape::BeginFrame(const DepthFrame& frame) {
  Session& s = *session_;
  Require(frame.depth.width() == s.camera.width && frame.depth.height() == s.camera.height,
          "frame {} is {}×{} pixels, the camera {}×{}", frame.index, frame.depth.width(),
          frame.depth.height(), s.camera.width, s.camera.height);
  s.step_ms.fill(0.0);
  s.energies.fill(0.0);
  s.solver_summary = {};
  s.watch.LapMs();
  CloudFromDepth(frame.depth, s.camera, settings_.cloud.stride,
                 static_cast<float>(settings_.cloud.max_depth_m), s.cloud);
  if (s.cloud.points.empty()) return;
  s.cloud_tree.Build(s.cloud.points);
  if (!s.placed) {
    const Rigidd camera_from_subject =
        PlaceRestPose(s.model, s.cloud, s.camera, settings_.fit, settings_.placement, s.zbuffer);
    for (int j = 0; j < kBoneCount; ++j) {
      s.pose[j] = {camera_from_subject.rotation, camera_from_subject * s.model.rest_centers[j]};
    }
    PoseSurface();
    s.placed = true;
  }
  s.previous = LocalRotationsOf(s.pose);
  s.Lap(kCloudTree);
}

void RealtimeScape::PoseSurface() {
  Session& s = *session_;
  s.surface.camera_from_rest = ToTransforms(s.model, s.pose);
  SkinLinear(s.model.rest_vertices, s.model.weights, s.surface.camera_from_rest,
             s.surface.vertices);
}

// Line 5.
void RealtimeScape::Render() {
  Session& s = *session_;
  s.rendered = &s.zbuffer.Render(s.surface.vertices, s.model.triangles);
  FindVisibleVertices(s.surface.vertices, *s.rendered, s.camera,
                      static_cast<float>(settings_.fit.visible_within_m), s.visible);
  s.Lap(kRender);
}

// Line 6.
void RealtimeScape::BuildVisibleTree() {
  Session& s = *session_;
  s.visible_positions.clear();
  for (const int i : s.visible) s.visible_positions.push_back(s.surface.vertices[i]);
  s.visible_tree.Build(s.visible_positions);
  s.Lap(kVisibleTree);
}

// Line 7.
void RealtimeScape::Classify(const DepthFrame& frame) {
  Session& s = *session_;
  const NearnessSettings nearness{static_cast<float>(settings_.fit.near_surface_m),
                                  settings_.fit.edge_px,
                                  static_cast<float>(settings_.fit.smooth_m)};
  ClassifyVertices(s.surface.vertices, s.visible, frame.depth, s.camera, nearness, s.fit.classes);
  FindUnexplainedPoints(s.cloud, *s.rendered, nearness, s.unexplained);
  s.Lap(kClassify);
}

// Line 8.
void RealtimeScape::FindPairs() {
  Session& s = *session_;
  const auto cutoff = static_cast<float>(settings_.fit.pair_cutoff_m);
  s.fit.pairs.clear();
  s.pair_finder.VerticesToPoints(s.surface.vertices, s.fit.classes.elsewhere, s.cloud, s.cloud_tree,
                                 cutoff, s.fit.pairs);
  s.pair_finder.PointsToVertices(s.cloud, s.unexplained, s.visible, s.visible_tree, cutoff,
                                 s.fit.pairs);
  s.Lap(kCorrespond);
}

// Line 9.
void RealtimeScape::Assemble() {
  Session& s = *session_;
  const double unit = settings_.length_unit_m;
  s.equations.Reset();
  s.energies = {
      AddFitTerm(s.model, s.pose, s.surface, s.camera, s.fit, settings_.fit, unit, s.equations),
      s.joint_term.Add(s.model, s.pose, settings_.joint_weight, unit, s.equations),
      AddInertiaTerm(s.pose, s.previous, settings_.inertia_weight, s.equations),
      AddAxisTerm(s.pose, settings_.axis_weight, s.equations)};
  s.equations.AddDamping(settings_.solver.damping);
  s.equations.Symmetrize();
  s.Lap(kAssemble);
}

// Line 10.
void RealtimeScape::Solve() {
  Session& s = *session_;
  s.solver_summary = s.solver.Solve(s.equations.hessian(), -s.equations.gradient(),
                                    settings_.solver.relative_tolerance,
                                    settings_.solver.max_iterations, s.increment);
  s.Lap(kSolve);
}

// Line 11. Departure: rotations are composed with the exponential, so that they stay rotations.
RealtimeScape::Step RealtimeScape::Update() {
  Session& s = *session_;
  Step largest;
  for (int j = 0; j < kBoneCount; ++j) {
    const Vector3d rotation = s.increment.segment<3>(kBlockSize * j);
    const Vector3d translation =
        settings_.length_unit_m * s.increment.segment<3>(kBlockSize * j + 3);
    s.pose[j].rotation = NearestRotation<double>(ExpSo3<double>(rotation) * s.pose[j].rotation);
    s.pose[j].center += translation;
    largest.rotation_rad = std::max(largest.rotation_rad, rotation.norm());
    largest.translation_m = std::max(largest.translation_m, translation.norm());
  }
  PoseSurface();
  s.Lap(kUpdate);
  return largest;
}

// Line 12.
bool RealtimeScape::IsSmall(const Step& step) const {
  return step.rotation_rad < settings_.stopping.rotation_step_deg * std::numbers::pi / 180.0 &&
         step.translation_m < settings_.stopping.translation_step_m;
}

TrackResult RealtimeScape::Result(bool stopped_small, int iterations) {
  Session& s = *session_;
  TrackResult result;
  const std::size_t points = s.cloud.points.size();
  const double explained =
      points == 0 ? 0.0
                  : 1.0 - static_cast<double>(s.unexplained.size()) / static_cast<double>(points);
  if (points == 0) {
    result.outcome = Outcome::kNoData;
    result.message = "the frame holds no measurement; the pose is carried over";
  } else if (explained < settings_.lost_below) {
    result.outcome = Outcome::kLost;
    result.message = fmt::format("the model explains {:.0f} % of the points", 100.0 * explained);
  } else {
    result.outcome = stopped_small ? Outcome::kConverged : Outcome::kIterationLimit;
    if (!stopped_small)
      result.message = fmt::format("still moving after {} iterations", iterations);
  }
  result.vertices = s.surface.vertices;
  result.camera_from_rest = s.surface.camera_from_rest;
  if (!s.placed) {  // nothing was ever seen: the rest pose at the origin
    result.vertices = s.model.rest_vertices;
    result.camera_from_rest.assign(kBoneCount, Rigidd{});
  }
  result.joints = PosedJoints(s.model.skeleton, result.camera_from_rest);
  result.iterations = iterations;
  for (std::size_t k = 0; k < kEnergyNames.size(); ++k)
    result.energies.push_back({kEnergyNames[k], s.energies[k]});
  for (std::size_t k = 0; k < kStepCount; ++k)
    result.step_ms.push_back({kStepNames[k], s.step_ms[k]});
  result.condition = s.solver_summary.condition;
  return result;
}

}  // namespace vitruvia::realtime_scape
