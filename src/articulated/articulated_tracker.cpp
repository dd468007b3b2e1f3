#include "articulated/articulated_tracker.h"

#include <fmt/format.h>

#include "articulated/pose_fitter.h"
#include "core/error.h"
#include "fitting/state_step.h"
#include "geometry/point_sets.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "tracking/frame_checks.h"
#include "tracking/loss_detector.h"
#include "tracking/pose_memory.h"
#include "tracking/pose_search.h"

namespace vitruvia::articulated {
namespace {

BodyState RestState(const Skeleton& skeleton, const Rigidd& camera_from_subject) {
  AnatomicalPose pose;
  for (auto& side : pose.sides_deg) side[kShoulderAbduction] = 90.0;
  BodyState state;
  state.rotation = camera_from_subject.rotation;
  state.pelvis_position = camera_from_subject * skeleton.joints[0];
  state.angles_deg = AnglesOf(pose);
  return state;
}

// Predicts the next state by adding a share of the last change.
BodyState Predicted(const BodyState& last, const BodyState& before, double share) {
  Eigen::VectorXd step(kParameterCount);
  const Matrix3<double> turn = last.rotation * before.rotation.transpose();
  step.segment<3>(PosedBody::kRotation) = LogSo3<double>(turn);
  step.segment<3>(PosedBody::kPosition) = last.pelvis_position - before.pelvis_position;
  step.segment<kAngleCount>(PosedBody::kAngles) =
      kRadiansPerDegree * (last.angles_deg - before.angles_deg);
  return Moved(last, share * step);
}

double MeanAngle(const BodyState& a, const BodyState& b) {
  return (a.angles_deg - b.angles_deg).cwiseAbs().mean();
}

}  // namespace

struct ArticulatedTracker::Ending {
  Outcome outcome;
  std::string message;
};

struct ArticulatedTracker::Session {
  Session(const Subject& with, const PinholeCamera& view, const CommonSettings& chosen)
      : settings(chosen),
        subject(with),
        camera(view),
        body(RigidShape(with, chosen.surface_vertices)),
        team(chosen.threads),
        memory(chosen.recovery.num_remembered, chosen.recovery.min_pose_distance_deg, MeanAngle),
        loss_detector(chosen.recovery) {
    if (chosen.start == vitruvia::Start::kSearch) {
      start_search.emplace(with, view, chosen.max_depth_m, chosen.start_search);
    }
  }

  void Take(std::unique_ptr<DataTerm> data_term) {
    term = std::move(data_term);
    fitter.emplace(body, camera, settings, *term);
  }

  TrackResult Track(const DepthFrame& frame);
  void FindFirstState(const Observation& observation, const KnownJoints& known);
  PoseFitting Better(const Observation& observation, PoseFitting fit, bool is_first);
  std::optional<PoseFitting> Search(const Observation& observation, const PoseFitting& current);
  Ending EndingOf(const PoseFitting& fit) const;
  TrackResult CarryOver(Ending ending);
  TrackResult Result(const PoseFitting& fit, const BoneTransforms& camera_from_rest, Ending ending);

