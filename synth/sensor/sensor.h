// Sensor models: what a depth camera makes of true depth.
#pragma once

#include "core/random.h"
#include "core/settings.h"
#include "geometry/image.h"

namespace vitruvia {

enum class SensorModel { kIdeal, kGaussian };

struct SensorSettings {
  SensorModel model = SensorModel::kIdeal;
  double sigma_m = 0.002;       // gaussian: standard deviation of depth
  double dropout = 0.0;         // share of pixels without a measurement
  double depth_unit_m = 0.001;  // step of stored depth

  void Describe(Fields& fields);
};

// Measures one frame. Quantisation to depth_unit_m happens when the frame is stored.
DepthImage Measure(const DepthImage& true_depth, const SensorSettings& settings,
                   RandomStream& random);

}  // namespace vitruvia
