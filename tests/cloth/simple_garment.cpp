#include "cloth/simple_garment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kVolumeWavelength_m = 0.45;    // a belly's or a shoulder's size
constexpr double kWrinkleWavelength_m = 0.09;   // of a shirt's loose folds
constexpr double kWrinkleRate_rad_per_s = 2.0;  // a wrinkle comes and goes in some three seconds
constexpr int kWaves = 6;                       // in each field of waves
constexpr double kFoldReach_m = 0.11;           // folds fade out that far from the joint
constexpr double kFullBend_rad = std::numbers::pi / 2.0;  // a right angle folds cloth fully
constexpr double kStretchedShare = 0.15;  // of the folds, left on the side that is pulled taut

bool IsBareBone(int bone) {
  using enum BoneId;
  const auto id = static_cast<BoneId>(bone);
  return id == kHead || id == kNeck || id == kLeftHand || id == kRightHand || id == kLeftFoot ||
         id == kRightFoot;
}

bool IsLimb(int bone) {
  return !IsBareBone(bone) && bone >= static_cast<int>(BoneId::kLeftUpperArm);
}

Vector3d RandomDirection(RandomStream& random) {
  Vector3d direction;
  do {
    direction = {random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0)};
  } while (direction.norm() < 0.1 || direction.norm() > 1.0);
  return direction.normalized();
}

double Angle(const Matrix3<double>& rotation) { return LogSo3<double>(rotation).norm(); }

}  // namespace

SimpleGarment::SimpleGarment(const BodyModel& body, const ClothSettings& settings,
                             std::uint64_t seed)
    : body_(body), settings_(settings) {
  ComputeVertexNormals(body.rest.vertices, body.rest.triangles, normals_);
  const auto waves = [&](const char* name, double wavelength_m, double rate) {
    RandomStream random(seed, name);
    std::vector<Wave> result;
    for (int k = 0; k < kWaves; ++k) {
      const double length = wavelength_m * random.Uniform(0.7, 1.4);
      result.push_back({kTwoPi / length * RandomDirection(random), random.Uniform(0.0, kTwoPi),
                        rate * random.Uniform(0.5, 1.5)});
    }
    return result;
  };
  volume_waves_ = waves("cloth/volume", kVolumeWavelength_m, 0.0);
  wrinkle_waves_ = waves("cloth/wrinkles", kWrinkleWavelength_m, kWrinkleRate_rad_per_s);
  RandomStream random(seed, "cloth/folds");
  for (int joint = 0; joint < kBoneCount; ++joint) {
    fold_phases_.push_back(random.Uniform(0.0, kTwoPi));
  }
  covered_.resize(body.rest.vertices.size());
  for (int v = 0; v < static_cast<int>(covered_.size()); ++v) {
    double bare = 0.0;
    for (int k = 0; k < kMaxInfluences; ++k) {
      if (IsBareBone(body.weights.bones[v][k])) bare += double{body.weights.weights[v][k]};
    }
    covered_[v] = std::clamp(1.0 - bare, 0.0, 1.0);
    for (int joint = 1; joint < kBoneCount; ++joint) {
      // Only vertices of the bones on either side of the joint, not of the other arm beside a hip.
      double share = 0.0;
      for (int k = 0; k < kMaxInfluences; ++k) {
        const int bone = body.weights.bones[v][k];
        if (bone == joint || bone == Bones()[joint].parent) share += body.weights.weights[v][k];
      }
      const Vector3d offset = body.rest.vertices[v].cast<double>() - body.skeleton.joints[joint];
      const Vector3d axis = (body.skeleton.tips[joint] - body.skeleton.joints[joint]).normalized();
      const double along = offset.dot(axis);
      const Vector3d off_axis = offset - along * axis;
      const double nearness = share * covered_[v] *
                              std::exp(-0.5 * offset.squaredNorm() / (kFoldReach_m * kFoldReach_m));
      if (nearness < 1e-3 || off_axis.norm() < 1e-6) continue;
      fold_sites_.push_back({v, joint, along, off_axis.normalized(), nearness});
    }
  }
}

