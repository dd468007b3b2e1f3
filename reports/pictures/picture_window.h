// Which part of a camera's picture is shown, and depth in colours.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/image.h"
#include "reports/pictures/mesh_view.h"

namespace vitruvia {

struct ImageBounds {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;  // pixels
  double extent() const { return std::max(right - left, bottom - top); }
};

ImageBounds Projected(const PinholeCamera& camera, const std::vector<Vector3f>& points);

// A square of that many pixels round the middle of the bounds.
PictureWindow Centered(const ImageBounds& bounds, double extent);

// Of the points' bounding box.
Vector3f Middle(const std::vector<Vector3f>& points);

// A length at the depth of a point, in pixels.
double Pixels(const PinholeCamera& camera, double length_m, const Vector3f& at);

// Ends of the depth colours: the measured range in steps of a decimetre.
class DepthRange {
 public:
  void Include(const DepthImage& depth);
  double nearest_m() const;
  double farthest_m() const;

 private:
  float nearest_ = 1e9f, farthest_ = 0.0f;
};

// `part` of the depth image, size × size pixels.
ColorImage DepthPicture(const DepthImage& depth, const PictureWindow& part, int size,
                        double nearest_m, double farthest_m);

}  // namespace vitruvia
