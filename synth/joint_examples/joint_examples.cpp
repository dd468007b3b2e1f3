#include "synth/joint_examples/joint_examples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "body/anatomical_pose.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/worker_team.h"
#include "geometry/mesh_rasterizer.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "synth/bodies/mannequin.h"

namespace vitruvia {
namespace {

constexpr int kMostRejections = 200;    // of poses, one after the other
constexpr float kSeenWithin_m = 0.02f;  // of the depth, a vertex is seen

constexpr double kCalmReach = 0.3, kTrunkReach = 0.6;  // of a joint's range

// How far of the way from the neutral pose to a pose within the limits a joint goes.
double DrawReach(const RandomPoseSettings& settings, RandomStream& random) {
  const double reach = random.Uniform();
  return random.Uniform() < settings.calm_share ? kCalmReach * reach : reach;
}

double DrawAngle(const AngleInfo& angle, double limits_used, double reach, RandomStream& random) {
  const double middle = 0.5 * (angle.min_deg + angle.max_deg);
  const double half = 0.5 * limits_used * (angle.max_deg - angle.min_deg);
  return reach * random.Uniform(middle - half, middle + half);
}

AnatomicalPose DrawAngles(const RandomPoseSettings& settings, RandomStream& random) {
  AnatomicalPose pose;
  for (const JointInfo& joint : MidlineJoints()) {
    const double reach = kTrunkReach * DrawReach(settings, random);
    for (std::size_t a = 0; a < joint.angles.size(); ++a) {
      pose.midline_deg[joint.first + a] =
          DrawAngle(joint.angles[a], settings.limits_used, reach, random);
    }
  }
  for (auto& side : pose.sides_deg) {
    for (const JointInfo& joint : SideJoints()) {
      const double reach = DrawReach(settings, random);
      for (std::size_t a = 0; a < joint.angles.size(); ++a) {
        side[joint.first + a] = DrawAngle(joint.angles[a], settings.limits_used, reach, random);
      }
    }
  }
  return pose;
}

double DistanceFromSegment(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double share = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (a + share * along - point).norm();
}

// Whether elbows, hands and finger tips are clear of the trunk, and knees and ankles of each other.
bool IsClear(const BodyPointPositions& points, const RandomPoseSettings& settings) {
  const auto at = [&](BoneId bone) { return points[static_cast<std::size_t>(bone)]; };
  using enum BoneId;
  for (const BoneId bone : {kLeftForearm, kRightForearm, kLeftHand, kRightHand}) {
    const double distance_m = std::min(DistanceFromSegment(at(bone), at(kPelvis), at(kChest)),
                                       DistanceFromSegment(at(bone), at(kChest), at(kHead)));
    if (distance_m < settings.trunk_clearance_m) return false;
  }
  for (const BoneId hand : {kLeftHand, kRightHand}) {
    for (const auto& [knee, ankle, hip] : {std::array{kLeftShin, kLeftFoot, kLeftThigh},
                                           std::array{kRightShin, kRightFoot, kRightThigh}}) {
      if (DistanceFromSegment(at(hand), at(hip), at(knee)) < settings.leg_clearance_m) return false;
      if (DistanceFromSegment(at(hand), at(knee), at(ankle)) < settings.leg_clearance_m)
        return false;
    }
  }
  return DistanceFromSegment(at(kLeftFoot), at(kRightShin), at(kRightFoot)) >=
             settings.leg_clearance_m &&
         DistanceFromSegment(at(kRightFoot), at(kLeftShin), at(kLeftFoot)) >=
             settings.leg_clearance_m &&
         (at(kLeftShin) - at(kRightShin)).norm() >= settings.leg_clearance_m;
}

// Where an upright camera stands before a person whose feet are near the origin.
Rigidd DrawCamera(const JointExampleSettings& settings, RandomStream& random) {
  const Vector3d position(random.Uniform(-settings.off_centre_m, settings.off_centre_m),
                          random.Uniform(settings.camera_height_m[0], settings.camera_height_m[1]),
                          random.Uniform(settings.distance_m[0], settings.distance_m[1]));
  const Matrix3<double> rotation = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  return {rotation, -(rotation * position)};
}

// The body as it stands before the camera, its lowest point on the floor.
struct PosedExample {
  std::vector<Vector3f> vertices;
  BodyPointPositions points;
};

PosedExample PoseExample(const JointExampleSettings& settings, const BodyModel& body,
                         RandomStream& random) {
  const BoneTransforms bones =
      ForwardKinematics(body.skeleton, DrawClearPose(settings.poses, body.skeleton, random));
  PosedExample posed;
  SkinDualQuaternion(body.rest.vertices, body.weights, bones, posed.vertices);
  posed.points = PosedPoints(body.skeleton, bones);
  float lowest = std::numeric_limits<float>::infinity();
  for (const Vector3f& v : posed.vertices) lowest = std::min(lowest, v.y());
  const Rigidd camera_from_subject =
      DrawCamera(settings, random) * Rigidd{Matrix3<double>::Identity(), {0.0, -lowest, 0.0}};
  const Rigidf as_float = camera_from_subject.Cast<float>();
  for (Vector3f& v : posed.vertices) v = as_float * v;
  for (Vector3d& p : posed.points) p = camera_from_subject * p;
  return posed;
}

joints::CroppedDepth Cropped(const DepthImage& depth, double size) {
  int left = depth.width(), right = -1, top = depth.height(), bottom = -1;
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (!(depth(u, v) > 0.0f)) continue;
      left = std::min(left, u);
      right = std::max(right, u);
      top = std::min(top, v);
      bottom = std::max(bottom, v);
    }
  }
  if (right < 0) return {};
  joints::CroppedDepth cropped{{right - left + 1, bottom - top + 1}, left, top};
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) {
      cropped.depth_mm(u - left, v - top) =
          static_cast<std::uint16_t>(std::clamp(std::lround(1e3 * depth(u, v) / size), 0L, 65535L));
    }
  }
  return cropped;
}

