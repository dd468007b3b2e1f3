// The noise that a sensor model predicts for each pixel, without sampling.
#pragma once

#include "geometry/camera.h"
#include "geometry/image.h"
#include "synth/sensor/sensor.h"

namespace vitruvia {

struct PixelNoise {
  double axial_m = 0.0;         // standard deviation of depth
  double lateral_m = 0.0;       // of the place of what is seen, across the line of sight
  double measured_share = 0.0;  // probability of a measurement of this surface; 0: there is none
};

// For each pixel of true depth. Rounding to depth_unit_m is part of the deviation of depth.
Image<PixelNoise> ExpectedNoise(const DepthImage& true_depth, const PinholeCamera& camera,
                                const SensorSettings& settings);

}  // namespace vitruvia
