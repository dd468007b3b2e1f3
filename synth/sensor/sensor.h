// Sensor models: the measurement of true depth by a depth camera, and the delivery of frames.
#pragma once

#include "config/settings.h"
#include "core/random.h"
#include "geometry/camera.h"
#include "geometry/image.h"
#include "synth/sensor/delivery.h"
#include "synth/sensor/structured_light.h"
#include "synth/sensor/time_of_flight.h"

namespace vitruvia {

enum class SensorModel { kIdeal, kGaussian, kKinectV1, kKinectOne };

struct SensorSettings {
  SensorModel model = SensorModel::kIdeal;
  double sigma_m = 0.002;       // gaussian: standard deviation of depth
  double dropout = 0.0;         // share of pixels without a measurement; not of the ideal one
  int shared_px = 1;            // width of the window of correlated noise; not used by kIdeal
  double depth_unit_m = 0.001;  // step of stored depth
  StructuredLightSettings kinect_v1{};
  TimeOfFlightSettings kinect_one{};
  DeliverySettings delivery{};

  void Describe(Fields& fields);
};

// Measures one frame. The same stream gives the same frame. Quantisation to depth_unit_m happens
// when the frame is stored; The caller applies settings.delivery.
DepthImage Measure(const DepthImage& true_depth, const PinholeCamera& camera,
                   const SensorSettings& settings, RandomStream& random);

}  // namespace vitruvia
