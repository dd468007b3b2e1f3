// A figure of boxes that raises an arm before a camera: a small sequence, and its parts.
#pragma once

#include <filesystem>
#include <vector>

#include "geometry/camera.h"
#include "geometry/image.h"
#include "math/rigid.h"
#include "sequence/sequence.h"
#include "support/tiny_body.h"

namespace vitruvia {

struct SmallRecording {
  BodyModel body = TinyBody(2);  // the subject, and the true surface
  PinholeCamera camera{96, 72, 85.0, 85.0, 47.5, 35.5};
  double depth_unit_m = 0.001;
  int frames = 3;
  Rigidd camera_from_subject{Eigen::Vector3d(1, -1, -1).asDiagonal().toDenseMatrix(),
                             {0.0, 0.95, 2.8}};

  // The true surface, subject frame and camera frame, and the true joints, camera frame.
  std::vector<Vector3f> InSubject(int frame) const;
  std::vector<Vector3f> InCamera(int frame) const;
  std::vector<Vector3<double>> Joints(int frame) const;
  DepthImage Depth(int frame) const;

  SequenceInfo Info() const;
  void Write(const std::filesystem::path& folder) const;
};

}  // namespace vitruvia
