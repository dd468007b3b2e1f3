#include "methods/realtime_scape/realtime_scape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "core/timer.h"
#include "matching/visibility.h"
#include "methods/realtime_scape/axis_term.h"
#include "methods/realtime_scape/bone_sight.h"
#include "methods/realtime_scape/fit_term.h"
#include "methods/realtime_scape/inertia_term.h"
#include "methods/realtime_scape/joint_term.h"
#include "methods/realtime_scape/placement.h"
#include "methods/realtime_scape/pose_step.h"
#include "methods/realtime_scape/prediction.h"

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
  kRecover,
  kStepCount
};
constexpr std::array<const char*, kStepCount> kStepNames = {
    "2 kd-tree of P", "5 render", "6 kd-tree of V", "7 classify", "8 correspond",
    "9 assemble",     "10 solve", "11 update",      "recover"};

constexpr std::array<const char*, 4> kEnergyNames = {"fit", "joint", "inertia", "axis"};

// Where the body is and how it came there.
struct Course {
  BodyPose pose, last_pose, before_last_pose;
  BoneSight sight;
};

}  // namespace

struct RealtimeScape::Session {
  Session(const Subject& subject, const PinholeCamera& view, const Settings& settings)
      : camera(view),
        model(subject),
        joint_term(model, settings.joint_rows),
        rasterizer(MakeRasterizer(settings.fit.rasterizer, view)),
        course{{}, {}, {}, BoneSight(model)},
        recovery(settings.recovery),
        candidate_finder(model),
        near_cloud(MakeNearestNeighbors(settings.fit.association, view, settings.fit.window_px)),
        near_candidates(
            MakeNearestNeighbors(settings.fit.association, view, settings.fit.window_px)),
        near_settled(MakeNearestNeighbors(settings.fit.association, view, settings.fit.window_px)),
        equations(kBoneCount),
        solver(MakeLinearSolver(settings.solver.linear)) {}

  PinholeCamera camera;
  Model model;
  JointTerm joint_term;
  std::unique_ptr<MeshRasterizer> rasterizer;

  // What is carried from frame to frame.
  bool placed = false;
  Course course;
  Recovery recovery;

  // Workspace, reused from frame to frame.
  int iteration = 0;
  LocalRotations expected;
  PointCloud cloud;
  CandidateFinder candidate_finder;
  std::unique_ptr<NearestNeighbors> near_cloud, near_candidates, near_settled;
  PosedSurface surface;
  const DepthImage* rendered = nullptr;  // the rasteriser's, of the current surface
  std::vector<int> visible, candidates, settled;
  std::vector<int> unexplained;  // P2
  std::vector<int> searching;    // those of P2 that ask for a vertex
  std::vector<Vector3f> positions;
  FitData fit;
  PairFinder pair_finder;
  BlockNormalEquations equations;
  std::unique_ptr<LinearSolver> solver;
  bool solved = true;
  Eigen::VectorXd increment;
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
  if (!BeginFrame(frame)) {
    session_->recovery.NoteEmptyFrame();
    return Result(false, 0);
  }

  const int limit =
      first ? settings_.stopping.first_frame_iterations : settings_.stopping.max_iterations;
  const bool stopped_small = Iterate(frame, limit);
  const int iterations = session_->iteration;
  if (session_->recovery.Note(CurrentAgreement(), session_->course.pose)) TryOtherPoses(frame);
  EndFrame();
  return Result(stopped_small, iterations);
}

// Lines 4 to 12. True if the stopping rule was met.
bool RealtimeScape::Iterate(const DepthFrame& frame, int limit) {
  int& iteration = session_->iteration;
  bool stopped_small = false;
  for (iteration = 0; iteration < limit && !stopped_small && session_->solved; ++iteration) {
    Render();
    Classify(frame);
    BuildCandidates();
    FindPairs();
    Assemble();
    Solve();
    stopped_small = IsSmall(Update());
  }
  return stopped_small;
}

