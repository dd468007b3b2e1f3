#include "synth/sensor/structured_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "synth/sensor/measured_box.h"
#include "synth/sensor/shared_noise.h"
#include "synth/sensor/surface_angle.h"

namespace vitruvia {
namespace {

constexpr double kCellsPerPixel = 2.0;  // of the projector's image, in which shadows are found
constexpr const char* kNguyen = "Nguyen, Izadi & Lovell 2012";

// θ / (π/2 − θ), which grows without bound towards grazing.
double Grazing(double angle_rad) {
  constexpr double kLargest = 0.5 * std::numbers::pi - 1e-3;
  const double angle = std::min(angle_rad, kLargest);
  return angle / (0.5 * std::numbers::pi - angle);
}

// One row of the projector's image: the nearest depth in each cell.
class ProjectorRow {
 public:
  // Disparities are at most max_shift_px.
  ProjectorRow(int columns, double max_shift_px)
      : shift_(max_shift_px + 1.0),
        nearest_(static_cast<std::size_t>((columns + shift_ + 1.0) * kCellsPerPixel) + 2) {}

  void Clear() { std::fill(nearest_.begin(), nearest_.end(), kNothing); }
  void Draw(double from_column, float from_z, double to_column, float to_z) {
    const int first = Cell(from_column), last = Cell(to_column);
    const int low = std::min(first, last), high = std::max(first, last);
    for (int cell = low; cell <= high; ++cell) {
      const float share =
          high == low ? 0.0f : static_cast<float>(cell - first) / static_cast<float>(last - first);
      nearest_[cell] = std::min(nearest_[cell], from_z + share * (to_z - from_z));
    }
  }
  float At(double column) const { return nearest_[Cell(column)]; }

 private:
  static constexpr float kNothing = std::numeric_limits<float>::infinity();
  int Cell(double column) const {
    return static_cast<int>(std::floor((column + shift_) * kCellsPerPixel + 0.5));
  }
  double shift_;
  std::vector<float> nearest_;
};

// Random draws for every pixel, so that no setting changes the noise of other pixels. Those of
// pixels outside of the box are not needed and hold 0.
struct PatternDraws {
  Image<double> across, down, along;  // standard normal
  Image<double> luck;                 // even in [0, 1)
};

PatternDraws DrawPatternNoise(const DepthImage& depth, const PixelBox& box, int shared_px,
                              RandomStream& random) {
  const Image<double> empty(depth.width(), depth.height());
  PatternDraws draws{empty, empty, empty, empty};
  const PixelBox shared = box.Grown(shared_px, depth);
  NormalDraws normals(random);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const bool is_inside = box.Contains(u, v);
      draws.across(u, v) = normals.Next(is_inside);
      draws.down(u, v) = normals.Next(is_inside);
      draws.along(u, v) = normals.Next(shared.Contains(u, v));
      draws.luck(u, v) = random.Uniform();
    }
  }
  draws.along = SharedNoise(draws.along, shared_px);
  return draws;
}

// An empty pixel measures an edge that is displaced onto it.
PixelBox BoxOfDisplacedEdges(const DepthImage& depth, const StructuredLightSettings& settings,
                             double pixels_per_native) {
  constexpr double kLargestNormal = 8.6;  // √(2 · 53 ln 2), of a uniform number of 53 bits
  const double farthest_px = kLargestNormal * LateralDeviationPx(settings, 0.0) * pixels_per_native;
  return MeasuredBox(depth, static_cast<int>(std::ceil(farthest_px)));
}

}  // namespace

