#include "importers/depth_frames.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "geometry/image_file.h"
#include "importers/depth_recording.h"
#include "importers/pcd_file.h"
#include "importers/pixel_fit.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// The cloud's points must be seen at their pixels up to this, root mean square.
constexpr double kLargestFitResidual_px = 1.0;

void RequireSize(const fs::path& file, int width, int height, const PinholeCamera& camera) {
  if (width == camera.width && height == camera.height) return;
  const double factor = width / double(camera.width);
  const std::string cause =
      std::abs(height / double(camera.height) - factor) < 0.01
          ? fmt::format(
                "are the intrinsics those of another resolution? Scaled to this one they "
                "are fx {:.6g}, fy {:.6g}, cx {:.6g}, cy {:.6g}",
                camera.fx * factor, camera.fy * factor, (camera.cx + 0.5) * factor - 0.5,
                (camera.cy + 0.5) * factor - 0.5)
          : "is this another camera's, or turned by 90 degrees? `camera` is that of the stored "
            "image";
  throw DataError(fmt::format("{}: an image of {}×{} pixels, expected {}×{} as `camera` says; {}",
                              file.string(), width, height, camera.width, camera.height, cause));
}

// The intrinsics that the points of a cloud have must be those that were stated.
void RequireRays(const fs::path& file, const OrganisedCloud& cloud, const PinholeCamera& camera) {
  PixelFit columns, rows;
  double squared_px = 0.0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vector3d p = cloud.points[i].cast<double>();
    if (!(p.z() > 0.0) || !p.allFinite()) continue;
    const int u = static_cast<int>(i) % cloud.width, v = static_cast<int>(i) / cloud.width;
    columns.Add(p.x() / p.z(), u);
    rows.Add(p.y() / p.z(), v);
    squared_px += (camera.Project(p) - Eigen::Vector2d(u, v)).squaredNorm();
  }
  if (!columns.is_determined() || !rows.is_determined()) return;
  const double residual_px = std::sqrt(squared_px / static_cast<double>(columns.count()));
  if (residual_px <= kLargestFitResidual_px) return;
  throw DataError(fmt::format(
      "{}: the camera sees its points {:.3g} px from their pixels (root mean square), expected at "
      "most {} px; the points themselves say fx {:.6g}, fy {:.6g}, cx {:.6g}, cy {:.6g}",
      file.string(), residual_px, kLargestFitResidual_px, columns.focal(), rows.focal(),
      columns.center(), rows.center()));
}

// Another bit depth has another unit.
void RequireNumbers(const fs::path& file, const std::string& numbers, const std::string& expected) {
  if (expected.empty() || numbers == expected) return;
  throw DataError(fmt::format(
      "{}: an image of {}, expected {} as the first image of the recording has; is it another "
      "recording's?",
      file.string(), numbers, expected));
}

Image<float> StoredValues(const fs::path& file, const StoredDepth& stored) {
  const PinholeCamera& camera = stored.camera;
  if (!IsPcdFile(file)) {
    StoredImage image = ReadImageFile(file);
    RequireSize(file, image.values.width(), image.values.height(), camera);
    RequireNumbers(file, image.numbers, stored.numbers);
    return std::move(image.values);
  }
  const OrganisedCloud cloud = ReadOrganisedPcd(file);
  RequireSize(file, cloud.width, cloud.height, camera);
  RequireRays(file, cloud, camera);
  Image<float> values(cloud.width, cloud.height);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) values.pixels()[i] = cloud.points[i].z();
  return values;
}

}  // namespace

std::string StoredNumbers(const fs::path& file) {
  return IsPcdFile(file) ? "" : ReadImageFile(file).numbers;
}

DepthImage ReadDepthFrame(const fs::path& file, const StoredDepth& stored) {
  Image<float> depth = StoredValues(file, stored);
  std::vector<float> invalid(stored.invalid.begin(), stored.invalid.end());
  const auto unit = static_cast<float>(stored.unit_m);
  for (float& value : depth.pixels()) {
    const bool is_measured = value > 0.0f && std::isfinite(value) &&
                             std::find(invalid.begin(), invalid.end(), value) == invalid.end();
    value = is_measured ? value * unit : 0.0f;
  }
  return Oriented(depth, stored.orientation);
}

}  // namespace vitruvia
