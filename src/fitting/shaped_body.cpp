#include "fitting/shaped_body.h"

#include <algorithm>

#include "core/error.h"
#include "fitting/bone_twists.h"
#include "geometry/decimation.h"
#include "math/rigid.h"

namespace vitruvia {
namespace {

constexpr int kSideStart[kSideCount] = {AngleIndex(kLeft, 0), AngleIndex(kRight, 0)};

AngleRanges MakeJointLimits() {
  AngleRanges ranges;
  const auto set = [&](int start, std::span<const JointInfo> joints) {
    for (const JointInfo& joint : joints) {
      for (std::size_t a = 0; a < joint.angles.size(); ++a) {
        const auto at = start + joint.first + static_cast<int>(a);
        ranges.min_deg[at] = joint.angles[a].min_deg;
        ranges.max_deg[at] = joint.angles[a].max_deg;
      }
    }
  };
  set(0, MidlineJoints());
  for (const int start : kSideStart) set(start, SideJoints());
  return ranges;
}

Eigen::VectorXd ShapedJoints(const ShapedBody& body, const Eigen::VectorXd& theta) {
  Eigen::VectorXd joints(3 * kBoneCount);
  for (int b = 0; b < kBoneCount; ++b) joints.segment<3>(3 * b) = body.skeleton.joints[b];
  if (theta.size() > 0) joints += body.joint_basis.topRows(3 * kBoneCount) * theta;
  return joints;
}

struct PosedBones {
  std::array<Matrix3<double>, kBoneCount> rotations;
  std::vector<Vector3d> joints;
};

PosedBones PoseBones(const Eigen::VectorXd& rest_joints, const BodyState& state) {
  const JointPose local = LocalRotations(state.angles_deg);
  PosedBones bones;
  bones.joints.resize(kBoneCount);
  bones.rotations[0] = state.rotation;
  bones.joints[0] = state.pelvis_position;
  for (int b = 1; b < kBoneCount; ++b) {
    const int parent = Bones()[b].parent;
    bones.rotations[b] = bones.rotations[parent] * local.local_rotations[b];
    bones.joints[b] = bones.joints[parent] +
                      bones.rotations[parent] *
                          (rest_joints.segment<3>(3 * b) - rest_joints.segment<3>(3 * parent));
  }
  return bones;
}

BoneTransforms TransformsOf(const PosedBones& bones, const Eigen::VectorXd& rest_joints) {
  BoneTransforms transforms(kBoneCount);
  for (int b = 0; b < kBoneCount; ++b) {
    transforms[b] = {bones.rotations[b],
                     bones.joints[b] - bones.rotations[b] * rest_joints.segment<3>(3 * b)};
  }
  return transforms;
}

}  // namespace

AngleVector AnglesOf(const AnatomicalPose& pose) {
  AngleVector angles;
  std::copy(pose.midline_deg.begin(), pose.midline_deg.end(), angles.begin());
  for (int side = 0; side < kSideCount; ++side) {
    std::copy(pose.sides_deg[side].begin(), pose.sides_deg[side].end(),
              angles.begin() + kSideStart[side]);
  }
  return angles;
}

AnatomicalPose PoseOf(const AngleVector& angles_deg) {
  AnatomicalPose pose;
  std::copy_n(angles_deg.begin(), kMidlineAngleCount, pose.midline_deg.begin());
  for (int side = 0; side < kSideCount; ++side) {
    std::copy_n(angles_deg.begin() + kSideStart[side], kSideAngleCount,
                pose.sides_deg[side].begin());
  }
  return pose;
}

const AngleRanges& JointLimits() {
  static const AngleRanges ranges = MakeJointLimits();
  return ranges;
}

AngleVector WithinLimits(const AngleVector& angles_deg) {
  return angles_deg.cwiseMax(JointLimits().min_deg).cwiseMin(JointLimits().max_deg);
}

ShapedBody RigidShape(const BodyModel& body, int vertices) {
  ShapedBody shaped;
  shaped.mean = body.rest.vertices;
  shaped.basis.resize(static_cast<Eigen::Index>(3 * body.rest.vertices.size()), 0);
  shaped.triangles = body.rest.triangles;
  shaped.weights = body.weights;
  shaped.skeleton = body.skeleton;
  shaped.joint_basis.resize(6 * kBoneCount, 0);
  return Coarser(shaped, vertices);
}

ShapedBody Coarser(const ShapedBody& body, int vertices) {
  Decimation decimation = Decimate({body.mean, body.triangles}, vertices);
  ShapedBody coarse;
  coarse.basis.resize(static_cast<Eigen::Index>(3 * decimation.kept.size()), body.basis.cols());
  for (std::size_t i = 0; i < decimation.kept.size(); ++i) {
    const auto v = static_cast<std::size_t>(decimation.kept[i]);
    coarse.mean.push_back(body.mean[v]);
    coarse.weights.bones.push_back(body.weights.bones[v]);
    coarse.weights.weights.push_back(body.weights.weights[v]);
    coarse.basis.middleRows<3>(static_cast<Eigen::Index>(3 * i)) =
        body.basis.middleRows<3>(static_cast<Eigen::Index>(3 * v));
  }
  coarse.triangles = std::move(decimation.triangles);
  coarse.skeleton = body.skeleton;
  coarse.joint_basis = body.joint_basis;
  return coarse;
}

BoneTransforms WorldFromRest(const ShapedBody& body, const BodyState& state) {
  const Eigen::VectorXd joints = ShapedJoints(body, state.theta);
  return TransformsOf(PoseBones(joints, state), joints);
}

Skeleton ShapedSkeleton(const ShapedBody& body, const Eigen::VectorXd& theta) {
  Skeleton skeleton = body.skeleton;
  if (theta.size() == 0) return skeleton;
  const Eigen::VectorXd moved = body.joint_basis * theta;
  for (int b = 0; b < kBoneCount; ++b) {
    skeleton.joints[b] += moved.segment<3>(3 * b);
    skeleton.tips[b] += moved.segment<3>(3 * (kBoneCount + b));
  }
  return skeleton;
}

std::vector<Vector3f> ShapedSurface(const ShapedBody& body, const Eigen::VectorXd& theta) {
  std::vector<Vector3f> rest = body.mean;
  if (theta.size() == 0) return rest;
  const Eigen::VectorXf moved = body.basis * theta.cast<float>();
  for (std::size_t v = 0; v < rest.size(); ++v) {
    rest[v] += moved.segment<3>(static_cast<Eigen::Index>(3 * v));
  }
  return rest;
}

PosedBody::PosedBody(const ShapedBody& body) : body_(body), area_shares_(body.mean.size(), 0.0f) {
  float all = 0.0f, edges = 0.0f;
  for (const Triangle& t : body.triangles) {
    const Vector3f a = body.mean[t[1]] - body.mean[t[0]], b = body.mean[t[2]] - body.mean[t[0]];
    const float area = a.cross(b).norm();
    for (const std::int32_t corner : t) area_shares_[static_cast<std::size_t>(corner)] += area;
    all += area;
    edges += area * (a.norm() + b.norm() + (b - a).norm()) / 3.0f;
  }
  mean_edge_m_ = edges / all;
  for (float& share : area_shares_) share *= static_cast<float>(area_shares_.size()) / (3.0f * all);
}

void PosedBody::Set(const BodyState& state) {
  Require(state.theta.size() == body_.shape_count(), "PosedBody: {} coefficients, expected {}",
          state.theta.size(), body_.shape_count());
  state_ = state;
  const Eigen::VectorXd rest_joints = ShapedJoints(body_, state.theta);
  PosedBones bones = PoseBones(rest_joints, state);
  world_from_rest_ = TransformsOf(bones, rest_joints);
  rotations_ = bones.rotations;
  joints_ = std::move(bones.joints);
  for (int b = 0; b < kBoneCount; ++b) float_transforms_[b] = world_from_rest_[b].Cast<float>();
  rest_ = ShapedSurface(body_, state.theta);
  SkinLinear(rest_, body_.weights, world_from_rest_, vertices_);
  ComputeVertexNormals(vertices_, body_.triangles, normals_);
}

void PosedBody::Differentiate() {
  FindTwists<float>(rotations_, joints_, state_.angles_deg, twists_);
  std::array<Eigen::Matrix3Xd, kBoneCount> posed_by_theta;
  for (int b = 0; b < kBoneCount; ++b) {
    const int parent = Bones()[b].parent;
    const Eigen::Matrix3Xd by_theta = body_.joint_basis.middleRows<3>(3 * b);
    posed_by_theta[b] =
        parent < 0 ? Eigen::Matrix3Xd(Eigen::Matrix3Xd::Zero(3, body_.shape_count()))
                   : Eigen::Matrix3Xd(posed_by_theta[parent] +
                                      rotations_[parent] *
                                          (by_theta - body_.joint_basis.middleRows<3>(3 * parent)));
    offsets_[b] = (posed_by_theta[b] - rotations_[b] * by_theta).cast<float>();
  }
}

void PosedBody::Row(int vertex, const Vector3f& n, float* row) const {
  const auto v = static_cast<std::size_t>(vertex);
  Eigen::Map<Eigen::RowVectorXf> all(row, parameter_count());
  all.setZero();
  auto rigid = all.head(kShape);
  auto shape = all.tail(body_.shape_count());
  Vector3f n_in_rest = Vector3f::Zero();
  for (int k = 0; k < kMaxInfluences && body_.weights.weights[v][k] > 0.0f; ++k) {
    const float weight = body_.weights.weights[v][k];
    const int b = body_.weights.bones[v][k];
    const Vector3f x = float_transforms_[b] * rest_[v];
    Eigen::Matrix<float, 1, 6> wrench;
    wrench << weight * x.cross(n).transpose(), weight * n.transpose();
    rigid.noalias() += wrench * twists_[b];
    if (shape.size() == 0) continue;
    n_in_rest += weight * (float_transforms_[b].rotation.transpose() * n);
    shape.noalias() += (weight * n.transpose()) * offsets_[b];
  }
  if (shape.size() == 0) return;
  shape.noalias() +=
      n_in_rest.transpose() * body_.basis.middleRows<3>(static_cast<Eigen::Index>(3 * v));
}

}  // namespace vitruvia
