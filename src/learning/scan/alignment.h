// Frame-to-model alignment: estimates the camera pose by point-to-plane ICP (KF, sec. 3.5).
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/worker_team.h"
#include "geometry/camera.h"
#include "learning/scan/point_map.h"
#include "math/rigid.h"

namespace vitruvia {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

// The model rendered in an earlier camera pose, with which frames are aligned.
struct ModelView {
  PointMap surface;  // subject frame
  PinholeCamera camera;
  Rigidd camera_from_subject;
};

// Σ (nᵀ(q + ω × (q − c) + t − m))² over matched points q of a frame and m of the model, with
// x = (ω, t): the quadratic xᵀ A x + 2 bᵀ x + e.
struct PointToPlaneSystem {
  Matrix6d a = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  double squared_error_m2 = 0.0;
  int matched = 0;
  int tried = 0;  // points of the frame that project into the model's view

  void Add(const PointToPlaneSystem& other);
};

// Matches each point of the frame with the model's point at the pixel where it projects to, and
// drops pairs that are too far apart or whose normals differ too much. Sums are in a fixed order.
PointToPlaneSystem MatchPointToPlane(const PointMap& frame, const ModelView& model,
                                     const Rigidd& subject_from_camera, const Vector3d& center,
                                     const AlignmentSettings& settings, WorkerTeam& team);

// The pose after the step x about `center`.
Rigidd Stepped(const Rigidd& subject_from_camera, const Vector6d& step, const Vector3d& center);

struct AlignmentResult {
  Rigidd subject_from_camera;
  double matched_share = 0.0;  // of the frame's points, at the last iteration
  double rms_m = 0.0;          // of the matched points' distances to their planes
  double condition = 0.0;      // of A at the last iteration, with rotations about the body's middle
  int iterations = 0;
};

// Coarse to fine. `pyramid` holds the frame's point maps (camera frame), finest first.
AlignmentResult Align(const std::vector<PointMap>& pyramid, const ModelView& model,
                      const Rigidd& subject_from_camera_guess, const Vector3d& center,
                      const AlignmentSettings& settings, WorkerTeam& team);

}  // namespace vitruvia
