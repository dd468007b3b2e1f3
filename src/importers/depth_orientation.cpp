#include "importers/depth_orientation.h"

#include <utility>

#include <fmt/format.h>

#include "geometry/point_cloud.h"

namespace vitruvia {
namespace {

constexpr int kMostPixels = 1 << 15;  // of a side

int CroppedWidth(const CropSettings& crop, int width) {
  return crop.width > 0 ? crop.width : width - crop.left;
}
int CroppedHeight(const CropSettings& crop, int height) {
  return crop.height > 0 ? crop.height : height - crop.top;
}

DepthImage Cropped(const DepthImage& image, const CropSettings& crop) {
  DepthImage part(CroppedWidth(crop, image.width()), CroppedHeight(crop, image.height()));
  for (int v = 0; v < part.height(); ++v) {
    for (int u = 0; u < part.width(); ++u) part(u, v) = image(crop.left + u, crop.top + v);
  }
  return part;
}

DepthImage Mirrored(const DepthImage& image, Mirror mirror) {
  DepthImage result(image.width(), image.height());
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const int from_u = mirror == Mirror::kLeftRight ? image.width() - 1 - u : u;
      const int from_v = mirror == Mirror::kUpDown ? image.height() - 1 - v : v;
      result(u, v) = image(from_u, from_v);
    }
  }
  return result;
}

DepthImage TurnedClockwise(const DepthImage& image) {
  DepthImage result(image.height(), image.width());
  for (int v = 0; v < result.height(); ++v) {
    for (int u = 0; u < result.width(); ++u) result(u, v) = image(v, image.height() - 1 - u);
  }
  return result;
}

PinholeCamera TurnedClockwise(const PinholeCamera& c) {
  return {c.height, c.width, c.fy, c.fx, c.height - 1 - c.cy, c.cx};
}

int QuarterTurns(Turn turn) {
  switch (turn) {
    case Turn::kNone:
      return 0;
    case Turn::kClockwise90:
      return 1;
    case Turn::kHalf:
      return 2;
    case Turn::kCounterclockwise90:
      return 3;
  }
  return 0;
}

// Where the middle of a pixel lies in an image of another size.
double Rescaled(double coordinate, double factor) { return (coordinate + 0.5) * factor - 0.5; }

DepthImage Resized(const DepthImage& image, const ResizeSettings& resize) {
  DepthImage result(resize.width, resize.height);
  const double per_u = image.width() / double(resize.width);
  const double per_v = image.height() / double(resize.height);
  for (int v = 0; v < result.height(); ++v) {
    for (int u = 0; u < result.width(); ++u) {
      result(u, v) = SampleDepth(image, static_cast<float>(Rescaled(u, per_u)),
                                 static_cast<float>(Rescaled(v, per_v)),
                                 static_cast<float>(resize.smooth_within_m));
    }
  }
  return result;
}

PinholeCamera Resized(const PinholeCamera& c, const ResizeSettings& resize) {
  const double per_u = resize.width / double(c.width), per_v = resize.height / double(c.height);
  return {resize.width, resize.height,         c.fx * per_u,
          c.fy * per_v, Rescaled(c.cx, per_u), Rescaled(c.cy, per_v)};
}

}  // namespace

void CropSettings::Describe(Fields& f) {
  f.Integer("left", left,
            {.meaning = "first column kept", .unit = "px", .min = 0, .max = kMostPixels});
  f.Integer("top", top, {.meaning = "first row kept", .unit = "px", .min = 0, .max = kMostPixels});
  f.Integer("width", width,
            {.meaning = "columns kept; 0: all from the first one",
             .unit = "px",
             .min = 0,
             .max = kMostPixels});
  f.Integer("height", height,
            {.meaning = "rows kept; 0: all from the first one",
             .unit = "px",
             .min = 0,
             .max = kMostPixels});
}

void ResizeSettings::Describe(Fields& f) {
  f.Integer("width", width,
            {.meaning = "width of the new image; 0: not resized",
             .unit = "px",
             .min = 0,
             .max = kMostPixels});
  f.Integer("height", height,
            {.meaning = "height of the new image; 0: not resized",
             .unit = "px",
             .min = 0,
             .max = kMostPixels});
  f.Number("smooth_within_m", smooth_within_m,
           {.meaning = "neighbouring pixels whose depths differ by less than this lie on one "
                       "surface, and depth is interpolated between them",
            .unit = "m",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
}

std::string ResizeSettings::Problem() const {
  return (width == 0) == (height == 0)
             ? ""
             : fmt::format("resize to {}×{}: expected both above 0, or both 0", width, height);
}

void OrientationSettings::Describe(Fields& f) {
  f.Section("crop", crop, {.meaning = "the part of the stored image that is kept"});
  f.Choice(
      "mirror", mirror,
      {{"none", Mirror::kNone}, {"left_right", Mirror::kLeftRight}, {"up_down", Mirror::kUpDown}},
      {.meaning = "mirroring of the image, to undo that of a recording stored mirrored"});
  f.Choice("turn", turn,
           {{"none", Turn::kNone},
            {"clockwise_90", Turn::kClockwise90},
            {"180", Turn::kHalf},
            {"counterclockwise_90", Turn::kCounterclockwise90}},
           {.meaning = "rotation of the image that makes the person upright"});
  f.Section("resize", resize, {.meaning = "size of the sequence's images"});
}

std::string CropProblem(const CropSettings& crop, int width, int height) {
  const int right = crop.left + CroppedWidth(crop, width);
  const int bottom = crop.top + CroppedHeight(crop, height);
  if (crop.left < width && crop.top < height && right <= width && bottom <= height) return "";
  return fmt::format("crop: columns {} to {} and rows {} to {} are not all in an image of {}×{}",
                     crop.left, right - 1, crop.top, bottom - 1, width, height);
}

PinholeCamera OrientedCamera(const PinholeCamera& stored, const OrientationSettings& s) {
  PinholeCamera camera{CroppedWidth(s.crop, stored.width),
                       CroppedHeight(s.crop, stored.height),
                       stored.fx,
                       stored.fy,
                       stored.cx - s.crop.left,
                       stored.cy - s.crop.top};
  if (s.mirror == Mirror::kLeftRight) camera.cx = camera.width - 1 - camera.cx;
  if (s.mirror == Mirror::kUpDown) camera.cy = camera.height - 1 - camera.cy;
  for (int i = 0; i < QuarterTurns(s.turn); ++i) camera = TurnedClockwise(camera);
  return s.resize.width > 0 ? Resized(camera, s.resize) : camera;
}

DepthImage Oriented(const DepthImage& stored, const OrientationSettings& s) {
  const bool is_whole =
      s.crop.left == 0 && s.crop.top == 0 && s.crop.width == 0 && s.crop.height == 0;
  DepthImage image = is_whole ? stored : Cropped(stored, s.crop);
  if (s.mirror != Mirror::kNone) image = Mirrored(image, s.mirror);
  for (int i = 0; i < QuarterTurns(s.turn); ++i) image = TurnedClockwise(image);
  return s.resize.width > 0 ? Resized(image, s.resize) : image;
}

}  // namespace vitruvia
