#include "methods/dynamic/dynamic.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "geometry/mesh_rasterizer.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "methods/dynamic/energy_terms.h"
#include "methods/dynamic/level.h"
#include "methods/dynamic/pose_solver.h"
#include "methods/dynamic/shape_step.h"
#include "tracking/depth_gap.h"
#include "tracking/facing.h"
#include "tracking/frame_checks.h"

namespace vitruvia::dynamic {
namespace {

constexpr float kNear_m = 0.05f;   // points within the tracker's own cutoff count as explained
constexpr int kLimbStride_px = 2;  // limbs are searched in half of the rows and columns

// A motion of each bone about the subject's origin.
BodyPose BodyPoseOf(const BoneTransforms& camera_from_rest) {
  BodyPose pose;
  for (int bone = 0; bone < kBoneCount; ++bone)
    pose[bone] = {camera_from_rest[bone].rotation, camera_from_rest[bone].translation};
  return pose;
}

LimbBody LimbBodyAboutOrigin(const Subject& subject) {
  std::array<Vector3d, kBoneCount> rest_centers;
  rest_centers.fill(Vector3d::Zero());
  return LimbBodyOf(subject.skeleton, rest_centers, subject.rest.vertices, subject.weights);
}

// How near model and frame must be where areas are compared.
NearnessSettings AreaNearness(const Settings& settings) {
  return {kNear_m, settings.area_edge_px, 0.0f};
}

BoneTransforms BonesOf(const BodyPose& pose) {
  BoneTransforms bones;
  for (const BonePose& bone : pose) bones.push_back({bone.rotation, bone.center});
  return bones;
}

TrackedMesh MeshOf(const Subject& subject, Mode mode) {
  return mode == Mode::kRigid ? RigidSegments(subject) : SmoothMesh(subject);
}

AssociationLimits LimitsOf(int window_px, double cutoff_m, double facing_cosine) {
  return {window_px, static_cast<float>(cutoff_m), static_cast<float>(facing_cosine)};
}

// The vertices of the pose step; none if it uses all vertices and pixels.
std::vector<int> CoarseVertices(const TrackedMesh& mesh, const AssociationSettings& settings) {
  if (settings.pose_vertex_stride == 1 && settings.pose_pixel_stride == 1) return {};
  return SpreadVertices(mesh, settings.pose_vertex_stride);
}

// Wide in the first iteration, for what moved since the last frame; narrow in the last one, so that
// the points of a hand do not pull at the face behind it. It falls geometrically.
double PoseCutoff(const AssociationSettings& settings, int iteration, int iterations) {
  const double done = iterations > 1 ? iteration / (iterations - 1.0) : 1.0;
  return settings.cutoff_m * std::pow(settings.last_cutoff_m / settings.cutoff_m, done);
}

BoneTransforms BonesOf(const TreePose& pose) {
  BoneTransforms bones;
  for (const auto& motion : pose.camera_from_rest) bones.push_back(motion.ToRigid());
  return bones;
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
    if (settings.watch.lost_above > 0.0) {
      watch.emplace(Watch{{subject, view, 1, settings.max_depth_m, settings.watch.reach_m},
                          AreaWatch(settings.watch)});
    }
    if (settings.limbs.min_unexplained_m2 > 0.0) {
      limbs.emplace(Limbs{
          {subject, view, kLimbStride_px, settings.max_depth_m, settings.watch.reach_m},
          {LimbBodyAboutOrigin(subject), view, kLimbStride_px, double{kNear_m}, settings.limbs}});
    }
    if (settings.start == Start::kSearch || watch) {
      start_search.emplace(subject, view, settings.max_depth_m, settings.start_search);
    }
    if (settings.facing.margin_m > 0.0) {
      facing.emplace(Facing{FacingWatch(settings.facing), subject.rest.triangles,
                            MakeRasterizer(Rasterizer::kFrontFaces, view)});
    }
    theta = Eigen::VectorXd::Zero(tree.joint_count());
    all_joints.assign(tree.joint_count(), 1);
    root_joints.assign(tree.joint_count(), 0);
    for (const int joint : tree.ChainOf(static_cast<int>(BoneId::kPelvis))) root_joints[joint] = 1;
  }