// Pixels onto which vertices fall that the camera sees, each with its vertex' heaviest bone.
std::vector<joints::LabelledPixel> Labels(const PosedExample& posed, const SkinWeights& weights,
                                          const DepthImage& true_depth,
                                          const PinholeCamera& camera) {
  std::vector<joints::LabelledPixel> labels;
  for (std::size_t v = 0; v < posed.vertices.size(); ++v) {
    const Vector3f& vertex = posed.vertices[v];
    const std::optional<Pixel> pixel = camera.PixelOf(vertex);
    if (!pixel || std::abs(vertex.z() - true_depth(pixel->u, pixel->v)) > kSeenWithin_m) continue;
    labels.push_back({static_cast<std::uint16_t>(pixel->u), static_cast<std::uint16_t>(pixel->v),
                      weights.bones[v][0]});
  }
  return labels;
}

DepthImage MeasureExample(const JointExampleSettings& settings, const DepthImage& true_depth,
                          RandomStream& random) {
  if (random.Uniform() < settings.ideal_share) return true_depth;
  return Measure(true_depth, settings.camera, settings.sensor, random);
}

BodyModel MakePerson(const JointExampleSettings& settings, Population& population, int number) {
  RefinementSettings refinement = settings.mesh;
  refinement.weight_diffusion = settings.weight_diffusion;
  return Refine(population.Subject(number), refinement);
}

}  // namespace

