#include "synth/sensor/time_of_flight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "synth/sensor/measured_box.h"
#include "synth/sensor/shared_noise.h"
#include "synth/sensor/surface_angle.h"

namespace vitruvia {
namespace {

constexpr const char* kFankhauser =
    "after Fankhauser et al. 2015 (ICAR): 1 to 3 mm at 1 to 3 m; coefficients not read again";

// The nearest and the farthest of the surfaces that meet round a pixel; a surface that ends before
// nothing meets what lies reach_m behind it.
struct Meeting {
  float nearest = 0.0f, farthest = 0.0f;
};
Meeting SurfacesAt(const DepthImage& depth, int u, int v, float reach_m) {
  Meeting meeting;
  bool open = false;
  for (int y = v - 1; y <= v + 1; ++y) {
    for (int x = u - 1; x <= u + 1; ++x) {
      if (!depth.Contains(x, y)) continue;
      const float z = depth(x, y);
      if (!(z > 0.0f)) {
        open = true;
        continue;
      }
      meeting.nearest = meeting.nearest == 0.0f ? z : std::min(meeting.nearest, z);
      meeting.farthest = std::max(meeting.farthest, z);
    }
  }
  meeting.farthest =
      open ? meeting.nearest + reach_m : std::min(meeting.farthest, meeting.nearest + reach_m);
  return meeting;
}

// Random draws for every pixel, so that no setting changes the noise of other pixels. Normal ones
// of pixels outside of the box are not needed and hold 0.
struct PhaseDraws {
  Image<double> along;          // standard normal
  Image<double> luck, mixture;  // even in [0, 1)
};

PhaseDraws DrawPhaseNoise(const DepthImage& depth, const PixelBox& box, int shared_px,
                          RandomStream& random) {
  const Image<double> empty(depth.width(), depth.height());
  PhaseDraws draws{empty, empty, empty};
  const PixelBox shared = box.Grown(shared_px, depth);
  NormalDraws normals(random);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      draws.along(u, v) = normals.Next(shared.Contains(u, v));
      draws.luck(u, v) = random.Uniform();
      draws.mixture(u, v) = random.Uniform();
    }
  }
  draws.along = SharedNoise(draws.along, shared_px);
  return draws;
}

}  // namespace

void TimeOfFlightSettings::Describe(Fields& f) {
  f.Number("axial_base_m", axial_base_m,
           {.meaning = "standard deviation of depth: constant part",
            .unit = "m",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = kFankhauser});
  f.Number("axial_linear", axial_linear,
           {.meaning = "standard deviation of depth: factor of the distance z",
            .min = -1,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = kFankhauser});
  f.Number("axial_square_per_m", axial_square_per_m,
           {.meaning = "standard deviation of depth: factor of z²",
            .unit = "1/m",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = kFankhauser});
  f.Number("axial_slope", axial_slope,
           {.meaning =
                "standard deviation of depth: factor of z^1.5 θ² / (π/2 − θ)², θ the viewing angle",
            .unit = "m^-0.5",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = kFankhauser});
  f.Number(
      "rim_power", rim_power,
      {.meaning = "the noise grows by 1 / cos(φ)^rim_power, φ the angle to the optical axis",
       .min = 0,
       .max = 10,
       .origin = Origin::kGuessed,
       .source = "the light that returns falls off; Corti et al. 2016 find growth with radius"});
  f.Number("flying_share", flying_share,
           {.meaning = "share of the pixels at depth edges that see both surfaces and measure "
                       "something between",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "a pixel wide seam, in part removed by drivers"});
  f.Number("flying_reach_m", flying_reach_m,
           {.meaning = "flying pixels farther than this behind the nearer surface count as "
                       "background and are removed",
            .unit = "m",
            .min = 0,
            .max = 10,
            .origin = Origin::kGuessed,
            .source = "as far as background removal can tell"});
  f.Number("max_angle_deg", max_angle_deg,
           {.meaning = "surfaces seen at a larger angle return too little light",
            .unit = "deg",
            .min = 1,
            .max = 90,
            .origin = Origin::kGuessed,
            .source = kFankhauser});
  f.Number("min_depth_m", min_depth_m,
           {.meaning = "minimum distance that is measured",
            .unit = "m",
            .min = 0,
            .max = 100,
            .origin = Origin::kPaper,
            .source = "the camera's data sheet: 0.5 m"});
  f.Number("max_depth_m", max_depth_m,
           {.meaning = "maximum distance that is measured",
            .unit = "m",
            .min = 0.1,
            .max = 100,
            .origin = Origin::kPaper,
            .source = "the camera's data sheet: 4.5 m, up to 8 m with less certainty"});
}

double AxialDeviation(const TimeOfFlightSettings& s, double z_m, double angle_rad,
                      double off_axis_rad) {
  constexpr double kLargest = 0.5 * std::numbers::pi - 1e-3;
  const double angle = std::min(angle_rad, kLargest);
  const double grazing = angle / (0.5 * std::numbers::pi - angle);
  const double deviation = s.axial_base_m + s.axial_linear * z_m +
                           s.axial_square_per_m * z_m * z_m +
                           s.axial_slope * std::pow(z_m, 1.5) * grazing * grazing;
  return std::max(deviation, 0.0) / std::pow(std::cos(off_axis_rad), s.rim_power);
}

DepthImage MeasureByTimeOfFlight(const DepthImage& true_depth, const PinholeCamera& camera,
                                 const TimeOfFlightSettings& settings, int shared_px,
                                 RandomStream& random) {
  const PixelBox box = MeasuredBox(true_depth, 1);  // flying pixels lie beside it
  const PhaseDraws draws = DrawPhaseNoise(true_depth, box, shared_px, random);
  const Image<float> angles = IncidenceAngles(true_depth, camera);
  const double max_angle_rad = settings.max_angle_deg * std::numbers::pi / 180.0;
  DepthImage measured(true_depth.width(), true_depth.height());
  for (int v = box.top; v < box.bottom; ++v) {
    for (int u = box.left; u < box.right; ++u) {
      float z = true_depth(u, v);
      double angle = angles(u, v);
      if (draws.luck(u, v) < settings.flying_share && IsAtEdge(true_depth, u, v)) {
        const Meeting surfaces =
            SurfacesAt(true_depth, u, v, static_cast<float>(settings.flying_reach_m));
        z = surfaces.nearest +
            static_cast<float>(draws.mixture(u, v)) * (surfaces.farthest - surfaces.nearest);
        angle = 0.0;  // a mixture of signals, without a grazing angle
      }
      if (!(z > 0 && z >= settings.min_depth_m && z <= settings.max_depth_m) ||
          angle > max_angle_rad) {
        continue;
      }
      const Vector3<double> ray = camera.Unproject<double>(u, v, 1.0);
      const double off_axis_rad = std::acos(1.0 / ray.norm());
      const double deviation = AxialDeviation(settings, double{z}, angle, off_axis_rad);
      measured(u, v) = static_cast<float>(std::max(z + draws.along(u, v) * deviation, 0.0));
    }
  }
  return measured;
}

}  // namespace vitruvia