  // Monitoring of areas, if enabled in the settings.
  struct Watch {
    BodyAreaMeter meter;
    AreaWatch verdict;
  };

  // Search for limbs, if enabled in the settings.
  struct Limbs {
    BodyAreaMeter meter;
    LimbSearch search;
  };

  // Comparison with the other facing, if enabled in the settings.
  struct Facing {
    FacingWatch watch;
    std::vector<Triangle> triangles;  // of the subject
    std::unique_ptr<MeshRasterizer> rasterizer;
  };

  Level& pose_level() { return coarse ? *coarse : fine; }

  // Copies the fine level's warped rest surface to the coarse level.
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
  int subject_vertices;  // the first ones of the mesh
  KinematicTree tree;
  Level fine;
  std::optional<Level> coarse;
  std::vector<int> coarse_vertices;  // the fine level's vertex of each of the coarse level's
  ShapeStep shape;
  RestNormals normals;
  PoseSolver solver;
  WorkerTeam team;
  std::optional<StartSearch> start_search;
  std::optional<Watch> watch;
  std::optional<Limbs> limbs;
  std::optional<Facing> facing;
  std::vector<char> all_joints, root_joints;  // per joint: may it move?

  // Carried from frame to frame.
  bool placed = false;        // the subject was put onto a frame
  std::string start_message;  // of the last search for the first pose
  Rigidd camera_from_start;   // T_world
  Eigen::VectorXd theta;
  Eigen::VectorXd theta_before;  // at the end of the frame before
  TreePose pose;                 // of theta

