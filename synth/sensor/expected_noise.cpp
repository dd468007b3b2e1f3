#include "synth/sensor/expected_noise.h"

#include <cmath>
#include <numbers>

#include "synth/sensor/surface_angle.h"

namespace vitruvia {
namespace {

bool IsGrazing(double angle_rad, double max_angle_deg) {
  return angle_rad > max_angle_deg * std::numbers::pi / 180.0;
}

PixelNoise StructuredLightNoise(const StructuredLightSettings& s, double z_m, double angle_rad,
                                bool is_shadowed, bool is_at_edge) {
  if (z_m < s.min_depth_m || z_m > s.max_depth_m || is_shadowed ||
      IsGrazing(angle_rad, s.max_angle_deg)) {
    return {};
  }
  return {AxialDeviation(s, z_m, angle_rad),
          LateralDeviationPx(s, angle_rad) * z_m / s.native_focal_px,
          is_at_edge ? 1.0 - s.edge_loss : 1.0};
}

PixelNoise TimeOfFlightNoise(const TimeOfFlightSettings& s, double z_m, double angle_rad,
                             double off_axis_rad, bool is_at_edge) {
  if (z_m < s.min_depth_m || z_m > s.max_depth_m || IsGrazing(angle_rad, s.max_angle_deg)) {
    return {};
  }
  return {AxialDeviation(s, z_m, angle_rad, off_axis_rad), 0.0,
          is_at_edge ? 1.0 - s.flying_share : 1.0};
}

}  // namespace

Image<PixelNoise> ExpectedNoise(const DepthImage& true_depth, const PinholeCamera& camera,
                                const SensorSettings& settings) {
  const Image<float> angles = IncidenceAngles(true_depth, camera);
  const bool casts_shadow = settings.model == SensorModel::kKinectV1;
  const MaskImage shadow =
      casts_shadow ? ProjectorShadow(true_depth, camera, settings.kinect_v1) : MaskImage();
  const double rounding_m = settings.depth_unit_m / std::sqrt(12.0);

  Image<PixelNoise> noise(true_depth.width(), true_depth.height());
  for (int v = 0; v < true_depth.height(); ++v) {
    for (int u = 0; u < true_depth.width(); ++u) {
      const double z = true_depth(u, v), angle = angles(u, v);
      if (!(z > 0.0)) continue;
      PixelNoise& pixel = noise(u, v);
      switch (settings.model) {
        case SensorModel::kIdeal:
          pixel = {0.0, 0.0, 1.0};
          break;
        case SensorModel::kGaussian:
          pixel = {settings.sigma_m, 0.0, 1.0};
          break;
        case SensorModel::kKinectV1:
          pixel = StructuredLightNoise(settings.kinect_v1, z, angle, shadow(u, v) != 0,
                                       IsAtEdge(true_depth, u, v));
          break;
        case SensorModel::kKinectOne: {
          const double off_axis_rad = std::acos(1.0 / camera.Unproject<double>(u, v, 1.0).norm());
          pixel = TimeOfFlightNoise(settings.kinect_one, z, angle, off_axis_rad,
                                    IsAtEdge(true_depth, u, v));
          break;
        }
      }
      pixel.axial_m = std::hypot(pixel.axial_m, rounding_m);
      if (settings.model != SensorModel::kIdeal) pixel.measured_share *= 1.0 - settings.dropout;
    }
  }
  return noise;
}

}  // namespace vitruvia
