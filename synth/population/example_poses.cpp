#include "synth/population/example_poses.h"

#include <cmath>
#include <numbers>

#include "body/anatomical_pose.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "synth/motions/motion.h"

namespace vitruvia {
namespace {

double DrawAngle(const AngleInfo& angle, double limits_used, RandomStream& random) {
  const double middle = 0.5 * (angle.min_deg + angle.max_deg);
  const double half = 0.5 * limits_used * (angle.max_deg - angle.min_deg);
  return random.Uniform(middle - half, middle + half);
}

JointPose DrawWithinLimits(double limits_used, const Skeleton& skeleton, RandomStream& random) {
  AnatomicalPose angles;
  for (const JointInfo& joint : MidlineJoints()) {
    for (std::size_t a = 0; a < joint.angles.size(); ++a) {
      angles.midline_deg[joint.first + a] = DrawAngle(joint.angles[a], limits_used, random);
    }
  }
  for (auto& side : angles.sides_deg) {
    for (const JointInfo& joint : SideJoints()) {
      for (std::size_t a = 0; a < joint.angles.size(); ++a) {
        side[joint.first + a] = DrawAngle(joint.angles[a], limits_used, random);
      }
    }
  }
  JointPose pose = JointPose::Rest(skeleton);
  SetRotations(angles, pose);
  return pose;
}

constexpr std::array kBulgingBones{BoneId::kLeftForearm, BoneId::kRightForearm, BoneId::kLeftShin,
                                   BoneId::kRightShin};

double RotationAngle(const Matrix3<double>& rotation) {
  return Eigen::AngleAxisd(rotation).angle();
}

// Outward displacement of each vertex: flesh that gives way where a limb folds.
std::vector<float> Bulges(const ExamplePoseSettings& settings, const BodyModel& body,
                          const JointPose& pose) {
  std::vector<float> outwards(body.rest.vertices.size(), 0.0f);
  for (const BoneId bone : kBulgingBones) {
    const auto b = static_cast<std::size_t>(bone);
    const double bend = RotationAngle(pose.local_rotations[b]) / (0.5 * std::numbers::pi);
    const Vector3f joint = body.skeleton.joints[b].cast<float>();
    const auto amplitude = static_cast<float>(settings.bulge_m * bend);
    const auto reach = static_cast<float>(settings.bulge_reach_m);
    for (std::size_t v = 0; v < outwards.size(); ++v) {
      const float distance = (body.rest.vertices[v] - joint).norm() / reach;
      outwards[v] += amplitude * std::exp(-0.5f * distance * distance);
    }
  }
  return outwards;
}

}  // namespace

void ExamplePoseSettings::Describe(Fields& f) {
  f.Integer("poses", poses,
            {.meaning = "number of poses of each subject that has pose examples",
             .min = 1,
             .max = 10000,
             .origin = Origin::kPaper,
             .source = "paper A, sec. 4: 70 poses"});
  f.Files("motions", motions, {.meaning = "key-frame motions that poses are taken from"});
  f.Number("motion_share", motion_share,
           {.meaning = "share of the poses taken from motions, where there are any; the others are "
                       "drawn evenly within the joints' limits",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("limits_used", limits_used,
           {.meaning = "share of each joint's range, centred, from which angles are drawn",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kTuned,
            .source = "weights learnt at 0.6 cost figure 11's fitted subject 5 % more error"});
  f.Number("bulge_m", bulge_m,
           {.meaning = "height of the bulge of flesh at an elbow or knee bent by a right angle",
            .unit = "m",
            .min = 0.0,
            .max = 0.1,
            .origin = Origin::kGuessed});
  f.Number("bulge_reach_m", bulge_reach_m,
           {.meaning = "standard deviation of a bulge round its joint",
            .unit = "m",
            .min = 0.005,
            .max = 0.5,
            .origin = Origin::kGuessed});
  f.Integer("weight_diffusion", weight_diffusion,
            {.meaning = "averaging steps by which the deforming weights differ from the rig's",
             .min = 0,
             .max = 100,
             .origin = Origin::kGuessed});
  f.Number("noise_m", noise_m,
           {.meaning = "standard deviation of noise on every coordinate",
            .unit = "m",
            .min = 0.0,
            .max = 0.1});
}

std::vector<JointPose> DrawPoses(const ExamplePoseSettings& settings, const Skeleton& skeleton,
                                 RandomStream& random) {
  std::vector<std::unique_ptr<Motion>> motions;
  for (const std::filesystem::path& file : settings.motions) {
    MotionSettings motion;
    motion.file = file;
    motion.rest_s = motion.blend_s = 0.0;
    motions.push_back(LoadMotion(motion, skeleton));
  }
  const int from_motions =
      motions.empty() ? 0 : static_cast<int>(std::lround(settings.motion_share * settings.poses));
  std::vector<JointPose> poses;
  for (int i = 0; i < settings.poses; ++i) {
    if (i < from_motions) {
      const Motion& motion = *motions[random.Index(motions.size())];
      poses.push_back(motion.At(random.Uniform(0.0, motion.duration_s())).pose);
    } else {
      poses.push_back(DrawWithinLimits(settings.limits_used, skeleton, random));
    }
  }
  return poses;
}

std::vector<Vector3f> Deform(const ExamplePoseSettings& settings, const BodyModel& body,
                             const JointPose& pose, RandomStream& random) {
  std::vector<Vector3f> posed;
  SkinDualQuaternion(body.rest.vertices, body.weights, ForwardKinematics(body.skeleton, pose),
                     posed);
  std::vector<Vector3f> normals;
  ComputeVertexNormals(posed, body.rest.triangles, normals);
  const std::vector<float> outwards = Bulges(settings, body, pose);
  for (std::size_t v = 0; v < posed.size(); ++v) {
    posed[v] += outwards[v] * normals[v];
    if (settings.noise_m == 0.0) continue;
    for (int k = 0; k < 3; ++k)
      posed[v][k] += static_cast<float>(random.Normal(0.0, settings.noise_m));
  }
  return posed;
}

}  // namespace vitruvia