Agreement RealtimeScape::CurrentAgreement() const {
  const Session& s = *session_;
  return MeasureAgreement(s.cloud.points.size(), s.unexplained.size(), s.visible.size(),
                          s.fit.classes);
}

// Puts the body into that pose, as if it had always been in it.
void RealtimeScape::StartFrom(const BodyPose& pose) {
  Session& s = *session_;
  s.course.pose = s.course.last_pose = s.course.before_last_pose = pose;
  s.expected = LocalRotationsOf(pose);
  s.solved = true;
  s.course.sight.Forget();
  PoseSurface(s.model, s.course.pose, s.surface);
}

Agreement RealtimeScape::Compare(const DepthFrame& frame, const BodyPose& pose) {
  StartFrom(pose);
  session_->iteration = 0;
  Render();
  Classify(frame);
  return CurrentAgreement();
}

// The pose moved so that what the camera sees of it lies on the cloud.
BodyPose RealtimeScape::OnCloud(BodyPose pose) {
  constexpr int kRounds = 2;  // what is visible changes as it moves
  Session& s = *session_;
  const auto add = [](const Vector3d& sum, const Vector3f& p) -> Vector3d {
    return sum + p.cast<double>();
  };
  const auto points = static_cast<double>(s.cloud.points.size());
  const Vector3d observed = std::accumulate(s.cloud.points.begin(), s.cloud.points.end(),
                                            Vector3d(Vector3d::Zero()), add) /
                            points;
  for (int round = 0; round < kRounds; ++round) {
    StartFrom(pose);
    s.iteration = 0;
    Render();
    Vector3d seen = Vector3d::Zero();
    for (const int v : s.visible) seen = add(seen, s.surface.vertices[v]);
    const bool nothing = s.visible.empty();
    seen = nothing ? pose.front().center : Vector3d(seen / static_cast<double>(s.visible.size()));
    pose = Shifted(pose, observed - seen);
  }
  return pose;
}

// The best few of many poses get iterations; the best of those is kept if it agrees clearly better.
void RealtimeScape::TryOtherPoses(const DepthFrame& frame) {
  Session& s = *session_;
  struct Tried {
    BodyPose pose;
    Agreement agreement;
  };
  const auto by_score = [](const Tried& a, const Tried& b) {
    return a.agreement.score() > b.agreement.score();
  };
  const Course course = s.course;
  const Agreement agreement = CurrentAgreement();
  std::vector<Tried> tried;
  for (const BodyPose& hypothesis : s.recovery.Hypotheses(course.pose)) {
    const BodyPose pose = OnCloud(hypothesis);
    for (const double aside_m : {0.0, -0.3, 0.3}) {  // part of the body may be out of the image
      const BodyPose there = Shifted(pose, {aside_m, 0.0, 0.0});
      tried.push_back({there, Compare(frame, there)});
    }
  }
  std::stable_sort(tried.begin(), tried.end(), by_score);
  tried.resize(std::min(tried.size(), static_cast<std::size_t>(settings_.recovery.tried)));
  for (Tried& candidate : tried) {
    StartFrom(candidate.pose);
    Iterate(frame, settings_.stopping.first_frame_iterations);
    const BodyPose reached = s.course.pose;
    candidate = {reached, Compare(frame, reached)};
  }
  const Tried& best = *std::min_element(tried.begin(), tried.end(), by_score);
  const bool is_better = s.recovery.IsBetter(best.agreement, agreement);
  Compare(frame, is_better ? best.pose : course.pose);
  if (is_better) {
    s.recovery.Found(best.agreement);
  } else {
    s.course = course;
  }
  s.Lap(kRecover);
}