void RandomPoseSettings::Describe(Fields& f) {
  f.Number("limits_used", limits_used,
           {.meaning = "share of each joint's range, centred, from which angles are drawn",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("calm_share", calm_share,
           {.meaning = "share of the joints that stay near the standing pose",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("trunk_clearance_m", trunk_clearance_m,
           {.meaning = "elbows and wrists are at least this far from the spine",
            .unit = "m",
            .min = 0.0,
            .max = 0.5,
            .origin = Origin::kGuessed,
            .source = "half a chest's depth and an arm's radius"});
  f.Number("leg_clearance_m", leg_clearance_m,
           {.meaning = "shins are at least this far from each other, and hands from the legs",
            .unit = "m",
            .min = 0.0,
            .max = 0.5,
            .origin = Origin::kGuessed});
  f.Number("heading_deviation_deg", heading_deviation_deg,
           {.meaning = "standard deviation of the direction that the person faces, round the "
                       "camera's",
            .unit = "deg",
            .min = 0.0,
            .max = 360.0,
            .origin = Origin::kGuessed});
  f.Number("tilt_deviation_deg", tilt_deviation_deg,
           {.meaning = "standard deviation of the pelvis' tilts forward and sideways",
            .unit = "deg",
            .min = 0.0,
            .max = 180.0,
            .origin = Origin::kGuessed});
}

JointExampleSettings::JointExampleSettings() {
  population.subjects = 60;
  population.seed = 17;
  mesh.subdivisions = kMannequinSteps;
  sensor.model = SensorModel::kKinectV1;
}

void JointExampleSettings::Describe(Fields& f) {
  f.Section("population", population, {.meaning = "the people"});
  f.Section("mesh", mesh, {.meaning = "the surface that is rendered"});
  f.Integer("weight_diffusion", weight_diffusion,
            {.meaning = "averaging steps by which the deforming weights differ from the rig's",
             .min = 0,
             .max = 100});
  f.Integer("images", images,
            {.meaning = "number of depth images, shared evenly by the people",
             .min = 1,
             .max = 10000000,
             .origin = Origin::kGuessed});
  f.Section("poses", poses, {.meaning = "the poses"});
  f.Section("camera", camera, {.meaning = "the camera"});
  f.Numbers("distance_m", distance_m,
            {.meaning = "least and largest distance of the camera from the person",
             .unit = "m",
             .min = 0.5,
             .max = 8.0});
  f.Numbers("camera_height_m", camera_height_m,
            {.meaning = "least and largest height of the camera above the floor",
             .unit = "m",
             .min = 0.0,
             .max = 4.0});
  f.Number("off_centre_m", off_centre_m,
           {.meaning = "maximum lateral displacement of the camera to either side",
            .unit = "m",
            .min = 0.0,
            .max = 4.0});
  f.Section("sensor", sensor, {.meaning = "the sensor"});
  f.Number("ideal_share", ideal_share,
           {.meaning = "share of the images that are true depth, without the sensor's noise",
            .min = 0.0,
            .max = 1.0});
  f.Integer("seed", seed, {.meaning = "seed of all random choices", .min = 0});
}

std::string JointExampleSettings::Problem() const {
  if (distance_m[0] > distance_m[1] || camera_height_m[0] > camera_height_m[1]) {
    return "distance_m and camera_height_m: expected the smaller number first";
  }
  return "";
}

JointPose DrawClearPose(const RandomPoseSettings& settings, const Skeleton& skeleton,
                        RandomStream& random) {
  JointPose pose = JointPose::Rest(skeleton);
  for (int i = 0; i < kMostRejections; ++i) {
    SetRotations(DrawAngles(settings, random), pose);
    const Vector3d turn(random.Normal(0.0, settings.tilt_deviation_deg), 0.0,
                        random.Normal(0.0, settings.tilt_deviation_deg));
    const double heading_deg = random.Normal(0.0, settings.heading_deviation_deg);
    pose.local_rotations[0] = ExpSo3<double>({0.0, kRadiansPerDegree * heading_deg, 0.0}) *
                              ExpSo3<double>(kRadiansPerDegree * turn);
    if (IsClear(PosedPoints(skeleton, ForwardKinematics(skeleton, pose)), settings)) return pose;
  }
  throw ConfigError(fmt::format(
      "poses: {} poses one after the other bring limbs too near to each other; expected smaller "
      "trunk_clearance_m and leg_clearance_m",
      kMostRejections));
}

std::vector<joints::JointExample> MakeJointExamples(const JointExampleSettings& settings,
                                                    int threads) {
  Population population(settings.population);
  const int people = std::min(settings.population.subjects, settings.images);
  std::vector<joints::JointExample> examples(static_cast<std::size_t>(settings.images));
  WorkerTeam team(threads);
  Progress progress("depth images", settings.images);
  for (int person = 0; person < people; ++person) {
    const BodyModel body = MakePerson(settings, population, person);
    const double size = SizeOf(body.skeleton);
    const int count = (settings.images - person + people - 1) / people;
    std::mutex progress_mutex;
    team.For(count, [&](int begin, int end) {
      const std::unique_ptr<MeshRasterizer> rasterizer =
          MakeRasterizer(Rasterizer::kFrontFaces, settings.camera);
      for (int k = begin; k < end; ++k) {
        ThrowIfInterrupted();
        const int number = person + k * people;
        RandomStream random(static_cast<std::uint64_t>(settings.seed),
                            fmt::format("joint example {}", number));
        const PosedExample posed = PoseExample(settings, body, random);
        const DepthImage& true_depth = rasterizer->Render(posed.vertices, body.rest.triangles);
        BodyPointPositions points = posed.points;
        for (Vector3d& p : points) p /= size;
        examples[static_cast<std::size_t>(number)] = {
            Cropped(MeasureExample(settings, true_depth, random), size),
            Labels(posed, body.weights, true_depth, settings.camera), points};
        const std::lock_guard lock(progress_mutex);
        progress.Advance();
      }
    });
  }
  return examples;
}

}  // namespace vitruvia
