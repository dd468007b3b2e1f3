// Checks whether a true surface stays inside the image.
#pragma once

#include <string>
#include <vector>

#include "geometry/camera.h"
#include "geometry/mesh.h"

namespace vitruvia {

// Counts the frames in which part of the body is out of view.
class ViewWatch {
 public:
  explicit ViewWatch(const PinholeCamera& camera) : camera_(camera) {}

  void Look(const std::vector<Vector3f>& vertices_in_camera, int frame);

  // "" if the body was always in view.
  std::string Warning(int frame_count) const;

 private:
  PinholeCamera camera_;
  int frames_ = 0, first_ = 0, worst_ = 0;
  double worst_share_ = 0.0;  // of the vertices, in frame worst_
};

}  // namespace vitruvia
