#include "methods/skeleton_driven/skeleton_driven.h"

#include "core/error.h"
#include "learning/joints/joint_model.h"
#include "tracking/frame_checks.h"
#include "tracking/joint_observations.h"
#include "tracking/step_clock.h"

namespace vitruvia::skeleton_driven {
namespace {

enum class TimedStep { kFindJoints, kSolvePose, kMoveSurface, kCount };

const char* Name(TimedStep step) {
  switch (step) {
    case TimedStep::kFindJoints:
      return "find joints";
    case TimedStep::kSolvePose:
      return "solve pose";
    case TimedStep::kMoveSurface:
      return "move surface";
    case TimedStep::kCount:
      break;
  }
  return "";
}

class LearntFinder final : public JointFinder {
 public:
  explicit LearntFinder(const Settings& settings)
      : max_depth_m_(settings.max_depth_m),
        model_(Read(settings.detector.model)),
        detector_(model_, settings.detector.votes) {}

  GivenPoints Find(const DepthFrame& frame, const PinholeCamera& camera,
                   double size) const override {
    return detector_.Detect(frame.depth, camera, max_depth_m_, size);
  }

 private:
  static joints::JointModel Read(const std::filesystem::path& folder) {
    if (!std::filesystem::exists(folder / joints::kJointModelFile)) {
      throw ConfigError(
          fmt::format("detector.model: {} holds no joint model; make one: vitruvia learn joints "
                      "configs/joints/mannequin.json -o {}",
                      folder.string(), folder.string()));
    }
    return joints::ReadJointModel(folder);
  }

  double max_depth_m_;
  joints::JointModel model_;
  joints::JointDetector detector_;
};

class ObservedFinder final : public JointFinder {
 public:
  explicit ObservedFinder(const Settings& settings)
      : observations_(ReadStored<JointObservations>(settings.observations)) {}

  GivenPoints Find(const DepthFrame& frame, const PinholeCamera&, double) const override {
    return ObservedPoints(observations_, frame.index);
  }

 private:
  JointObservations observations_;
};

std::unique_ptr<JointFinder> MakeFinder(const Settings& settings) {
  if (settings.joints == JointSource::kDetector) return std::make_unique<LearntFinder>(settings);
  return std::make_unique<ObservedFinder>(settings);
}

}  // namespace

struct SkeletonDriven::Session {
  Session(const Subject& subject, const PinholeCamera& view, const Settings& settings)
      : camera(view),
        skeleton(subject.skeleton),
        rest(subject.rest.vertices),
        weights(skinning::HeatWeights(subject.rest, subject.skeleton, settings.weights)),
        inverse_kinematics(subject.skeleton, settings.pose),
        camera_from_rest(kBoneCount) {}

  PinholeCamera camera;
  Skeleton skeleton;
  std::vector<Vector3f> rest;
  SkinWeights weights;
  InverseKinematics inverse_kinematics;
  BoneTransforms camera_from_rest;  // of the last frame that was solved
  StepClock<TimedStep> clock;
};

SkeletonDriven::SkeletonDriven(const Settings& settings)
    : SkeletonDriven(settings, MakeFinder(settings)) {}

SkeletonDriven::SkeletonDriven(const Settings& settings, std::unique_ptr<JointFinder> joints)
    : settings_(settings), joints_(std::move(joints)) {}

SkeletonDriven::~SkeletonDriven() = default;

void SkeletonDriven::Start(const Subject& subject, const PinholeCamera& camera) {
  CheckBodyModel(subject, fmt::format("skeleton_driven cannot use subject {}", subject.name));
  session_ = std::make_unique<Session>(subject, camera, settings_);
}

TrackResult SkeletonDriven::TrackFrame(const DepthFrame& frame) {
  Require(session_ != nullptr, "TrackFrame called before Start");
  Session& s = *session_;
  CheckFrameSize(frame, s.camera);
  s.clock.Restart();
  const GivenPoints points = joints_->Find(frame, s.camera, SizeOf(s.skeleton));
  s.clock.Lap(TimedStep::kFindJoints);
  const std::optional<FoundPose> found = s.inverse_kinematics.Find(points);
  if (found) s.camera_from_rest = ToTransforms(s.skeleton, found->pose);
  s.clock.Lap(TimedStep::kSolvePose);

  TrackResult result;
  SkinLinear(s.rest, s.weights, s.camera_from_rest, result.vertices);
  s.clock.Lap(TimedStep::kMoveSurface);
  result.camera_from_rest = s.camera_from_rest;
  result.joints = PosedJoints(s.skeleton, s.camera_from_rest);
  result.step_ms = s.clock.times().Named();
  const FoundPose pose = found.value_or(FoundPose{});
  result.iterations = pose.iterations;
  result.energies = {{"points", pose.point_energy}, {"pose", pose.pose_energy}};
  if (!found) {
    result.outcome = Outcome::kNoData;
    result.message = "too few joints are found; the pose is carried over";
  } else if (pose.median_m > settings_.lost_above_m) {
    result.outcome = Outcome::kLost;
    result.message =
        fmt::format("the subject's skeleton misses the found joints by {:.0f} mm in the median",
                    1e3 * pose.median_m);
  } else if (pose.converged) {
    result.outcome = Outcome::kConverged;
  } else {
    result.outcome = Outcome::kIterationLimit;
    result.message = fmt::format("the pose still moves after {} steps", pose.iterations);
  }
  return result;
}

}  // namespace vitruvia::skeleton_driven
