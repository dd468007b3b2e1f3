// Kinect One: light's time of flight, by the phase of a modulated signal.
//
// Deviations have the form of Fankhauser, Bloesch, Rodriguez, Kaestner, Hutter & Siegwart, "Kinect
// v2 for mobile robot navigation: evaluation and modeling", ICAR 2015. Not modelled: the wiggling
// error of a few millimetres, multipath in corners, the albedo of clothes.
#pragma once

#include "config/settings.h"
#include "core/random.h"
#include "geometry/camera.h"
#include "geometry/image.h"

namespace vitruvia {

struct TimeOfFlightSettings {
  double axial_base_m = 0.0015, axial_linear = -0.0005, axial_square_per_m = 0.0003;
  double axial_slope = 0.0001;  // m^-0.5
  double rim_power = 2.0;
  double flying_share = 0.3;
  double flying_reach_m = 0.3;
  double max_angle_deg = 80.0;
  double min_depth_m = 0.5, max_depth_m = 8.0;

  void Describe(Fields& fields);
};

// Standard deviation of measured depth at depth z, angle θ between normal and ray and angle φ
// between ray and optical axis:
// (0.0015 − 0.0005 z + 0.0003 z² + 0.0001 z^1.5 θ² / (π/2 − θ)²) / cos(φ)^rim_power, metres.
double AxialDeviation(const TimeOfFlightSettings& settings, double z_m, double angle_rad,
                      double off_axis_rad);

DepthImage MeasureByTimeOfFlight(const DepthImage& true_depth, const PinholeCamera& camera,
                                 const TimeOfFlightSettings& settings, int shared_px,
                                 RandomStream& random);

}  // namespace vitruvia