void StructuredLightSettings::Describe(Fields& f) {
  f.Number("axial_base_m", axial_base_m,
           {.meaning = "standard deviation of depth at axial_near_m",
            .unit = "m",
            .min = 0,
            .max = 1,
            .origin = Origin::kPaper,
            .source = kNguyen});
  f.Number(
      "axial_growth_per_m", axial_growth_per_m,
      {.meaning = "growth of the depth noise with the square of the distance from axial_near_m",
       .unit = "1/m",
       .min = 0,
       .max = 1,
       .origin = Origin::kPaper,
       .source = kNguyen});
  f.Number("axial_near_m", axial_near_m,
           {.meaning = "distance at which depth is most accurate",
            .unit = "m",
            .min = 0,
            .max = 10,
            .origin = Origin::kPaper,
            .source = kNguyen});
  f.Number(
      "axial_slope", axial_slope,
      {.meaning = "factor of the depth noise's term in the viewing angle θ, θ² / (π/2 − θ)² / √z",
       .unit = "m^1.5",
       .min = 0,
       .max = 1,
       .origin = Origin::kPaper,
       .source = kNguyen});
  f.Number("lateral_base_px", lateral_base_px,
           {.meaning = "standard deviation of an edge's place, in the sensor's own pixels",
            .unit = "px",
            .min = 0,
            .max = 20,
            .origin = Origin::kPaper,
            .source = kNguyen});
  f.Number("lateral_slope_px", lateral_slope_px,
           {.meaning = "growth of the edge noise with the viewing angle θ, factor of θ / (π/2 − θ)",
            .unit = "px",
            .min = 0,
            .max = 20,
            .origin = Origin::kPaper,
            .source = kNguyen});
  f.Number("native_focal_px", native_focal_px,
           {.meaning = "focal length of the sensor's own image of 640 columns, in which disparity "
                       "and edges are measured; stored images may be smaller",
            .unit = "px",
            .min = 10,
            .max = 1e4,
            .origin = Origin::kPaper,
            .source = "Khoshelham & Elberink 2012: about 580"});
  f.Number("baseline_m", baseline_m,
           {.meaning = "distance of the projector along the camera's x axis",
            .unit = "m",
            .min = 1e-3,
            .max = 1,
            .origin = Origin::kPaper,
            .source = "Khoshelham & Elberink 2012: 7.5 cm"});
  f.Number("disparity_step_px", disparity_step_px,
           {.meaning = "quantisation step of disparity",
            .unit = "px",
            .min = 1e-6,
            .max = 8,
            .origin = Origin::kPaper,
            .source = "Khoshelham & Elberink 2012: 1/8, which is 2.6 cm at 3 m"});
  f.Number("shadow_margin_m", shadow_margin_m,
           {.meaning =
                "depth behind the first surface from which on the projector's light does not reach",
            .unit = "m",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "above the depth step within a limb, below the gap between limbs"});
  f.Number("edge_loss", edge_loss,
           {.meaning = "share of the pixels at depth edges that are not measured",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "correlation windows that straddle an edge often match nothing"});
  f.Number("max_angle_deg", max_angle_deg,
           {.meaning = "surfaces seen at a larger angle are not measured",
            .unit = "deg",
            .min = 1,
            .max = 90,
            .origin = Origin::kGuessed,
            .source = "about the largest angle of Nguyen's measurements"});
  f.Number("min_depth_m", min_depth_m,
           {.meaning = "minimum distance that is measured",
            .unit = "m",
            .min = 0,
            .max = 100,
            .origin = Origin::kGuessed,
            .source = "the camera's near mode"});
  f.Number("max_depth_m", max_depth_m,
           {.meaning = "maximum distance that is measured",
            .unit = "m",
            .min = 0.1,
            .max = 100,
            .origin = Origin::kGuessed,
            .source = "drivers report up to 8 to 10 m"});
}

double AxialDeviation(const StructuredLightSettings& s, double z_m, double angle_rad) {
  const double beyond = z_m - s.axial_near_m;
  const double grazing = Grazing(angle_rad);
  return s.axial_base_m + s.axial_growth_per_m * beyond * beyond +
         s.axial_slope / std::sqrt(z_m) * grazing * grazing;
}

double LateralDeviationPx(const StructuredLightSettings& s, double angle_rad) {
  return s.lateral_base_px + s.lateral_slope_px * Grazing(angle_rad);
}

double DepthStep(const StructuredLightSettings& s, double z_m) {
  return z_m * z_m * s.disparity_step_px / (s.native_focal_px * s.baseline_m);
}

