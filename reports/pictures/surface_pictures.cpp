#include "reports/pictures/surface_pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "math/rotation.h"
#include "reports/drawing/color_maps.h"

namespace vitruvia {
namespace {

constexpr double kViewDistance_m = 8.0;  // far: little perspective
constexpr double kPanelMargin = 1.08;
constexpr double kSmallestSurfaceScale_m = 0.002;

// A camera in front of the subject's place; its picture is chosen by the window.
PinholeCamera ViewCamera() {
  return {.width = 1000, .height = 1000, .fx = 1000.0, .fy = 1000.0, .cx = 500.0, .cy = 500.0};
}

// From the subject frame to the view's, the subject turned about the vertical first.
std::vector<Vector3f> InView(const std::vector<Vector3f>& vertices, double turn_deg) {
  const auto angle = static_cast<float>(turn_deg * std::numbers::pi / 180.0);
  const Matrix3<float> turn = ExpSo3<float>({0.0f, angle, 0.0f});
  std::vector<Vector3f> seen;
  seen.reserve(vertices.size());
  for (const Vector3f& v : vertices) {
    const Vector3f turned = turn * v;
    seen.emplace_back(turned.x(), -turned.y(), static_cast<float>(kViewDistance_m) - turned.z());
  }
  return seen;
}

// What all panels of all strips show, so that they have one scale.
Eigen::AlignedBox3f BoxAround(const std::vector<SurfaceStrip>& strips) {
  Eigen::AlignedBox3f box;
  for (const SurfaceStrip& strip : strips) {
    for (const SurfacePanel& panel : strip.panels) {
      for (const ShownSurface& surface : panel.surfaces) {
        for (const Vector3f& v : InView(surface.mesh.vertices, panel.turn_deg)) {
          box.extend(v);
        }
      }
    }
  }
  return box;
}

// 0 where no panel shows errors.
double ErrorScale(const std::vector<SurfaceStrip>& strips) {
  std::vector<double> errors;
  for (const SurfaceStrip& strip : strips) {
    for (const SurfacePanel& panel : strip.panels) {
      for (const ShownSurface& surface : panel.surfaces) {
        if (surface.color != SurfaceColor::kError) continue;
        errors.insert(errors.end(), surface.values.begin(), surface.values.end());
      }
    }
  }
  return errors.empty() ? 0.0 : ErrorScaleEnd(std::move(errors), kSmallestSurfaceScale_m);
}

Color BlendedBoneColor(float value) {
  const int bone = static_cast<int>(std::floor(value));
  const double share = value - std::floor(value);
  const Color a = BoneColor(bone), b = BoneColor(bone + 1);
  Color blend;
  for (int c = 0; c < 3; ++c)
    blend[c] = static_cast<std::uint8_t>(std::lround((1.0 - share) * a[c] + share * b[c]));
  return blend;
}

std::vector<Color> ColorsOf(const ShownSurface& surface, double error_scale_m) {
  if (surface.color == SurfaceColor::kTruth) return {kTruthColor};
  if (surface.color == SurfaceColor::kEstimate) return {kEstimateColor};
  std::vector<Color> colors;
  colors.reserve(surface.values.size());
  for (const float value : surface.values) {
    colors.push_back(surface.color == SurfaceColor::kError ? ErrorColor(value / error_scale_m)
                                                           : BlendedBoneColor(value));
  }
  return colors;
}

ColorImage DrawPanel(const SurfacePanel& panel, const PictureWindow& window, double error_scale_m,
                     MeshView& view) {
  std::vector<std::vector<Vector3f>> vertices;
  for (const ShownSurface& surface : panel.surfaces)
    vertices.push_back(InView(surface.mesh.vertices, panel.turn_deg));
  std::vector<ShadedMesh> meshes;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    meshes.push_back({&vertices[i], &panel.surfaces[i].mesh.triangles,
                      ColorsOf(panel.surfaces[i], error_scale_m)});
  }
  return OnWhite(view.Draw(ViewCamera(), window, meshes));
}

}  // namespace

void DrawSurfaceStrips(const std::vector<SurfaceStrip>& strips, MeshView& view, RunPictures& run) {
  const Eigen::AlignedBox3f box = BoxAround(strips);
  const Vector3f middle = box.center();
  const double pixels_per_m = ViewCamera().fx / kViewDistance_m;
  const double extent =
      kPanelMargin * pixels_per_m * static_cast<double>(box.sizes().head<2>().maxCoeff());
  const PictureWindow window{ViewCamera().cx + 0.5 + pixels_per_m * middle.x() - 0.5 * extent,
                             ViewCamera().cy + 0.5 + pixels_per_m * middle.y() - 0.5 * extent,
                             extent, extent};
  run.error_scale_m = ErrorScale(strips);
  for (const SurfacePanel& panel : strips.front().panels) run.titles.push_back(panel.title);
  for (const SurfaceStrip& strip : strips) {
    PictureStrip& drawn = run.strips.emplace_back();
    drawn.label = strip.label;
    drawn.note = strip.note;
    for (const SurfacePanel& panel : strip.panels)
      drawn.pictures.emplace_back(DrawPanel(panel, window, run.error_scale_m, view));
  }
}

void DrawSurfaceStrips(const std::filesystem::path& run_folder, MeshView& view, RunPictures& run) {
  std::vector<SurfaceStrip> strips;
  try {
    strips = ReadSurfaceStrips(run_folder);
  } catch (const DataError& error) {
    run.problem = error.what();
    return;
  }
  if (strips.empty()) {
    run.problem = "the run left no surfaces";
    return;
  }
  DrawSurfaceStrips(strips, view, run);
}

}  // namespace vitruvia
