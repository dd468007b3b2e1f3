// Kinect v1: a projected pattern, found again by correlation.
//
// Sources: Nguyen, Izadi & Lovell, "Modeling Kinect sensor noise for improved 3D reconstruction and
// tracking", 3DIMPVT 2012 (axial and lateral deviations); Khoshelham & Elberink, "Accuracy and
// resolution of Kinect depth data for indoor mapping applications", Sensors 2012 (disparity).
//
// Departures: the noise of depth is correlated over a given window (shared_noise.h; none by
// default), while the real camera's noise is smooth over its correlation window; surfaces that only
// the projector sees cast no shadow.
#pragma once

#include "config/settings.h"
#include "core/random.h"
#include "geometry/camera.h"
#include "geometry/image.h"

namespace vitruvia {

struct StructuredLightSettings {
  double axial_base_m = 0.0012, axial_growth_per_m = 0.0019, axial_near_m = 0.4;
  double axial_slope = 0.0001;  // m^1.5
  double lateral_base_px = 0.8, lateral_slope_px = 0.035;
  double native_focal_px = 580.0;  // of the sensor's own image of 640 columns
  double baseline_m = 0.075;       // from camera to projector along +x
  double disparity_step_px = 0.125;
  double shadow_margin_m = 0.03;
  double edge_loss = 0.3;
  double max_angle_deg = 82.0;
  double min_depth_m = 0.4, max_depth_m = 8.0;

  void Describe(Fields& fields);
};

// Standard deviation of measured depth at depth z and angle θ between normal and ray, quantisation
// included: σ = 0.0012 + 0.0019 (z − 0.4)² + 0.0001 / √z · θ² / (π/2 − θ)², metres.
double AxialDeviation(const StructuredLightSettings& settings, double z_m, double angle_rad);
// Of the place of an edge: σ = 0.8 + 0.035 θ / (π/2 − θ), pixels of the sensor's own image.
double LateralDeviationPx(const StructuredLightSettings& settings, double angle_rad);
// Distance between two depths that the sensor can tell apart at z.
double DepthStep(const StructuredLightSettings& settings, double z_m);
// The depth of the nearest disparity that the sensor knows; 0 beyond the last.
double QuantizedDepth(const StructuredLightSettings& settings, double z_m);

// 1 where the projector, baseline_m along +x, does not see what the camera sees.
MaskImage ProjectorShadow(const DepthImage& depth, const PinholeCamera& camera,
                          const StructuredLightSettings& settings);

DepthImage MeasureByStructuredLight(const DepthImage& true_depth, const PinholeCamera& camera,
                                    const StructuredLightSettings& settings, int shared_px,
                                    RandomStream& random);

}  // namespace vitruvia
