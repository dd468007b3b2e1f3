#include "support/start_trials.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "core/random.h"
#include "geometry/zbuffer.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "synth/bodies/body_source.h"
#include "synth/sensor/sensor.h"

namespace vitruvia {
namespace {

using Side2 = std::array<double, kSideAngleCount>;

StartPerson Person(const std::string& name, Sex sex, double height_m, double weight_kg) {
  BodySettings settings;
  settings.sex = sex;
  settings.height_m = height_m;
  settings.weight_kg = weight_kg;
  const ControlBody body = MakeControlBody(settings);
  return {name, Refine(body, {.subdivisions = 2, .target_vertices = 3000}),
          Refine(body, {.subdivisions = 2, .weight_diffusion = 4})};
}

AnatomicalPose Posture(double spine_deg, const Side2& left, const Side2& right) {
  AnatomicalPose pose;
  pose.midline_deg[kSpineFlexion] = spine_deg;
  pose.sides_deg = {left, right};
  return pose;
}

// Every angle deviates a little, within its limits.
AnatomicalPose Deviating(AnatomicalPose pose, RandomStream& random) {
  constexpr double kDeviation_deg = 8.0;
  const auto deviate = [&](double& angle, const AngleInfo& info) {
    angle = std::clamp(angle + random.Normal(0.0, kDeviation_deg), info.min_deg, info.max_deg);
  };
  for (const JointInfo& joint : MidlineJoints()) {
    for (std::size_t a = 0; a < joint.angles.size(); ++a) {
      deviate(pose.midline_deg[static_cast<std::size_t>(joint.first) + a], joint.angles[a]);
    }
  }
  for (auto& side : pose.sides_deg) {
    for (const JointInfo& joint : SideJoints()) {
      for (std::size_t a = 0; a < joint.angles.size(); ++a) {
        deviate(side[static_cast<std::size_t>(joint.first) + a], joint.angles[a]);
      }
    }
  }
  return pose;
}

// A Kinect v1's image, the camera level.
const PinholeCamera& Camera() {
  static const PinholeCamera camera;
  return camera;
}

// Puts the person before the camera so that all of it is in the image.
BoneTransforms CameraFromRest(const StartTrial& trial, const BodyModel& body,
                              const AnatomicalPose& posture, RandomStream& random) {
  constexpr double kNearest_m = 2.0, kFarthest_m = 3.5, kHeadingSpread_deg = 15.0;
  JointPose pose = JointPose::Rest(body.skeleton);
  SetRotations(Deviating(posture, random), pose);
  const Matrix3<double> facing = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  const double heading_deg =
      trial.heading_deg + random.Uniform(-kHeadingSpread_deg, kHeadingSpread_deg);
  pose.local_rotations[0] = facing * ExpSo3<double>({0.0, heading_deg * kRadiansPerDegree, 0.0});
  BoneTransforms bones = ForwardKinematics(body.skeleton, pose);
  std::vector<Vector3f> posed;
  SkinDualQuaternion(body.rest.vertices, body.weights, bones, posed);
  const Eigen::AlignedBox3f box = BoundingBox(posed);
  const Eigen::Vector3d size = box.sizes().cast<double>();
  const double fits_m = 0.5 * size.z() + 1.1 * std::max(size.y() * Camera().fy / Camera().height,
                                                        size.x() * Camera().fx / Camera().width);
  const double distance_m = std::max(random.Uniform(kNearest_m, kFarthest_m), fits_m);
  const Vector3d shift = Vector3d(0.0, 0.0, distance_m) - box.center().cast<double>();
  for (Rigidd& bone : bones) bone.translation += shift;
  return bones;
}

double MeanError(const std::vector<Vector3d>& joints, const std::vector<Vector3d>& truth) {
  double sum = 0.0;
  for (std::size_t j = 0; j < truth.size(); ++j) sum += (joints[j] - truth[j]).norm();
  return sum / static_cast<double>(truth.size());
}

Vector3d LeftFromRight(const std::vector<Vector3d>& joints) {
  const auto at = [&](BoneId bone) { return joints[static_cast<std::size_t>(bone)]; };
  return at(BoneId::kLeftUpperArm) - at(BoneId::kRightUpperArm) + at(BoneId::kLeftThigh) -
         at(BoneId::kRightThigh);
}

}  // namespace

std::vector<StartPerson> StartPeople() {
  return {Person("man", Sex::kMale, 1.76, 78.0), Person("tall man", Sex::kMale, 1.94, 92.0),
          Person("woman", Sex::kFemale, 1.63, 62.0),
          Person("heavy woman", Sex::kFemale, 1.58, 84.0),
          Person("child", Sex::kFemale, 1.0, 16.0)};
}

std::vector<StartPosture> StartPostures() {
  //                         shoulder       elbow      wrist  hip          knee ankle
  const Side2 hanging{{5, 12, 0, 12, 20, 0, 0, 2, 3, 0, 3, 0, 0}};
  const Side2 a_pose{{0, 40, 0, 10, 0, 0, 0, 0, 10, 0, 2, 0, 0}};
  const Side2 t_pose{{0, 88, 0, 5, 0, 0, 0, 0, 3, 0, 2, 0, 0}};
  const Side2 step_left{{-18, 10, 0, 20, 20, 0, 0, 28, 2, 0, 12, 5, 0}};
  const Side2 step_right{{22, 10, 0, 25, 20, 0, 0, -14, 2, 0, 22, -5, 0}};
  const Side2 seated{{30, 12, 0, 55, 20, 0, 0, 80, 8, 0, 80, 0, 0}};
  const Side2 raised{{15, 14, 20, 85, 0, 0, 0, 2, 4, 0, 3, 0, 0}};
  const Side2 up{{100, 100, 0, 20, 0, 0, 0, 2, 4, 0, 3, 0, 0}};
  const Side2 forward{{75, 10, 0, 15, 20, 0, 0, 2, 4, 0, 3, 0, 0}};
  const Side2 akimbo{{-10, 45, 40, 85, 30, 0, 0, 2, 6, 0, 3, 0, 0}};
  const Side2 squat{{60, 15, 0, 30, 20, 0, 0, 70, 15, 0, 85, 12, 0}};
  const Side2 waving{{40, 95, 0, 70, 0, 0, 0, 2, 4, 0, 3, 0, 0}};
  return {{"arms down", Posture(2, hanging, hanging)},
          {"A-pose", Posture(0, a_pose, a_pose)},
          {"T-pose", Posture(0, t_pose, t_pose)},
          {"walking", Posture(4, step_left, step_right)},
          {"sitting", Posture(5, seated, seated)},
          {"forearms raised", Posture(2, raised, raised)},
          {"left arm up", Posture(2, up, hanging)},
          {"arms forward", Posture(3, forward, forward)},
          {"right hand at the hip, left waving", Posture(2, waving, akimbo)},
          {"squatting", Posture(25, squat, squat)}};
}

std::vector<StartTrial> AllStartTrials() {
  std::vector<StartTrial> trials;
  constexpr int kPeople = 5, kPostures = 10, kHeadings = 4;
  for (int person = 0; person < kPeople; ++person) {
    for (int posture = 0; posture < kPostures; ++posture) {
      for (int heading = 0; heading < kHeadings; ++heading) {
        trials.push_back({person, posture, 90.0 * heading, static_cast<int>(trials.size()),
                          (person + posture + heading) % 2 == 0});
      }
    }
  }
  return trials;
}

StartResult RunStartTrial(const StartTrial& trial, const StartPerson& person,
                          const StartPosture& posture, Tracker& tracker, int frames) {
  RandomStream random(static_cast<std::uint64_t>(trial.seed), "start");
  const BoneTransforms bones = CameraFromRest(trial, person.truth, posture.pose, random);
  const std::vector<Vector3d> true_joints = PosedJoints(person.truth.skeleton, bones);
  std::vector<Vector3f> surface;
  SkinDualQuaternion(person.truth.rest.vertices, person.truth.weights, bones, surface);
  ZBuffer zbuffer(Camera());
  const DepthImage& depth = zbuffer.Render(surface, person.truth.rest.triangles);
  SensorSettings sensor;
  sensor.model = SensorModel::kKinectV1;

  tracker.Start(person.subject, Camera());
  StartResult result;
  for (int f = 0; f < frames; ++f) {
    const DepthFrame frame{f, f / 30.0, Measure(depth, Camera(), sensor, random)};
    const std::clock_t start = std::clock();
    const TrackResult tracked = tracker.TrackFrame(frame);
    const std::clock_t end = std::clock();
    result.last_error_m = MeanError(tracked.joints, true_joints);
    if (f > 0) continue;
    result.first_ms = 1e3 * static_cast<double>(end - start) / CLOCKS_PER_SEC;
    result.found = !IsFailure(tracked.outcome);
    result.message = tracked.message;
    result.first_error_m = result.last_error_m;
    result.swapped = LeftFromRight(tracked.joints).dot(LeftFromRight(true_joints)) < 0.0;
  }
  return result;
}

}  // namespace vitruvia