// Lines 1 and 2: the pose to start from; the points P. False if there are none.
bool RealtimeScape::BeginFrame(const DepthFrame& frame) {
  Session& s = *session_;
  Require(frame.depth.width() == s.camera.width && frame.depth.height() == s.camera.height,
          "frame {} is {}×{} pixels, the camera {}×{}", frame.index, frame.depth.width(),
          frame.depth.height(), s.camera.width, s.camera.height);
  s.step_ms.fill(0.0);
  s.energies.fill(0.0);
  s.solved = true;
  s.watch.LapMs();
  CloudFromDepth(frame.depth, s.camera, settings_.cloud.stride,
                 static_cast<float>(settings_.cloud.max_depth_m), s.cloud);
  if (s.cloud.points.empty()) return false;
  s.near_cloud->Build(s.cloud.points);
  if (!s.placed) Place();
  Predict();
  s.Lap(kCloudTree);
  return true;
}

void RealtimeScape::Place() {
  Session& s = *session_;
  const Rigidd camera_from_subject =
      PlaceRestPose(s.model, s.cloud, s.camera, settings_.fit, settings_.placement, *s.rasterizer);
  BodyPose pose;
  for (int j = 0; j < kBoneCount; ++j) {
    pose[j] = {camera_from_subject.rotation, camera_from_subject * s.model.rest_centers[j]};
  }
  StartFrom(pose);
  s.placed = true;
}

void RealtimeScape::Predict() {
  Session& s = *session_;
  const Prediction prediction = PredictPose(s.model, s.course.last_pose, s.course.before_last_pose,
                                            s.course.sight, settings_.motion);
  s.course.pose = prediction.pose;
  s.expected = prediction.local_rotations;
  PoseSurface(s.model, s.course.pose, s.surface);
}

// Line 5.
void RealtimeScape::Render() {
  Session& s = *session_;
  if (s.iteration < settings_.fit.visibility_iterations) {
    s.rendered = &s.rasterizer->Render(s.surface.vertices, s.model.triangles);
    FindVisibleVertices(s.surface.vertices, *s.rendered, s.camera,
                        static_cast<float>(settings_.fit.visible_within_m), s.visible);
  }
  s.Lap(kRender);
}

// Line 7.
void RealtimeScape::Classify(const DepthFrame& frame) {
  Session& s = *session_;
  const NearnessSettings nearness{static_cast<float>(settings_.fit.near_surface_m),
                                  settings_.fit.edge_px, static_cast<float>(settings_.fit.smooth_m),
                                  settings_.fit.behind_surface};
  ClassifyVertices(s.surface.vertices, s.visible, frame.depth, s.camera, nearness, s.fit.classes);
  FindUnexplainedPoints(s.cloud, *s.rendered, nearness, s.unexplained);
  s.course.sight.Count(s.model, s.visible, s.fit.classes);
  s.Lap(kClassify);
}

// Line 6; after line 7, for what may be paired depends on what is confirmed.
void RealtimeScape::BuildCandidates() {
  Session& s = *session_;
  s.searching = s.unexplained;
  s.candidate_finder.Find(s.model, s.surface, s.visible, s.course.sight, settings_.search,
                          s.candidates, s.settled);
  const auto build = [&](const std::vector<int>& vertices, NearestNeighbors& neighbors) {
    s.positions.clear();
    for (const int i : vertices) s.positions.push_back(s.surface.vertices[i]);
    neighbors.Build(s.positions);
  };
  build(s.candidates, *s.near_candidates);
  if (s.settled.empty()) return s.Lap(kVisibleTree);
  // Points at the skin of settled bones are theirs, and ask nothing.
  build(s.settled, *s.near_settled);
  s.pair_finder.DropNear(s.cloud, *s.near_settled, static_cast<float>(settings_.search.owned_m),
                         s.searching);
  s.Lap(kVisibleTree);
}

