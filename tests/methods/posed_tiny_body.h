// A small body in poses of all kinds, for tests of Realtime SCAPE's energy.
#pragma once

#include <string_view>

#include <Eigen/Dense>

#include "core/random.h"
#include "math/rotation.h"
#include "methods/realtime_scape/model.h"
#include "solver/block_normal_equations.h"
#include "support/tiny_body.h"
#include "tracking/classification.h"

namespace vitruvia::realtime_scape {

inline constexpr double kUnit_m = 0.05;
inline constexpr int kUnknowns = kBoneCount * kBlockSize;

inline Vector3d RandomVector(RandomStream& random, double size) {
  return {random.Normal(0, size), random.Normal(0, size), random.Normal(0, size)};
}

inline Eigen::VectorXd RandomIncrement(std::string_view stream, double size) {
  RandomStream random(5, stream);
  Eigen::VectorXd x(kUnknowns);
  for (int i = 0; i < kUnknowns; ++i) x[i] = random.Normal(0, size);
  return x;
}

// Moves each bone by an increment as the solver would: exp(r) on the left, translation in units.
inline BodyPose Moved(BodyPose pose, const Eigen::VectorXd& x) {
  for (int j = 0; j < kBoneCount; ++j) {
    pose[j].rotation = ExpSo3<double>(x.segment<3>(kBlockSize * j)) * pose[j].rotation;
    pose[j].center += kUnit_m * x.segment<3>(kBlockSize * j + 3);
  }
  return pose;
}

inline BodyPose Moved(BodyPose pose, const Rigidd& moved_from_camera) {
  for (BonePose& bone : pose) {
    bone = {moved_from_camera.rotation * bone.rotation, moved_from_camera * bone.center};
  }
  return pose;
}

// Each vertex in double, as eq. 2a has it.
inline Vector3d PosedVertex(const Model& model, const BoneTransforms& camera_from_rest,
                            int vertex) {
  Vector3d posed = Vector3d::Zero();
  for (const auto& [bone, w] : model.InfluencesOf(vertex)) {
    posed += double{w} * (camera_from_rest[bone] * model.rest_vertices[vertex].cast<double>());
  }
  return posed;
}

// Correspondences of one linearisation.
struct FitData {
  VertexClasses classes;    // V1 with its observed depths, V2
  std::vector<Pair> pairs;  // of V2 and P2
};

struct PosedTinyBody {
  static constexpr int kCellsPerSegment = 2;

  // Every joint turned at random, none torn.
  BodyPose Articulated() const {
    RandomStream random(7, "articulated");
    JointPose joints = JointPose::Rest(body.skeleton);
    for (Matrix3<double>& local : joints.local_rotations) {
      local = ExpSo3<double>(RandomVector(random, 0.4));
    }
    const BoneTransforms bones = ForwardKinematics(body.skeleton, joints);
    BodyPose pose;
    for (int j = 0; j < kBoneCount; ++j) {
      const Rigidd camera_from_bone = camera_from_rest * bones[j];
      pose[j] = {camera_from_bone.rotation, camera_from_bone * model.rest_centers[j]};
    }
    return pose;
  }

  // Pairs of every `stride`-th vertex with a point some `size_m` away from it.
  FitData Pairs(const BodyPose& pose, int stride, double size_m) const {
    RandomStream random(9, "pairs");
    FitData data;
    const BoneTransforms transforms = ToTransforms(model, pose);
    for (int i = 0; i < VertexCount(); i += stride) {
      const Vector3d target = PosedVertex(model, transforms, i) + RandomVector(random, size_m);
      data.pairs.push_back({i, target.cast<float>()});
    }
    return data;
  }

  // The depth observed at every `stride`-th vertex is some `size_m` off.
  FitData Depths(const BodyPose& pose, int stride, double size_m) const {
    RandomStream random(9, "depths");
    FitData data;
    const BoneTransforms transforms = ToTransforms(model, pose);
    for (int i = 0; i < VertexCount(); i += stride) {
      const double depth = PosedVertex(model, transforms, i).z() + random.Normal(0, size_m);
      data.classes.near_surface.push_back(i);
      data.classes.observed_depth.push_back(static_cast<float>(depth));
      data.classes.weight.push_back(1.0f);
    }
    return data;
  }

  PosedSurface Surface(const BodyPose& pose) const {
    PosedSurface surface;
    PoseSurface(model, pose, surface);
    return surface;
  }

  int VertexCount() const { return static_cast<int>(model.rest_vertices.size()); }

  const PinholeCamera camera{};
  const Rigidd camera_from_rest{Vector3d(1, -1, -1).asDiagonal(), {0.1, 0.9, 2.8}};
  const BodyModel body = TinyBody(kCellsPerSegment);
  const Model model{body};
  const BodyPose rest = RestPose(model, camera_from_rest);
  const BodyPose near_rest = Moved(rest, RandomIncrement("near", 1e-8));
  const BodyPose bent = Moved(rest, RandomIncrement("bent", 0.2));
  const LocalRotations previous = LocalRotationsOf(Moved(rest, RandomIncrement("previous", 0.1)));
};

}  // namespace vitruvia::realtime_scape