double QuantizedDepth(const StructuredLightSettings& s, double z_m) {
  if (!(z_m > 0.0)) return 0.0;
  const double steps = std::round(s.native_focal_px * s.baseline_m / z_m / s.disparity_step_px);
  return steps < 1.0 ? 0.0 : s.native_focal_px * s.baseline_m / (steps * s.disparity_step_px);
}

MaskImage ProjectorShadow(const DepthImage& depth, const PinholeCamera& camera,
                          const StructuredLightSettings& settings) {
  MaskImage shadow(depth.width(), depth.height());
  float nearest = std::numeric_limits<float>::infinity();
  for (const float z : depth.pixels()) nearest = z > 0.0f ? std::min(nearest, z) : nearest;
  if (std::isinf(nearest)) return shadow;

  const double shift_m = camera.fx * settings.baseline_m;
  const auto projected = [&](int u, float z) { return u - shift_m / double{z}; };
  ProjectorRow row(depth.width(), shift_m / double{nearest});
  for (int v = 0; v < depth.height(); ++v) {
    row.Clear();
    for (int u = 0; u < depth.width(); ++u) {
      const float z = depth(u, v);
      if (!(z > 0.0f)) continue;
      const bool goes_on = u + 1 < depth.width() && AreOnOneSurface(z, depth(u + 1, v));
      const int end = goes_on ? u + 1 : u;
      row.Draw(projected(u, z), z, projected(end, depth(end, v)), depth(end, v));
    }
    for (int u = 0; u < depth.width(); ++u) {
      const float z = depth(u, v);
      if (!(z > 0.0f)) continue;
      shadow(u, v) = z - row.At(projected(u, z)) > static_cast<float>(settings.shadow_margin_m);
    }
  }
  return shadow;
}

DepthImage MeasureByStructuredLight(const DepthImage& true_depth, const PinholeCamera& camera,
                                    const StructuredLightSettings& settings, int shared_px,
                                    RandomStream& random) {
  const double pixels_per_native = camera.fx / settings.native_focal_px;
  const PixelBox box = BoxOfDisplacedEdges(true_depth, settings, pixels_per_native);
  const PatternDraws draws = DrawPatternNoise(true_depth, box, shared_px, random);
  const Image<float> angles = IncidenceAngles(true_depth, camera);
  const MaskImage shadow = ProjectorShadow(true_depth, camera, settings);
  const double max_angle_rad = settings.max_angle_deg * std::numbers::pi / 180.0;

  DepthImage measured(true_depth.width(), true_depth.height());
  for (int v = box.top; v < box.bottom; ++v) {
    for (int u = box.left; u < box.right; ++u) {
      // An edge is displaced laterally. Within a surface the displacement is not applied, because
      // the published deviation of depth already includes its effect.
      int from_u = u, from_v = v;
      const double lateral = LateralDeviationPx(settings, double{angles(u, v)}) * pixels_per_native;
      const int moved_u = u + static_cast<int>(std::lround(draws.across(u, v) * lateral));
      const int moved_v = v + static_cast<int>(std::lround(draws.down(u, v) * lateral));
      if (true_depth.Contains(moved_u, moved_v) &&
          !AreOnOneSurface(true_depth(u, v), true_depth(moved_u, moved_v))) {
        from_u = moved_u;
        from_v = moved_v;
      }
      const double z = true_depth(from_u, from_v), angle = angles(from_u, from_v);
      if (!(z > 0 && z >= settings.min_depth_m && z <= settings.max_depth_m) ||
          angle > max_angle_rad || shadow(from_u, from_v) != 0 ||
          (draws.luck(u, v) < settings.edge_loss && IsAtEdge(true_depth, from_u, from_v))) {
        continue;
      }
      // The published deviation includes quantisation, so that part is subtracted.
      const double total = AxialDeviation(settings, z, angle), step = DepthStep(settings, z);
      const double before = std::sqrt(std::max(total * total - step * step / 12.0, 0.0));
      measured(u, v) = static_cast<float>(QuantizedDepth(settings, z + draws.along(u, v) * before));
    }
  }
  return measured;
}

}  // namespace vitruvia
