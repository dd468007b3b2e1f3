#include "learning/scan/alignment.h"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "math/angles.h"
#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

// Metres of motion at the body's rim per radian: makes rotations and translations comparable in
// the condition number.
constexpr double kBodyRadiusM = 0.5;

double Condition(const Matrix6d& a) {
  Vector6d scale = Vector6d::Ones();
  scale.head<3>().setConstant(1.0 / kBodyRadiusM);
  const Matrix6d scaled = scale.asDiagonal() * a * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(scaled, Eigen::EigenvaluesOnly);
  const Vector6d& values = solver.eigenvalues();
  return values[0] > 0.0 ? values[5] / values[0] : std::numeric_limits<double>::infinity();
}

struct Gates {
  float squared_distance_m2;
  float cosine;
};

PointToPlaneSystem MatchRow(const PointMap& frame, int v, const ModelView& model,
                            const Rigidf& subject_from_camera, const Vector3f& center,
                            const Gates& gates) {
  const Rigidf model_camera_from_subject = model.camera_from_subject.Cast<float>();
  const Rigidf model_camera_from_camera = model_camera_from_subject * subject_from_camera;
  PointToPlaneSystem system;
  for (int u = 0; u < frame.points.width(); ++u) {
    if (!frame.Has(u, v)) continue;
    const Vector3f in_model_camera = model_camera_from_camera * frame.points(u, v);
    const auto at = model.camera.PixelOf(in_model_camera);
    if (!at) continue;
    ++system.tried;
    if (!model.surface.Has(at->u, at->v)) continue;
    const Vector3f point = subject_from_camera * frame.points(u, v);
    const Vector3f difference = point - model.surface.points(at->u, at->v);
    if (difference.squaredNorm() > gates.squared_distance_m2) continue;
    const Vector3f& normal = model.surface.normals(at->u, at->v);
    if ((subject_from_camera.rotation * frame.normals(u, v)).dot(normal) < gates.cosine) continue;
    Vector6d row;
    row << (point - center).cross(normal).cast<double>(), normal.cast<double>();
    const double residual = normal.dot(difference);
    system.a.selfadjointView<Eigen::Lower>().rankUpdate(row);
    system.b += residual * row;
    system.squared_error_m2 += residual * residual;
    ++system.matched;
  }
  return system;
}

}  // namespace

void PointToPlaneSystem::Add(const PointToPlaneSystem& other) {
  a += other.a;
  b += other.b;
  squared_error_m2 += other.squared_error_m2;
  matched += other.matched;
  tried += other.tried;
}

PointToPlaneSystem MatchPointToPlane(const PointMap& frame, const ModelView& model,
                                     const Rigidd& subject_from_camera, const Vector3d& center,
                                     const AlignmentSettings& settings, WorkerTeam& team) {
  const Gates gates{static_cast<float>(settings.max_distance_m * settings.max_distance_m),
                    static_cast<float>(std::cos(settings.max_angle_deg * kRadiansPerDegree))};
  std::vector<PointToPlaneSystem> rows(static_cast<std::size_t>(frame.points.height()));
  team.For(frame.points.height(), [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      rows[static_cast<std::size_t>(v)] =
          MatchRow(frame, v, model, subject_from_camera.Cast<float>(), center.cast<float>(), gates);
    }
  });
  PointToPlaneSystem sum;
  for (const PointToPlaneSystem& row : rows) sum.Add(row);
  sum.a = Matrix6d(sum.a.selfadjointView<Eigen::Lower>());
  return sum;
}

Rigidd Stepped(const Rigidd& subject_from_camera, const Vector6d& step, const Vector3d& center) {
  Rigidd turned = RotationAbout<double>(ExpSo3<double>(step.head<3>()), center);
  turned.translation += step.tail<3>();
  return turned * subject_from_camera;
}

AlignmentResult Align(const std::vector<PointMap>& pyramid, const ModelView& model,
                      const Rigidd& subject_from_camera_guess, const Vector3d& center,
                      const AlignmentSettings& settings, WorkerTeam& team) {
  AlignmentResult result;
  result.subject_from_camera = subject_from_camera_guess;
  PointToPlaneSystem system;
  for (std::size_t level = pyramid.size(); level-- > 0;) {
    for (int i = 0; i < settings.iterations[level]; ++i) {
      system = MatchPointToPlane(pyramid[level], model, result.subject_from_camera, center,
                                 settings, team);
      const Eigen::LDLT<Matrix6d> factor(system.a);
      if (system.matched < 6 || factor.info() != Eigen::Success || !factor.isPositive()) break;
      const Vector6d step = -factor.solve(system.b);
      if (!step.allFinite()) break;
      result.subject_from_camera = Stepped(result.subject_from_camera, step, center);
      ++result.iterations;
      if (step.head<3>().norm() < settings.stop_rotation_deg * kRadiansPerDegree &&
          step.tail<3>().norm() < settings.stop_translation_m) {
        break;
      }
    }
  }
  if (system.tried > 0) result.matched_share = static_cast<double>(system.matched) / system.tried;
  if (system.matched > 0) result.rms_m = std::sqrt(system.squared_error_m2 / system.matched);
  result.condition = Condition(system.a);
  return result;
}

}  // namespace vitruvia
