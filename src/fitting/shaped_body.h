// The body model of the fit of pose and shape, its state, and the derivatives of its surface with
// respect to the state's parameters.
//
// The pose is given in anatomical angles (body/joint_limits.h), so joint limits are bounds of
// single parameters. The surface is x_i = Σ_j w_ij (R_j (v̄_i(θ) − c_j(θ)) + p_j), where c_j are the
// joints of shape θ, and p_j the posed joints down the chain: p_j = p_parent + R_parent (c_j −
// c_parent), p_pelvis a parameter.
#pragma once

#include <vector>

#include "body/anatomical_pose.h"
#include "body/body_model.h"
#include "math/rigid.h"

namespace vitruvia {

inline constexpr int kAngleCount = int{kMidlineAngleCount} + int{kSideCount} * int{kSideAngleCount};

// All angles of a pose one after the other: midline, left, right; degrees.
using AngleVector = Eigen::Matrix<double, kAngleCount, 1>;
constexpr int AngleIndex(Side side, int side_angle) {
  return int{kMidlineAngleCount} + int{side} * int{kSideAngleCount} + side_angle;
}
AngleVector AnglesOf(const AnatomicalPose& pose);
AnatomicalPose PoseOf(const AngleVector& angles_deg);
struct AngleRanges {
  AngleVector min_deg, max_deg;
};
const AngleRanges& JointLimits();
AngleVector WithinLimits(const AngleVector& angles_deg);

// A surface in the rest pose with linear shape coefficients: v̄ = mean + basis θ.
struct ShapedBody {
  std::vector<Vector3f> mean;       // V, rest pose, y up, z to the front; metres
  Eigen::MatrixXf basis;            // 3V × K, metres per standard deviation; K may be 0
  std::vector<Triangle> triangles;  // closed
  SkinWeights weights;
  Skeleton skeleton;            // of the mean
  Eigen::MatrixXd joint_basis;  // 6·17 × K: joints, then tips

  int shape_count() const { return static_cast<int>(basis.cols()); }
};

// The body with a fixed shape (K = 0), on at most that many of its vertices.
ShapedBody RigidShape(const BodyModel& body, int vertices);
// The same body on fewer vertices (geometry/decimation.h).
ShapedBody Coarser(const ShapedBody& body, int vertices);

struct BodyState {
  Matrix3<double> rotation = Matrix3<double>::Identity();  // world_from_pelvis
  Vector3d pelvis_position = Vector3d::Zero();             // world frame, metres
  AngleVector angles_deg = AngleVector::Zero();
  Eigen::VectorXd theta;
};

// For each bone the rigid motion from the rest pose, with the joints of the state's shape.
BoneTransforms WorldFromRest(const ShapedBody& body, const BodyState& state);
Skeleton ShapedSkeleton(const ShapedBody& body, const Eigen::VectorXd& theta);
std::vector<Vector3f> ShapedSurface(const ShapedBody& body, const Eigen::VectorXd& theta);

// The surface in a state, and its derivatives. Parameters: a rotation vector of the whole body
// about the pelvis joint (world frame, rad), the pelvis' position (m), the angles (rad), θ.
class PosedBody {
 public:
  explicit PosedBody(const ShapedBody& body);

  static constexpr int kRotation = 0, kPosition = 3, kAngles = 6, kShape = 6 + kAngleCount;
  int parameter_count() const { return kShape + body_.shape_count(); }

  void Set(const BodyState& state);
  const ShapedBody& body() const { return body_; }
  double mean_edge_m() const { return mean_edge_m_; }  // of the mean shape, weighted by area
  // Area of the mean shape that a vertex represents, divided by the mean over all vertices: a
  // densely triangulated face gets no more weight per area than a coarsely triangulated back.
  float AreaShare(int vertex) const { return area_shares_[static_cast<std::size_t>(vertex)]; }
  const std::vector<Vector3f>& vertices() const { return vertices_; }  // world frame
  const std::vector<Vector3f>& normals() const { return normals_; }
  const std::vector<Vector3d>& joints() const { return joints_; }

  // Prepares Row() at the state last set.
  void Differentiate();
  // d(n · x_i)/d(parameters): parameter_count() floats.
  void Row(int vertex, const Vector3f& n, float* row) const;

 private:
  const ShapedBody& body_;
  double mean_edge_m_ = 0.0;
  std::vector<float> area_shares_;
  BodyState state_;
  std::array<Matrix3<double>, kBoneCount> rotations_;  // world_from_bone
  std::vector<Vector3d> joints_;                       // posed
  BoneTransforms world_from_rest_;
  std::array<Rigidf, kBoneCount> float_transforms_;
  // Twist of each bone per rigid parameter: see bone_twists.h.
  std::array<Eigen::Matrix<float, 6, Eigen::Dynamic>, kBoneCount> twists_;
  std::array<Eigen::Matrix<float, 3, Eigen::Dynamic>, kBoneCount> offsets_;  // d(p_j − R_j c_j)/dθ
  std::vector<Vector3f> rest_, vertices_, normals_;
};

}  // namespace vitruvia
