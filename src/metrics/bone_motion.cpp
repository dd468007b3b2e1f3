#include "metrics/bone_motion.h"

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "math/rigid_fit.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

constexpr int kFewestVertices = 3;

void RequireOneLength(std::size_t estimate, std::size_t truth) {
  Require(estimate == truth, "{} frames of rotations against {} true ones", estimate, truth);
}

}  // namespace

RigidParts::RigidParts(const std::vector<Vector3f>& rest_vertices,
                       const std::vector<int>& bone_of_vertex, int bone_count)
    : vertices_(bone_count), rest_(rest_vertices) {
  Require(bone_of_vertex.size() == rest_vertices.size(), "bones for {} vertices, mesh of {}",
          bone_of_vertex.size(), rest_vertices.size());
  for (std::size_t i = 0; i < bone_of_vertex.size(); ++i) {
    if (bone_of_vertex[i] >= 0) vertices_[bone_of_vertex[i]].push_back(static_cast<int>(i));
  }
}

BoneRotations RigidParts::Rotations(const std::vector<Vector3f>& posed) const {
  Require(posed.size() == rest_.size(), "{} posed vertices, {} in the rest pose", posed.size(),
          rest_.size());
  BoneRotations rotations(vertices_.size(), Matrix3<double>::Identity());
  for (std::size_t b = 0; b < vertices_.size(); ++b) {
    if (vertices_[b].size() < kFewestVertices) continue;
    const auto pair_at = [&](std::size_t k) {
      const int i = vertices_[b][k];
      return PointPair{rest_[i].cast<double>(), posed[i].cast<double>()};
    };
    rotations[b] = FitRigid(vertices_[b].size(), pair_at).rotation;
  }
  return rotations;
}

Vector3d AngularAcceleration(const std::vector<BoneRotations>& frames, std::size_t i,
                             std::size_t bone, double fps) {
  const auto velocity = [&](std::size_t at) -> Vector3d {
    return fps *
           LogSo3<double>(Matrix3<double>(frames[at][bone] * frames[at - 1][bone].transpose()));
  };
  return fps * (velocity(i) - velocity(i - 1));
}

double AngularJitter(const std::vector<BoneRotations>& estimate,
                     const std::vector<BoneRotations>& truth, double fps) {
  RequireOneLength(estimate.size(), truth.size());
  double squares = 0.0;
  int count = 0;
  for (std::size_t i = 2; i < truth.size(); ++i) {
    for (std::size_t b = 0; b < truth[i].size(); ++b) {
      squares += (AngularAcceleration(estimate, i, b, fps) - AngularAcceleration(truth, i, b, fps))
                     .squaredNorm();
      ++count;
    }
  }
  return count == 0 ? 0.0 : std::sqrt(squares / count);
}

double TwistAbout(const Matrix3<double>& rotation, const Vector3d& axis) {
  const Eigen::Quaterniond q(rotation);
  double angle = 2.0 * std::atan2(q.vec().dot(axis), q.w());
  if (angle > std::numbers::pi) angle -= 2.0 * std::numbers::pi;
  if (angle <= -std::numbers::pi) angle += 2.0 * std::numbers::pi;
  return angle;
}

double TwistError(const std::vector<BoneRotations>& estimate,
                  const std::vector<BoneRotations>& truth, const std::vector<Vector3d>& axes) {
  RequireOneLength(estimate.size(), truth.size());
  double squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (std::size_t b = 0; b < axes.size(); ++b) {
      if (axes[b].isZero()) continue;
      const double twist = TwistAbout(truth[i][b].transpose() * estimate[i][b], axes[b]);
      squares += twist * twist;
      ++count;
    }
  }
  return count == 0 ? 0.0 : std::sqrt(squares / count);
}

}  // namespace vitruvia
