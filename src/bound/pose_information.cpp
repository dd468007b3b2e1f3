#include "bound/pose_information.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "geometry/surface_map.h"
#include "math/angles.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

using PoseRow = Eigen::Matrix<double, 1, kPoseUnknowns>;

Vector3d NormalAt(const SurfaceSample& sample, const TrueBody& body) {
  const Triangle& t = body.triangles[sample.triangle];
  const Vector3f first = body.vertices[t[1]] - body.vertices[t[0]];
  const Vector3f second = body.vertices[t[2]] - body.vertices[t[0]];
  return first.cross(second).cast<double>().normalized();
}

// nᵀ J of the surface point of a sample: its corners move, each with its own shares.
PoseRow NormalMotion(const SurfaceSample& sample, const Vector3d& normal, const TrueBody& body) {
  PoseRow row = PoseRow::Zero();
  row.head<3>() = normal;
  for (int k = 0; k < 3; ++k) {
    const int vertex = body.triangles[sample.triangle][k];
    const Vector3d place = body.vertices[vertex].cast<double>();
    for (int j = 0; j < kBoneCount; ++j) {
      const double share = double{sample.barycentric[k]} * double{body.shares[vertex][j]};
      if (share != 0.0)
        row.segment<3>(3 + 3 * j) += share * (place - body.joints[j]).cross(normal).transpose();
    }
  }
  return row;
}

// Along the normal; a deviation of depth is one along the ray.
double NormalVariance(const PixelNoise& noise, const Vector3d& point, const Vector3d& normal) {
  const double ray_length = point.norm() / point.z();
  const double cosine = normal.dot(point.normalized());
  const double along = noise.axial_m * ray_length, square = cosine * cosine;
  return square * along * along + (1.0 - square) * noise.lateral_m * noise.lateral_m;
}

}  // namespace

RotationShares SharesOf(const SkinWeights& weights) {
  RotationShares shares(weights.size(), std::array<float, kBoneCount>{});
  for (std::size_t v = 0; v < weights.size(); ++v) {
    for (int k = 0; k < kMaxInfluences; ++k) {
      for (int bone = weights.bones[v][k]; bone >= 0; bone = Bones()[bone].parent)
        shares[v][bone] += weights.weights[v][k];
    }
  }
  return shares;
}

SkinWeights TransferredWeights(const BodyModel& subject,
                               const std::vector<Vector3f>& rest_vertices) {
  const Eigen::MatrixXf of_subject = Dense(subject.weights, kBoneCount);
  const std::vector<SurfacePoint> nearest = ClosestSurfacePoints(rest_vertices, subject.rest);
  Eigen::MatrixXf transferred(rest_vertices.size(), kBoneCount);
  for (std::size_t v = 0; v < nearest.size(); ++v) {
    const Triangle& corners = subject.rest.triangles[nearest[v].triangle];
    transferred.row(v).setZero();
    for (int k = 0; k < 3; ++k)
      transferred.row(v) += nearest[v].barycentric[k] * of_subject.row(corners[k]);
  }
  return Sparsified(transferred);
}

Eigen::MatrixXd PoseInformation(const TrueBody& body, const Image<SurfaceSample>& samples,
                                const Image<PixelNoise>& noise, const PinholeCamera& camera,
                                double shared_area_px) {
  // Rows are gathered, so that their products are sums of whole matrices.
  constexpr int kRowsAtOnce = 256;
  Eigen::Matrix<double, kPoseUnknowns, Eigen::Dynamic> rows(kPoseUnknowns, kRowsAtOnce);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(kPoseUnknowns, kPoseUnknowns);
  int count = 0;
  const auto add_rows = [&] {
    if (count == 0) return;  // Eigen divides by the number of columns
    information.selfadjointView<Eigen::Lower>().rankUpdate(rows.leftCols(count));
    count = 0;
  };
  for (int v = 0; v < samples.height(); ++v) {
    for (int u = 0; u < samples.width(); ++u) {
      const SurfaceSample& sample = samples(u, v);
      const PixelNoise& pixel = noise(u, v);
      if (sample.depth_m == 0.0f || pixel.measured_share == 0.0) continue;
      const Vector3d point = camera.Unproject<double>(u, v, sample.depth_m);
      const Vector3d normal = NormalAt(sample, body);
      const double weight =
          pixel.measured_share / (shared_area_px * NormalVariance(pixel, point, normal));
      rows.col(count++) = std::sqrt(weight) * NormalMotion(sample, normal, body).transpose();
      if (count == kRowsAtOnce) add_rows();
    }
  }
  add_rows();
  return information.selfadjointView<Eigen::Lower>();
}

Eigen::MatrixXd PriorInformation(const PosePrior& prior) {
  const double rotation_rad = prior.rotation_deg * kRadiansPerDegree;
  Eigen::VectorXd diagonal(kPoseUnknowns);
  diagonal.setConstant(1.0 / (rotation_rad * rotation_rad));
  diagonal.head<3>().setConstant(1.0 / (prior.position_m * prior.position_m));
  return diagonal.asDiagonal();
}

Eigen::MatrixXd JointMotion(int joint, const std::array<Vector3d, kBoneCount>& joints) {
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(3, kPoseUnknowns);
  motion.leftCols<3>().setIdentity();
  for (int bone = Bones()[joint].parent; bone >= 0; bone = Bones()[bone].parent)
    motion.middleCols<3>(3 + 3 * bone) = -Skew<double>(joints[joint] - joints[bone]);
  return motion;
}

std::array<Matrix3<double>, kBoneCount> JointBounds(
    const Eigen::MatrixXd& information, const std::array<Vector3d, kBoneCount>& joints) {
  const Eigen::LLT<Eigen::MatrixXd> cholesky(information);
  std::array<Matrix3<double>, kBoneCount> bounds;
  for (int joint = 0; joint < kBoneCount; ++joint) {
    const Eigen::MatrixXd motion = JointMotion(joint, joints);
    bounds[joint] = motion * cholesky.solve(motion.transpose());
  }
  return bounds;
}

}  // namespace vitruvia