  CommonSettings settings;
  Subject subject;
  PinholeCamera camera;
  ShapedBody body;
  std::unique_ptr<DataTerm> term;
  std::optional<PoseFitter> fitter;
  WorkerTeam team;
  PoseMemory<BodyState> memory;
  LossDetector loss_detector;
  std::optional<StartSearch> start_search;
  std::string start_message;                   // of the last search for the first pose
  std::optional<BodyState> last, before_last;  // from the first frame with measurements on
  PointCloud cloud;
  Clock clock;
};

ArticulatedTracker::ArticulatedTracker(const char* name, const CommonSettings& settings)
    : name_(name), settings_(settings) {}

ArticulatedTracker::~ArticulatedTracker() = default;

void ArticulatedTracker::Start(const Subject& subject, const PinholeCamera& camera) {
  CheckBodyModel(subject, fmt::format("{} cannot use subject {}", name_, subject.name));
  session_ = std::make_unique<Session>(subject, camera, settings_);
  session_->Take(MakeDataTerm(session_->subject, session_->body, camera));
}

TrackResult ArticulatedTracker::TrackFrame(const DepthFrame& frame) {
  Require(session_ != nullptr, "TrackFrame called before Start");
  return session_->Track(frame);
}

TrackResult ArticulatedTracker::Session::Track(const DepthFrame& frame) {
  CheckFrameSize(frame, camera);
  clock.Restart();
  CloudFromDepth(frame.depth, camera, settings.stride_px, static_cast<float>(settings.max_depth_m),
                 cloud);
  if (cloud.points.empty()) {
    return CarryOver({Outcome::kNoData, kNoMeasurement});
  }
  const Observation observation{&frame.depth, &cloud};
  term->Observe(observation);
  clock.Lap(TimedStep::kObserve);
  const bool is_first = !last;
  if (is_first) FindFirstState(observation, frame.known);
  if (!last) return CarryOver({Outcome::kLost, start_message});

  const StoppingSettings& stopping = settings.stopping;
  PoseFitting fit =
      fitter->Fit(observation, Predicted(*last, *before_last, settings.prediction.velocity_share),
                  is_first ? stopping.first_frame_iterations : stopping.iterations, team, clock);
  fit = Better(observation, std::move(fit), is_first);
  Ending ending = EndingOf(fit);
  // The first frame and lost frames have no velocity.
  before_last = is_first || IsFailure(ending.outcome) ? fit.state : *last;
  last = fit.state;
  if (is_first && start_search) ending.message = WithStart(start_message, ending.message);
  return Result(fit, WorldFromRest(body, fit.state), std::move(ending));
}

// Leaves `last` empty if a search does not find the subject.
void ArticulatedTracker::Session::FindFirstState(const Observation& observation,
                                                 const KnownJoints& known) {
  constexpr double kVisibleWithin_m = 0.01;
  if (start_search) {
    const FoundStart found = start_search->Find(*observation.depth, known);
    start_message = found.message;
    if (found.found) last = found.state;
  } else {
    const std::unique_ptr<MeshRasterizer> rasterizer =
        MakeRasterizer(Rasterizer::kFrontFaces, camera);
    last = RestState(subject.skeleton,
                     PlaceRestPose({body.mean, body.triangles}, cloud, camera, kVisibleWithin_m,
                                   settings.placement, *rasterizer));
  }
  before_last = last;
  clock.Lap(TimedStep::kRecover);
}

// Searches other poses when agreement has been low for long enough.
PoseFitting ArticulatedTracker::Session::Better(const Observation& observation, PoseFitting fit,
                                                bool is_first) {
  const FrameVerdict verdict = loss_detector.Assess(fit.agreement);
  if (is_first || verdict == FrameVerdict::kAgrees) memory.Remember(fit.state);
  if (verdict != FrameVerdict::kSearch) return fit;
  std::optional<PoseFitting> found = Search(observation, fit);
  clock.Lap(TimedStep::kRecover);
  if (!found) return fit;
  loss_detector.NoteFound(found->agreement);
  last = found->state;
  return *std::move(found);
}

// Hypotheses are the remembered poses and the current one, each with all HypothesisRotations(),
// with the visible surface's mean at the cloud's mean. The best is returned if it agrees clearly
// better.
std::optional<PoseFitting> ArticulatedTracker::Session::Search(const Observation& observation,
                                                               const PoseFitting& current) {
  struct Tester {
    Session& session;
    const Observation& observation;
    Clock clock{};  // a search is one step of the frame

    Agreement Compare(const BodyState& state) {
      return session.fitter->Compare(observation, state);
    }
    PoseFitting Refine(const BodyState& state) {
      return session.fitter->Fit(observation, state,
                                 session.settings.stopping.first_frame_iterations, session.team,
                                 clock);
    }
  };
  std::vector<BodyState> seeds = memory.poses(), hypotheses;
  seeds.push_back(current.state);
  const Vector3d center = Centroid(cloud.points);
  for (const BodyState& seed : seeds) {
    for (const Matrix3<double>& rotation : HypothesisRotations()) {
      BodyState turned = seed;
      turned.rotation = rotation * seed.rotation;
      hypotheses.push_back(fitter->Centered(std::move(turned), center));
    }
  }
  Tester tester{*this, observation};
  PoseFitting best = FindBestPose(hypotheses, settings.recovery.num_refined, tester);
  if (!IsClearlyBetter(best.agreement, current.agreement, settings.recovery.margin)) return {};
  return best;
}

ArticulatedTracker::Ending ArticulatedTracker::Session::EndingOf(const PoseFitting& fit) const {
  if (!fit.solved) {
    return {Outcome::kLost,
            "the normal equations have no solution; the pose is the one before the step"};
  }
  if (fit.agreement.presence() < settings.lost_below || loss_detector.is_lost()) {
    return {Outcome::kLost, loss_detector.MessageOf(fit.agreement)};
  }
  if (fit.converged) return {Outcome::kConverged, ""};
  return {Outcome::kIterationLimit, fmt::format("stopped after {} iterations", fit.iterations)};
}

// Result of a frame that cannot be fitted: the last pose, or the rest pose at the camera if no
// frame was fitted before.
TrackResult ArticulatedTracker::Session::CarryOver(Ending ending) {
  loss_detector.NoteEmptyFrame();
  before_last = last;
  return Result({}, last ? WorldFromRest(body, *last) : BoneTransforms(kBoneCount),
                std::move(ending));
}

TrackResult ArticulatedTracker::Session::Result(const PoseFitting& fit,
                                                const BoneTransforms& camera_from_rest,
                                                Ending ending) {
  TrackResult result;
  result.outcome = ending.outcome;
  result.message = std::move(ending.message);
  SkinLinear(subject.rest.vertices, subject.weights, camera_from_rest, result.vertices);
  result.joints = PosedJoints(subject.skeleton, camera_from_rest);
  result.camera_from_rest = camera_from_rest;
  result.iterations = fit.iterations;
  result.energies = term->Energies();
  result.energies.push_back({"prediction", fit.prior_energy});
  clock.Lap(TimedStep::kSurface);
  result.step_ms = clock.times().Named();
  return result;
}

}  // namespace vitruvia::articulated
