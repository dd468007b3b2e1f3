// Crops, mirrors, rotates and resizes depth images, and computes the camera of the result.
#pragma once

#include <string>

#include "config/settings.h"
#include "geometry/camera.h"
#include "geometry/image.h"

namespace vitruvia {

enum class Turn { kNone, kClockwise90, kHalf, kCounterclockwise90 };
enum class Mirror { kNone, kLeftRight, kUpDown };

// The part of the stored image to keep, in its pixels.
struct CropSettings {
  int left = 0, top = 0;
  int width = 0, height = 0;  // 0: up to the image's edge

  void Describe(Fields& fields);
};

struct ResizeSettings {
  int width = 0, height = 0;  // 0: unchanged; both or none are 0
  double smooth_within_m = 0.03;

  void Describe(Fields& fields);
  std::string Problem() const;
};

// Applied in this order: crop, mirror, turn, resize.
struct OrientationSettings {
  CropSettings crop;
  Mirror mirror = Mirror::kNone;
  Turn turn = Turn::kNone;
  ResizeSettings resize;

  void Describe(Fields& fields);
};

// "" or the reason why an image of that size cannot be cropped like this.
std::string CropProblem(const CropSettings& crop, int width, int height);

// The camera of Oriented(…): it projects a point to the pixel at which the oriented image shows it.
// Mirroring negates x or y of the points.
PinholeCamera OrientedCamera(const PinholeCamera& stored, const OrientationSettings& settings);

// Resizing interpolates depth between neighbours on one surface (SampleDepth), never across an
// edge.
DepthImage Oriented(const DepthImage& stored, const OrientationSettings& settings);

}  // namespace vitruvia
