#include "learning_scan/analytic_views.h"

#include <cmath>
#include <map>

#include "geometry/zbuffer.h"
#include "math/rigid.h"

namespace vitruvia {

PinholeCamera SmallCamera() { return {160, 120, 142.5, 142.5, 79.5, 59.5}; }

Rigidd CameraLookingAt(const Vector3d& position, const Vector3d& target) {
  const Vector3d forward = (target - position).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitY()).normalized();
  Matrix3<double> rotation;
  rotation.row(0) = right.transpose();
  rotation.row(1) = forward.cross(right).transpose();
  rotation.row(2) = forward.transpose();
  return {rotation, -(rotation * position)};
}

DepthImage ViewOf(const std::vector<Ball>& balls, const PinholeCamera& camera,
                  const Rigidd& camera_from_subject) {
  DepthImage depth(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vector3d ray = camera.Unproject<double>(u, v, 1.0);
      for (const Ball& ball : balls) {
        const Vector3d center = camera_from_subject * ball.center;
        const double a = ray.squaredNorm(), b = ray.dot(center);
        const double root = b * b - a * (center.squaredNorm() - ball.radius_m * ball.radius_m);
        if (root <= 0.0) continue;
        const auto z = static_cast<float>((b - std::sqrt(root)) / a);
        if (depth(u, v) == 0.0f || z < depth(u, v)) depth(u, v) = z;
      }
    }
  }
  return depth;
}

DepthImage ViewOfPlane(const PinholeCamera& camera, const Rigidd& camera_from_subject) {
  const Rigidd subject_from_camera = Inverse(camera_from_subject);
  DepthImage depth(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vector3d ray = subject_from_camera.rotation * camera.Unproject<double>(u, v, 1.0);
      const double z = -subject_from_camera.translation.z() / ray.z();
      if (z > 0.0) depth(u, v) = static_cast<float>(z);
    }
  }
  return depth;
}

DepthImage ViewOf(const TriangleMesh& mesh, const PinholeCamera& camera,
                  const Rigidd& camera_from_subject) {
  std::vector<Vector3f> vertices;
  for (const Vector3f& p : mesh.vertices) {
    vertices.push_back((camera_from_subject * p.cast<double>().eval()).cast<float>());
  }
  ZBuffer buffer(camera);
  return buffer.Render(vertices, mesh.triangles);
}

VolumeSettings SmallVolume(double half_m, double voxel_m, double truncation_m) {
  VolumeSettings settings;
  settings.voxel_m = voxel_m;
  settings.truncation_m = truncation_m;
  settings.low_m = {-half_m, -half_m, -half_m};
  settings.high_m = {half_m, half_m, half_m};
  return settings;
}

std::vector<Ball> Cluster() {
  return {{{0.0, 0.0, 0.0}, 0.15},
          {{0.22, 0.05, 0.02}, 0.09},
          {{-0.16, 0.14, 0.06}, 0.10},
          {{0.03, -0.2, 0.05}, 0.08},
          {{-0.05, 0.22, -0.05}, 0.07}};
}

WorkerTeam& Team(int threads) {
  static std::map<int, WorkerTeam> teams;
  return teams.try_emplace(threads, threads).first->second;
}

}  // namespace vitruvia