// Line 8.
void RealtimeScape::FindPairs() {
  Session& s = *session_;
  std::array<float, kBoneCount> reach;
  for (int j = 0; j < kBoneCount; ++j) {
    reach[j] = static_cast<float>(ReachOf(j, s.course.sight, settings_.fit, settings_.search));
  }
  s.fit.pairs.clear();
  s.pair_finder.VerticesToPoints(s.surface.vertices, s.fit.classes.elsewhere, s.cloud,
                                 *s.near_cloud, static_cast<float>(settings_.fit.pair_cutoff_m),
                                 s.fit.pairs);
  s.pair_finder.PointsToVertices(
      s.cloud, s.searching, s.candidates, *s.near_candidates,
      *std::max_element(reach.begin(), reach.end()),
      [&](int vertex) { return reach[s.model.weights.bones[vertex][0]]; }, s.fit.pairs);
  s.Lap(kCorrespond);
}

// Line 9.
void RealtimeScape::Assemble() {
  Session& s = *session_;
  const double unit = settings_.length_unit_m;
  s.equations.Reset();
  s.energies = {
      AddFitTerm(s.model, s.course.pose, s.camera, s.fit, settings_.fit, unit, s.equations),
      s.joint_term.Add(s.model, s.course.pose, settings_.joint_weight, unit, s.equations),
      AddInertiaTerm(s.course.pose, s.expected, settings_.inertia_weight, s.equations),
      AddAxisTerm(s.course.pose, settings_.axis_weight, s.equations)};
  s.equations.AddDamping(settings_.solver.damping);
  s.equations.Symmetrize();
  s.Lap(kAssemble);
}

// Line 10.
void RealtimeScape::Solve() {
  Session& s = *session_;
  const bool finite = std::isfinite(s.equations.energy());
  s.solved = finite && s.solver->Solve(s.equations.hessian(), -s.equations.gradient(), s.increment);
  if (!finite) s.increment.setZero(s.equations.size());
  s.Lap(kSolve);
}

// Line 11.
RealtimeScape::Step RealtimeScape::Update() {
  Session& s = *session_;
  Step largest;
  for (int j = 0; j < kBoneCount; ++j) {
    const Vector3d rotation = s.increment.segment<3>(kBlockSize * j);
    const Vector3d translation =
        settings_.length_unit_m * s.increment.segment<3>(kBlockSize * j + 3);
    s.course.pose[j].rotation =
        Turned(s.course.pose[j].rotation, rotation, settings_.rotation_update);
    s.course.pose[j].center += translation;
    largest.rotation_rad = std::max(largest.rotation_rad, rotation.norm());
    largest.translation_m = std::max(largest.translation_m, translation.norm());
  }
  if (!s.solved || IsTornApart(s.course.pose)) {
    s.course.pose = s.course.last_pose;
    s.solved = false;
  }
  PoseSurface(s.model, s.course.pose, s.surface);
  s.Lap(kUpdate);
  return largest;
}

// Line 12.
bool RealtimeScape::IsSmall(const Step& step) const {
  return step.rotation_rad < settings_.stopping.rotation_step_deg * std::numbers::pi / 180.0 &&
         step.translation_m < settings_.stopping.translation_step_m;
}

void RealtimeScape::EndFrame() {
  Session& s = *session_;
  s.course.sight.EndFrame(settings_.search.seen_share);
  s.course.before_last_pose = s.course.last_pose;
  s.course.last_pose = s.course.pose;
}

TrackResult RealtimeScape::Result(bool stopped_small, int iterations) {
  Session& s = *session_;
  TrackResult result;
  const double presence = CurrentAgreement().presence();
  if (s.cloud.points.empty()) {
    result.outcome = Outcome::kNoData;
    result.message = "the frame holds no measurement; the pose is carried over";
  } else if (presence < settings_.lost_below || s.recovery.is_lost()) {
    result.outcome = Outcome::kLost;
    result.message = fmt::format("the frame confirms {:.0f} % of the model, usually {:.0f} %",
                                 100.0 * presence, 100.0 * s.recovery.usual().presence());
  } else if (!s.solved) {
    result.outcome = Outcome::kLost;
    result.message = "the step has no solution or tears the body apart; the pose is carried over";
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
  result.condition = iterations > 0 ? s.solver->EstimateCondition() : -1.0;
  return result;
}

}  // namespace vitruvia::realtime_scape
