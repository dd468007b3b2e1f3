// A depth image cut, mirrored, turned and resized, and the camera that sees the result.
#pragma once

#include <string>

#include "config/settings.h"
#include "geometry/camera.h"
#include "geometry/image.h"

namespace vitruvia {

enum class Turn { kNone, kClockwise90, kHalf, kCounterclockwise90 };
enum class Mirror { kNone, kLeftRight, kUpDown };

// A part of the stored image, in its pixels.
struct CropSettings {
  int left = 0, top = 0;
  int width = 0, height = 0;  // 0: up to the image's edge

  void Describe(Fields& fields);
};

struct ResizeSettings {
  int width = 0, height = 0;  // 0: as it is; both or none
  double smooth_within_m = 0.03;

  void Describe(Fields& fields);
  std::string Problem() const;
};

// Carried out in this order: crop, mirror, turn, resize.
struct OrientationSettings {
  CropSettings crop;
  Mirror mirror = Mirror::kNone;
  Turn turn = Turn::kNone;
  ResizeSettings resize;

  void Describe(Fields& fields);
};

// "" or why an image of that size cannot be cropped so.
std::string CropProblem(const CropSettings& crop, int width, int height);

// The camera of Oriented(…): a point that the stored image shows at a pixel is seen by this camera
// where the oriented image shows it. Mirroring leaves x or y of the points with the other sign.
PinholeCamera OrientedCamera(const PinholeCamera& stored, const OrientationSettings& settings);

// Depth where it is resized is interpolated between neighbours of one surface (SampleDepth), never
// across an edge.
DepthImage Oriented(const DepthImage& stored, const OrientationSettings& settings);

}  // namespace vitruvia