double SimpleGarment::Volume(int vertex) const {
  const Vector3d p = body_.rest.vertices[vertex].cast<double>();
  double sum = 0.0;
  for (const Wave& wave : volume_waves_) sum += std::cos(wave.direction.dot(p) + wave.phase);
  return settings_.volume_m * sum / std::sqrt(0.5 * kWaves);
}

// A limb of direction a that a joint turns to R a presses the cloth together on the side that R a
// leans to, and stretches it on the other.
void SimpleGarment::AddFolds(const JointPose& pose, std::vector<double>& offsets) const {
  const double wave_number = kTwoPi / settings_.fold_wavelength_m;
  for (const FoldSite& site : fold_sites_) {
    const Matrix3<double>& local = pose.local_rotations[site.joint];
    const double bend = std::min(1.0, Angle(local) / kFullBend_rad);
    if (bend < 1e-3) continue;
    const Vector3d axis =
        (body_.skeleton.tips[site.joint] - body_.skeleton.joints[site.joint]).normalized();
    const Vector3d lean = local * axis - axis;
    const double inner =
        lean.norm() < 1e-9 ? 0.5 : 0.5 + 0.5 * lean.normalized().dot(site.outwards);
    const double pressed = kStretchedShare + (1.0 - kStretchedShare) * inner;
    // The folds of a twisted limb are oblique: the phase depends on the angle round the limb.
    const double around = std::atan2(site.outwards.y() + site.outwards.x(), site.outwards.z());
    const double twist = LogSo3<double>(local).dot(axis);
    const double phase =
        wave_number * site.along_m + 2.0 * twist * around + fold_phases_[site.joint] + 4.0 * bend;
    offsets[site.vertex] +=
        settings_.fold_depth_m * bend * pressed * site.nearness * std::cos(phase);
  }
}

void SimpleGarment::AddDrape(const JointPose& pose, std::vector<double>& offsets) const {
  const BoneTransforms bones = ForwardKinematics(body_.skeleton, pose);
  std::array<Vector3d, kBoneCount> down;   // in each bone's rest frame
  std::array<double, kBoneCount> level{};  // 1: the limb lies flat; 0: it hangs or stands
  for (int bone = 0; bone < kBoneCount; ++bone) {
    down[bone] = bones[bone].rotation.transpose() * -Vector3d::UnitY();
    const Vector3d axis = (body_.skeleton.tips[bone] - body_.skeleton.joints[bone]).normalized();
    level[bone] = std::sqrt(std::max(0.0, 1.0 - std::pow(down[bone].dot(axis), 2)));
  }
  for (std::size_t v = 0; v < offsets.size(); ++v) {
    const Vector3d normal = normals_[v].cast<double>();
    for (int k = 0; k < kMaxInfluences; ++k) {
      const int bone = body_.weights.bones[v][k];
      const double weight = body_.weights.weights[v][k];
      if (weight == 0.0 || !IsLimb(bone)) continue;
      const double below = std::max(0.0, normal.dot(down[bone]));
      offsets[v] += settings_.drape_m * covered_[v] * weight * level[bone] * below * below;
    }
  }
}

void SimpleGarment::Dress(const JointPose& pose, double time_s,
                          std::vector<Vector3f>& rest_vertices) const {
  const std::size_t count = body_.rest.vertices.size();
  std::vector<double> offsets(count);
  for (std::size_t v = 0; v < count; ++v) {
    const Vector3d p = body_.rest.vertices[v].cast<double>();
    double wrinkle = 0.0;
    for (const Wave& wave : wrinkle_waves_) {
      wrinkle += std::cos(wave.direction.dot(p) + wave.phase) * std::cos(wave.rate * time_s);
    }
    offsets[v] = covered_[v] * (Volume(static_cast<int>(v)) + settings_.thickness_m +
                                settings_.wrinkle_depth_m * wrinkle / std::sqrt(0.5 * kWaves));
  }
  AddFolds(pose, offsets);
  AddDrape(pose, offsets);
  rest_vertices.resize(count);
  for (std::size_t v = 0; v < count; ++v) {
    rest_vertices[v] = body_.rest.vertices[v] + static_cast<float>(offsets[v]) * normals_[v];
  }
}

}  // namespace vitruvia