  // Of the frame at hand.
  PoseEquations equations;
  std::vector<Vector3f> subject_surface;  // posed vertices in the subject's order
  Clock clock;
};

// Result of fitting one frame.
struct Dynamic::FrameFit {
  std::optional<UnfittedFrame> unfitted{};  // why the frame was not fitted
  int iterations = 0;                       // of the pose
  bool solved = true;                       // by all iterations
  bool converged = false;
  double matched_share = 0.0;  // share of the points that found a vertex, in the best iteration
  double condition = -1.0;     // of the last iteration
  Energies energies{};
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
  ReadClouds(frame);
  FrameFit fit;
  fit.unfitted =
      CheckPoints(session_->fine.cloud, frame.depth, settings_.max_depth_m, settings_.least_points);
  const bool is_first = !session_->placed;
  if (!fit.unfitted) {
    if (is_first) FindFirstPose(frame);
    if (session_->placed) {
      fit = FitPose(is_first);
      if (session_->facing && !is_first) fit = TakeOtherFacing(frame, std::move(fit));
      if (session_->limbs && !is_first) fit = TakeFoundLimb(frame, std::move(fit));
      FitShape(is_first, fit);
      session_->fine.PoseVertices(session_->pose, session_->team, session_->clock);
      if (session_->watch) WatchAreas(frame);
    }
  }
  TrackResult result = Result(fit);
  if (is_first && session_->placed && settings_.start == Start::kSearch) {
    result.message = WithStart(session_->start_message, result.message);
  }
  return result;
}

void Dynamic::ReadClouds(const DepthFrame& frame) {
  Session& s = *session_;
  CheckFrameSize(frame, s.camera);
  s.clock.Restart();
  s.team.WakeUp();
  s.fine.ReadCloud(frame.depth, s.camera, 1, settings_.max_depth_m);
  if (s.coarse) {
    s.coarse->ReadCloud(frame.depth, s.camera, settings_.association.pose_pixel_stride,
                        settings_.max_depth_m);
  }
  s.clock.Lap(TimedStep::kCloud);
}

// Leaves the session unplaced if a search does not find the subject.
void Dynamic::FindFirstPose(const DepthFrame& frame) {
  Session& s = *session_;
  if (settings_.start == Start::kRestPose) return Place();
  const FoundStart found = s.start_search->Find(frame.depth, frame.known);
  s.start_message = found.message;
  s.placed = found.found;
  if (!found.found) return;
  TreeStart start = StartFrom(s.tree, found.camera_from_rest);
  s.camera_from_start = start.camera_from_start;
  s.theta = std::move(start.theta);
  s.clock.Lap(TimedStep::kSolve);
}

// Detects a lost frame by areas, and adopts a pose out of the current one's reach if it overlaps
// better with the frame. The shape is kept.
void Dynamic::WatchAreas(const DepthFrame& frame) {
  Session& s = *session_;
  const BodyAreas here = MeasureAreas(frame.depth);
  s.watch->verdict.Assess(here);
  if (!s.watch->verdict.is_search_due()) return;
  const FoundStart found = s.start_search->Find(s.watch->meter.StrayDepth(frame.depth), {});
  if (found.camera_from_rest.empty()) return;  // too few points to search in
  const Rigidd place_before = s.camera_from_start;
  const Eigen::VectorXd theta_before = s.theta;
  const auto take = [&](const Rigidd& camera_from_start, const Eigen::VectorXd& theta) {
    s.camera_from_start = camera_from_start;
    s.theta = theta;
    s.tree.Pose(s.camera_from_start, s.theta, s.pose);
    s.fine.PoseVertices(s.pose, s.team, s.clock);
  };
  const TreeStart start = StartFrom(s.tree, found.camera_from_rest);
  take(start.camera_from_start, start.theta);
  const BodyAreas there = MeasureAreas(frame.depth);
  if (there.overlap() > here.overlap() + settings_.watch.margin) {
    s.theta_before = s.theta;
    s.watch->verdict.NoteFound(there);
  } else {
    take(place_before, theta_before);
  }
  s.clock.Lap(TimedStep::kSolve);
}

BodyAreas Dynamic::MeasureAreas(const DepthImage& depth) {
  Session& s = *session_;
  return s.watch->meter.Measure(SubjectVertices(), BonesOf(s.pose), depth, AreaNearness(settings_));
}

const std::vector<Vector3f>& Dynamic::SubjectVertices() {
  Session& s = *session_;
  s.subject_surface.resize(s.subject_vertices);
  for (int v = 0; v < s.subject_vertices; ++v)
    s.subject_surface[v] = s.fine.surface.posed.At(s.fine.surface.layout.slot_of_vertex[v]);
  return s.subject_surface;
}

// Aligns the rest pose with the first frame's points by moving only the root's joints.
void Dynamic::Place() {
  Session& s = *session_;
  const PlacementSettings& settings = settings_.placement;
  s.camera_from_start = UprightPlacement(s.mesh.vertices, s.fine.cloud.points);
  const AssociationLimits limits =
      LimitsOf(settings.window_px, settings.cutoff_m, settings_.association.facing_cosine);
  Level& level = s.pose_level();
  for (int i = 0; i < settings.iterations; ++i) {
    s.tree.Pose(s.camera_from_start, s.theta, s.pose);
    level.Match(s.pose, limits, s.team, s.clock);
    level.Assemble(s.tree, s.pose, s.team, s.equations, s.clock);
    s.solver.Step(s.tree, s.equations, s.root_joints, {settings_.pose.damping, 0.0, 0.0}, s.theta);
    s.clock.Lap(TimedStep::kSolve);
  }
  s.placed = true;
}

Dynamic::FrameFit Dynamic::FitPose(bool is_first) {
  Session& s = *session_;
  const PoseSettings& settings = settings_.pose;
  const Eigen::VectorXd start = s.theta;
  if (!is_first) {  // each joint goes on with a share of its last motion
    const Eigen::VectorXd predicted_step = settings.prediction * (s.theta - s.theta_before);
    s.theta += predicted_step;
    s.tree.Clamp(s.theta);
  }
  FrameFit fit;
  const int limit = is_first ? settings.first_frame_iterations : settings.iterations;
  while (fit.iterations < limit && !fit.converged && fit.solved) IteratePose(limit, fit);

  for (int k = 0; k < s.tree.joint_count(); ++k) {  // the prediction does not move a frozen joint
    if (!is_first && s.solver.IsFrozen(k)) s.theta[k] = start[k];
  }
  // In a lost frame the few matched points would move the body to a wrong place.
  if (!is_first && IsLost(fit)) s.theta = start;
  s.theta_before = is_first ? s.theta : start;
  s.tree.Pose(s.camera_from_start, s.theta, s.pose);
  return fit;
}

// Tries the last pose turned by 180° and the current one with front and back exchanged if model and
// frame are farther apart in depth than usual. The pose closest to the frame is kept.
Dynamic::FrameFit Dynamic::TakeOtherFacing(const DepthFrame& frame, FrameFit fit) {
  Session& s = *session_;
  if (IsLost(fit)) return fit;
  const double current_m2 = GapTo(frame.depth);
  if (!s.facing->watch.IsDue(current_m2)) return fit;

  const TreeStart current{s.camera_from_start, s.theta};
  const PoseEquations current_equations = s.equations;
  TreePose last;
  s.tree.Pose(s.camera_from_start, s.theta_before, last);
  const Matrix3<double> trunk = last.camera_from_rest.front().ToRigid().rotation;
  const TreeStart turned{HalfTurn(trunk, last.twist_origin) * s.camera_from_start, s.theta_before};
  const TreeStart away = StartFrom(s.tree, FacingAway(s.skeleton, BonesOf(s.pose)));

  double least_m2 = s.facing->watch.GapToBeat(current_m2);
  std::optional<TreeStart> best;
  FrameFit best_fit;
  PoseEquations best_equations;
  for (const TreeStart& start : {turned, away}) {
    const FrameFit refined = Refine(start, settings_.pose.first_frame_iterations);
    const double reached_m2 = GapTo(frame.depth);
    if (IsLost(refined) || reached_m2 >= least_m2) continue;
    least_m2 = reached_m2;
    best = TreeStart{s.camera_from_start, s.theta};
    best_fit = refined;
    best_equations = s.equations;
  }
  s.facing->watch.NoteTrial(best.has_value());
  if (best) {
    s.theta_before = best->theta;  // the body is at rest
    fit = best_fit;
  }
  const TreeStart& taken = best ? *best : current;
  s.camera_from_start = taken.camera_from_start;
  s.theta = taken.theta;
  s.equations = best ? best_equations : current_equations;
  s.tree.Pose(s.camera_from_start, s.theta, s.pose);
  s.clock.Lap(TimedStep::kSolve);
  return fit;
}

// Tries to put single limbs where the frame shows something that the model does not explain. The
// refined pose that overlaps best with the frame is kept if it is clearly better than `fit`'s.
Dynamic::FrameFit Dynamic::TakeFoundLimb(const DepthFrame& frame, FrameFit fit) {
  Session& s = *session_;
  if (IsLost(fit)) return fit;
  double best_overlap = LimbOverlap(frame.depth);
  const BoneTransforms bones = BonesOf(s.pose);
  const std::vector<BodyPose> hypotheses = s.limbs->search.Hypotheses(
      frame.depth, s.limbs->meter.points(), s.limbs->meter.unexplained(), BodyPoseOf(bones));
  s.clock.Lap(TimedStep::kSolve);
  if (hypotheses.empty()) return fit;

  const TreeStart current{s.camera_from_start, s.theta};
  TreeStart best = current;
  PoseEquations best_equations = s.equations;
  for (const BodyPose& hypothesis : hypotheses) {
    const TreeStart start = Approached(s.tree, BonesOf(hypothesis), current);
    const FrameFit refined = Refine(start, settings_.pose.iterations);
    const double overlap = LimbOverlap(frame.depth);
    if (IsLost(refined) || overlap < best_overlap + settings_.limbs.margin) continue;
    best_overlap = overlap;
    best = {s.camera_from_start, s.theta};
    best_equations = s.equations;
    s.theta_before = best.theta;  // the body is at rest
    fit = refined;
  }
  s.camera_from_start = best.camera_from_start;
  s.theta = best.theta;
  s.equations = best_equations;
  s.tree.Pose(s.camera_from_start, s.theta, s.pose);
  s.clock.Lap(TimedStep::kSolve);
  return fit;
}

// Overlap of the current pose with the frame; the meter keeps which points are unexplained.
double Dynamic::LimbOverlap(const DepthImage& depth) {
  Session& s = *session_;
  s.fine.PoseVertices(s.pose, s.team, s.clock);
  const BodyAreas areas =
      s.limbs->meter.Measure(SubjectVertices(), BonesOf(s.pose), depth, AreaNearness(settings_));
  s.clock.Lap(TimedStep::kSolve);
  return areas.overlap();
}

// Iterates from a hypothesis; the session's pose is the one that is reached.
Dynamic::FrameFit Dynamic::Refine(const TreeStart& start, int limit) {
  Session& s = *session_;
  s.camera_from_start = start.camera_from_start;
  s.theta = start.theta;
  FrameFit fit;
  while (fit.iterations < limit && !fit.converged && fit.solved) IteratePose(limit, fit);
  s.tree.Pose(s.camera_from_start, s.theta, s.pose);
  return fit;
}

// Of the current pose, m².
double Dynamic::GapTo(const DepthImage& depth) {
  constexpr int kStride_px = 2;  // a mean over half of the rows and columns
  Session& s = *session_;
  s.fine.PoseVertices(s.pose, s.team, s.clock);
  const DepthImage& rendered = s.facing->rasterizer->Render(SubjectVertices(), s.facing->triangles);
  const double gap_m2 = SquaredDepthGap_m2(rendered, depth, kStride_px, settings_.max_depth_m);
  s.clock.Lap(TimedStep::kSolve);
  return gap_m2;
}

// One step of the damped least squares, from new associations.
void Dynamic::IteratePose(int limit, FrameFit& fit) {
  Session& s = *session_;
  const PoseSettings& settings = settings_.pose;
  const AssociationSettings& a = settings_.association;
  Level& level = s.pose_level();
  const AssociationLimits limits =
      LimitsOf(a.window_px, PoseCutoff(a, fit.iterations, limit), a.facing_cosine);
  s.tree.Pose(s.camera_from_start, s.theta, s.pose);
  level.Match(s.pose, limits, s.team, s.clock);
  fit.matched_share = std::max(fit.matched_share, level.MatchedShare());
  level.Assemble(s.tree, s.pose, s.team, s.equations, s.clock);
  const PoseStep step = s.solver.Step(
      s.tree, s.equations, s.all_joints,
      {settings.damping, settings.default_pose_weight, settings.freeze_below_share}, s.theta);
  s.clock.Lap(TimedStep::kSolve);
  ++fit.iterations;
  fit.condition = step.condition;
  fit.solved = step.solved;
  fit.converged = step.solved &&
                  step.rotation_rad < settings.rotation_step_deg * kRadiansPerDegree &&
                  step.translation_m < settings.translation_step_m;
  fit.energies[kDataTerm] = s.equations.energy;
  fit.energies[kDefaultPoseTerm] = step.default_pose_energy;
}

bool Dynamic::IsLost(const FrameFit& fit) const {
  return fit.matched_share < settings_.lost_below || !fit.solved;
}

void Dynamic::FitShape(bool is_first, FrameFit& fit) {
  Session& s = *session_;
  const ShapeSettings& settings = settings_.shape;
  const bool is_due = (settings_.mode == Mode::kFull && !IsLost(fit)) ||
                      (settings_.mode == Mode::kShapeMatch && is_first);
  if (!is_due) return;
  const ShapeWeights weights{static_cast<float>(settings.magnitude_weight),
                             static_cast<float>(settings.neighbor_weight)};
  const AssociationLimits limits = LimitsOf(settings_.association.window_px, settings.cutoff_m,
                                            settings_.association.facing_cosine);
  const int iterations = is_first ? settings.first_frame_iterations : settings.iterations;
  for (int i = 0; i < iterations; ++i) {
    s.fine.Match(s.pose, limits, s.team, s.clock);
    const ShapeEnergy energy =
        s.shape.Iterate(s.fine.observations, weights, s.team, s.fine.surface);
    fit.energies[kShapeDataTerm] = energy.data;
    fit.energies[kShapeMagnitudeTerm] = energy.magnitude;
    fit.energies[kShapeSmoothnessTerm] = energy.smoothness;
    s.clock.Lap(TimedStep::kShape);
  }
  s.normals.Update(s.team, s.fine.surface);
  s.RefreshCoarse();
  s.clock.Lap(TimedStep::kNormals);
}

// Of the last normal equations. A joint moves with all hinges and prismatic joints above it.
std::vector<Matrix3<double>> Dynamic::JointUnitCovariances(
    const FrameFit& fit, const std::vector<Vector3d>& joints) const {
  const Session& s = *session_;
  if (fit.iterations == 0 || !fit.solved) return {};
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(3 * kBoneCount, s.tree.joint_count());
  for (int bone = 0; bone < kBoneCount; ++bone) {
    for (const int k : s.tree.ChainOf(bone)) {
      const Twist& twist = s.pose.twists[k];
      motions.block<3, 1>(3 * bone, k) =
          twist.head<3>().cross(joints[bone] - s.pose.twist_origin) + twist.tail<3>();
    }
  }
  const PoseStepWeights weights{settings_.pose.damping, settings_.pose.default_pose_weight, 0.0};
  return UnitCovariances(s.solver.Curvature(s.tree, s.equations, weights), motions);
}

TrackResult Dynamic::Result(const FrameFit& fit) {
  Session& s = *session_;
  TrackResult result;
  ReportOutcome(fit, result);
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
  if (settings_.uncertainty.IsAsked())
    ReportUncertainty(JointUnitCovariances(fit, result.joints), {}, settings_.uncertainty, result);
  result.iterations = fit.iterations;
  result.condition = fit.condition;
  for (int k = 0; k < kEnergyTermCount; ++k)
    result.energies.push_back({kEnergyTermNames[k], fit.energies[k]});
  s.clock.Lap(TimedStep::kResult);
  result.step_ms = s.clock.times().Named();
  return result;
}

void Dynamic::ReportOutcome(const FrameFit& fit, TrackResult& result) const {
  if (fit.unfitted) {
    result.outcome = fit.unfitted->outcome;
    result.message = fit.unfitted->message;
  } else if (!session_->placed) {
    result.outcome = Outcome::kLost;
    result.message = session_->start_message;
  } else if (!fit.solved) {
    result.outcome = Outcome::kLost;
    result.message = "the normal equations could not be solved; the pose is carried over";
  } else if (IsLost(fit)) {
    result.outcome = Outcome::kLost;
    result.message = fmt::format(
        "{:.0f} % of the points found a vertex within {:g} m; pose and shape are carried over",
        100.0 * fit.matched_share, settings_.association.cutoff_m);
  } else if (session_->watch && session_->watch->verdict.is_lost()) {
    result.outcome = Outcome::kLost;
    result.message = session_->watch->verdict.message();
  } else if (fit.converged) {
    result.outcome = Outcome::kConverged;
  } else {
    result.outcome = Outcome::kIterationLimit;
    result.message = fmt::format("stopped after {} iterations", fit.iterations);
  }
}

}  // namespace vitruvia::dynamic
