// A subject's surface by SCAPE (paper A, eq. 1) with regressed pose-dependent deformations, and the
// derivatives of its vertices with respect to the pose.
//
// The surface whose edges come nearest to R_part Q_k(Δr) ê_k. Both the mesh solve and Q are linear,
// so the solve is done once: with f_0 = 1 and f_m the components of the rotation vectors Δr,
//   v_i = c + Σ_part R_part Σ_m f_m P_part,m,i ,
// P_part,m the solution for the deformations C_m of that part's triangles alone. The pose consists
// of the vertices' mean c and a rotation for each part; only the surface holds the parts together.
// The intrinsic shape is the subject's mesh itself, so S of Weiss et al. is the identity.
#pragma once

#include <array>
#include <vector>

#include "body/body_model.h"
#include "learning/shape/pose_regression.h"
#include "math/rigid.h"

namespace vitruvia::scape_regression {

struct ScapePose {
  std::array<Matrix3<double>, kBoneCount> rotations;  // camera_from_part
  Vector3d center = Vector3d::Zero();                 // of the vertices' mean, camera frame, metres
};

class ScapeBody {
 public:
  // Translation of the mean, then for each part a rotation vector (camera frame) applied to it
  // alone.
  static constexpr int kParameters = 3 + 3 * kBoneCount;
  using Row = Eigen::Matrix<double, 1, kParameters>;

  // `regression` must belong to the subject's triangles. DataError if the mesh is not connected.
  ScapeBody(const BodyModel& subject, const PoseRegression& regression);

  std::size_t vertex_count() const { return rest_.size(); }
  const std::vector<Triangle>& triangles() const { return triangles_; }

  // The surface in a pose, camera frame, metres.
  void Vertices(const ScapePose& pose, std::vector<Vector3f>& vertices) const;

  // Intermediate results shared by the derivatives at a pose.
  struct Linearization {
    std::array<Matrix3<double>, kBoneCount> rotations;
    std::array<Vector3d, kBoneCount> turns;               // Δr
    std::array<Matrix3<double>, kBoneCount> turn_by_own;  // ∂Δr / ∂(rotation of the joint's bone)
  };
  static Linearization LinearizeAt(const ScapePose& pose);
  // d(n · v) / d(parameters).
  Row RowOf(const Linearization& at, int vertex, const Vector3d& n) const;

  static ScapePose Stepped(const ScapePose& pose, const Eigen::VectorXd& step);
  ScapePose RestPose(const Rigidd& camera_from_subject) const;
  ScapePose PoseOf(const BoneTransforms& camera_from_rest) const;

  // The rigid motion of each part's vertices from the rest pose, and the joints between them: the
  // mean of the joint's places under a part and its parent.
  BoneTransforms PartMotions(const std::vector<Vector3f>& vertices) const;
  std::vector<Vector3d> Joints(const BoneTransforms& part_motions) const;

 private:
  // One P: of a part's triangles and a regressor.
  struct FieldInfo {
    int part, joint, component;  // joint −1: the constant term
  };

  Vector3d Field(int vertex, std::size_t field) const {
    return fields_[static_cast<std::size_t>(vertex) * infos_.size() + field].cast<double>();
  }

  std::vector<Vector3f> rest_;
  std::vector<Triangle> triangles_;
  Skeleton skeleton_;
  Vector3d rest_center_ = Vector3d::Zero();
  std::array<std::vector<int>, kBoneCount> vertices_of_part_;
  std::vector<FieldInfo> infos_;
  std::vector<Vector3f> fields_;  // vertex by vertex
};

}  // namespace vitruvia::scape_regression
