#include "cutout/room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <opencv2/imgproc.hpp>

#include "core/random.h"

namespace vitruvia {
namespace {

constexpr float kBeyondRange = std::numeric_limits<float>::infinity();

bool HoldsMeasurements(const DepthImage& depth) {
  return std::any_of(depth.pixels().begin(), depth.pixels().end(), [](float z) { return z > 0; });
}

std::vector<const DepthImage*> Measured(const std::vector<DepthImage>& frames) {
  std::vector<const DepthImage*> measured;
  for (const DepthImage& frame : frames) {
    if (HoldsMeasurements(frame)) measured.push_back(&frame);
  }
  return measured;
}

// The mean of those depths that differ from one of them by noise. A quantile alone is off by up to
// half a step of a sensor that measures in steps.
float MeanNear(const std::vector<float>& depths, float depth, float within_m) {
  double sum = 0.0;
  int count = 0;
  for (const float other : depths) {
    if (std::abs(other - depth) > within_m) continue;
    sum += other;
    ++count;
  }
  return static_cast<float>(sum / count);
}

// Per pixel the mean of the measured depths round a quantile.
DepthImage FarDepths(const std::vector<const DepthImage*>& frames, double share, double seen_share,
                     const Room& room, double sigmas) {
  const PinholeCamera& camera = room.camera;
  DepthImage far(camera.width, camera.height);
  std::vector<float> depths;
  for (std::size_t i = 0; i < far.pixels().size(); ++i) {
    depths.clear();
    for (const DepthImage* frame : frames) {
      if (frame->pixels()[i] > 0.0f) depths.push_back(frame->pixels()[i]);
    }
    if (static_cast<double>(depths.size()) < seen_share * static_cast<double>(frames.size()) ||
        depths.empty()) {
      far.pixels()[i] = kBeyondRange;
      continue;
    }
    const auto at = depths.begin() + std::lround(share * static_cast<double>(depths.size() - 1));
    std::nth_element(depths.begin(), at, depths.end());
    far.pixels()[i] = MeanNear(depths, *at, static_cast<float>(sigmas) * room.NoiseAt(*at));
  }
  return far;
}

// Differences of depth at one pixel up to this are noise, beyond it motion.
constexpr float kLargestNoise_m = 0.1f;
constexpr int kEveryPixel = 7;           // looked at
constexpr double kShare = 0.8;           // quantile of |difference|: most of what moves is above it
constexpr double kShareSigmas = 1.8124;  // the same of a difference of two normal numbers

// From pixels of consecutive frames; `fallback` where there are too few.
double NoiseAt1m(const std::vector<const DepthImage*>& frames, double fallback) {
  constexpr std::size_t kFewest = 1000;
  std::vector<float> differences;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const std::vector<float>&before = frames[k - 1]->pixels(), &now = frames[k]->pixels();
    for (std::size_t i = 0; i < now.size(); i += kEveryPixel) {
      if (!(before[i] > 0.0f && now[i] > 0.0f)) continue;
      const float difference = std::abs(now[i] - before[i]);
      if (difference < kLargestNoise_m) differences.push_back(difference / (now[i] * now[i]));
    }
  }
  if (differences.size() < kFewest) return fallback;
  const auto at = differences.begin() +
                  static_cast<std::ptrdiff_t>(kShare * static_cast<double>(differences.size()));
  std::nth_element(differences.begin(), at, differences.end());
  return double{*at} / kShareSigmas;
}

// Points of random pixels of random frames.
std::vector<Vector3f> SampledPoints(const std::vector<const DepthImage*>& frames,
                                    const PinholeCamera& camera, const CutoutSettings& settings,
                                    RandomStream& random) {
  std::vector<Vector3f> points;
  if (frames.empty()) return points;
  const auto pixels = static_cast<std::uint64_t>(camera.width) * camera.height;
  for (int i = 0; i < settings.floor.points; ++i) {
    const DepthImage& frame = *frames[random.Index(frames.size())];
    const auto pixel = static_cast<int>(random.Index(pixels));
    const float z = frame.pixels()[static_cast<std::size_t>(pixel)];
    if (!(z > 0.0f) || z > settings.far_m) continue;
    const int u = pixel % camera.width, v = pixel / camera.width;
    points.push_back(camera.Unproject(static_cast<float>(u), static_cast<float>(v), z));
  }
  return points;
}

std::optional<FloorPlane> PlaneThrough(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
  constexpr float kSmallestArea_m2 = 0.01f;  // of the parallelogram: no plane through one spot
  Vector3f normal = (b - a).cross(c - a);
  if (normal.norm() < kSmallestArea_m2) return std::nullopt;
  normal.normalize();
  if (normal.y() > 0.0f) normal = -normal;
  FloorPlane plane;
  plane.up = normal;
  plane.height_m = -normal.dot(a);
  return plane;
}

// Standard deviation of a floor point's height: the noise along the ray, projected on the floor's
// normal.
float FloorNoise(const FloorPlane& floor, const Vector3f& point, double noise_at_1m_m) {
  return static_cast<float>(noise_at_1m_m) * point.z() * std::abs(floor.up.dot(point));
}

struct Support {
  int in_plane = 0, below = 0;
};

Support SupportOf(const FloorPlane& plane, const std::vector<Vector3f>& points, double noise,
                  const CutoutSettings& s) {
  Support support;
  for (const Vector3f& point : points) {
    const float within =
        std::max(static_cast<float>(s.floor.within_m),
                 static_cast<float>(s.noise_sigmas) * FloorNoise(plane, point, noise));
    const float height = plane.HeightOf(point);
    support.in_plane += std::abs(height) <= within ? 1 : 0;
    support.below += height < -2.0f * within ? 1 : 0;
  }
  return support;
}

// The plane of least squares through the points that lie near it; nothing if they lie along a line,
// as a strip of a noisy wall does.
std::optional<FloorPlane> Refined(const FloorPlane& plane, const std::vector<Vector3f>& points,
                                  double noise, const CutoutSettings& s) {
  std::vector<Vector3f> in_plane;
  Vector3f mean = Vector3f::Zero();
  for (const Vector3f& point : points) {
    const float within =
        std::max(static_cast<float>(s.floor.within_m),
                 static_cast<float>(s.noise_sigmas) * FloorNoise(plane, point, noise));
    if (std::abs(plane.HeightOf(point)) > within) continue;
    in_plane.push_back(point);
    mean += point;
  }
  if (in_plane.size() < 3) return plane;
  mean /= static_cast<float>(in_plane.size());
  Matrix3<double> spread = Matrix3<double>::Zero();
  for (const Vector3f& point : in_plane) {
    const Vector3d d = (point - mean).cast<double>();
    spread += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3<double>> axes(spread);
  constexpr double kLeastWidth = 10.0;  // of the points, in multiples of their thickness; guessed
  if (axes.eigenvalues()(1) < kLeastWidth * kLeastWidth * axes.eigenvalues()(0))
    return std::nullopt;
  FloorPlane refined;
  refined.up = axes.eigenvectors().col(0).cast<float>();
  if (refined.up.y() > 0.0f) refined.up = -refined.up;
  refined.height_m = -refined.up.dot(mean);
  refined.share = static_cast<double>(in_plane.size()) / static_cast<double>(points.size());
  return refined;
}

std::vector<Vector3f> LowerHalf(std::vector<Vector3f> points) {
  const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  std::nth_element(points.begin(), middle, points.end(),
                   [](const Vector3f& a, const Vector3f& b) { return a.y() > b.y(); });
  points.erase(middle, points.end());
  return points;
}

bool IsLevelBelowCamera(const FloorPlane& plane, const FloorSettings& s) {
  return -plane.up.y() >= std::cos(s.tilt_deg * std::numbers::pi / 180.0) && plane.height_m > 0.0f;
}

// Whether enough of all points lie in a plane, and few under it.
bool IsFloorsSupport(const Support& support, std::size_t points, const FloorSettings& s) {
  const auto all = static_cast<double>(points);
  return support.in_plane >= s.least_share * all && support.below <= s.below_share * all;
}

// The plane after some fits of least squares; nothing if it turns into no floor, as a strip of a
// wall does.
std::optional<FloorPlane> RefinedFloor(FloorPlane plane, const std::vector<Vector3f>& points,
                                       double noise, const CutoutSettings& s) {
  constexpr int kRefinements = 3;
  for (int i = 0; i < kRefinements; ++i) {
    const std::optional<FloorPlane> refined = Refined(plane, points, noise, s);
    if (!refined) return std::nullopt;
    plane = *refined;
  }
  if (!IsLevelBelowCamera(plane, s.floor) ||
      !IsFloorsSupport(SupportOf(plane, points, noise, s), points.size(), s.floor))
    return std::nullopt;
  return plane;
}

// RANSAC: the plane that most points support, among those that may be a floor before and after they
// are refined.
std::optional<FloorPlane> FindFloor(const std::vector<const DepthImage*>& frames,
                                    const PinholeCamera& camera, double noise,
                                    const CutoutSettings& s) {
  RandomStream random(static_cast<std::uint64_t>(s.seed), "cutout/floor");
  const std::vector<Vector3f> points = SampledPoints(frames, camera, s, random);
  const std::vector<Vector3f> low = LowerHalf(points);
  std::optional<FloorPlane> best;
  int most = 0;
  for (int trial = 0; trial < s.floor.trials && low.size() >= 3; ++trial) {
    const auto any = [&]() -> const Vector3f& { return low[random.Index(low.size())]; };
    const Vector3f &a = any(), &b = any(), &c = any();
    const std::optional<FloorPlane> plane = PlaneThrough(a, b, c);
    if (!plane || !IsLevelBelowCamera(*plane, s.floor)) continue;
    const Support support = SupportOf(*plane, points, noise, s);
    if (support.in_plane <= most || !IsFloorsSupport(support, points.size(), s.floor)) continue;
    const std::optional<FloorPlane> refined = RefinedFloor(*plane, points, noise, s);
    if (!refined) continue;
    most = support.in_plane;
    best = refined;
  }
  return best;
}

// Nothing where the background is not known or beyond range.
std::optional<RoomDepth> BackgroundAt(const Room& room, const CutoutSettings& s, int u, int v) {
  const float depth_m = room.background(u, v);
  if (!(depth_m > 0.0f && depth_m < kBeyondRange)) return std::nullopt;
  return RoomDepth{depth_m, std::max(static_cast<float>(s.background.margin_m),
                                     static_cast<float>(s.noise_sigmas) * room.NoiseAt(depth_m))};
}

bool HasNeighbour(const MaskImage& foreground, int u, int v) {
  const auto holds = [&](int x, int y) {
    return foreground.Contains(x, y) && foreground(x, y) != 0;
  };
  return holds(u - 1, v) || holds(u + 1, v) || holds(u, v - 1) || holds(u, v + 1);
}

// Drops single pixels of the floor that noise lifts out of it: they are spread over all of it.
void DropSpecks(const MaskImage& certain, MaskImage& foreground) {
  for (int v = 0; v < foreground.height(); ++v) {
    for (int u = 0; u < foreground.width(); ++u) {
      if (foreground(u, v) != 0 && certain(u, v) == 0 && !HasNeighbour(foreground, u, v))
        foreground(u, v) = 0;
    }
  }
}

// The foreground's pixels that are not certainly above the floor, and what is within reach of them.
cv::Rect ReachOfLow(const DepthImage& depth, const MaskImage& certain, const MaskImage& foreground,
                    float reach_px_m) {
  cv::Rect low;
  float nearest_m = kBeyondRange;
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (foreground(u, v) == 0 || certain(u, v) != 0) continue;
      low |= cv::Rect(u, v, 1, 1);
      nearest_m = std::min(nearest_m, depth(u, v));
    }
  }
  if (low.empty()) return low;
  const int reach_px = static_cast<int>(std::ceil(reach_px_m / nearest_m));
  return cv::Rect(low.x - reach_px, low.y - reach_px, low.width + 2 * reach_px,
                  low.height + 2 * reach_px) &
         cv::Rect(0, 0, depth.width(), depth.height());
}

// Keeps pixels that are certainly above the floor, and lower ones near them.
void KeepNearCertain(const DepthImage& depth, const MaskImage& certain,
                     const FloorSettings& settings, const PinholeCamera& camera,
                     MaskImage& foreground) {
  DropSpecks(certain, foreground);
  const auto reach_px_m = static_cast<float>(settings.reach_m * camera.fy);
  const cv::Rect part = ReachOfLow(depth, certain, foreground, reach_px_m);
  if (part.empty()) return;
  const cv::Mat from(depth.height(), depth.width(), CV_8UC1,
                     const_cast<std::uint8_t*>(certain.pixels().data()));
  cv::Mat others, distance_px;
  cv::compare(from(part), 0, others, cv::CMP_EQ);
  cv::distanceTransform(others, distance_px, cv::DIST_L2, cv::DIST_MASK_3, CV_32F);
  for (int v = part.y; v < part.y + part.height; ++v) {
    const auto* row_px = distance_px.ptr<float>(v - part.y);
    for (int u = part.x; u < part.x + part.width; ++u) {
      const bool is_far = row_px[u - part.x] * depth(u, v) > reach_px_m;
      if (foreground(u, v) != 0 && is_far) foreground(u, v) = 0;
    }
  }
}

}  // namespace

double FloorPlane::TiltDegrees() const {
  return std::acos(std::min(1.0f, -up.y())) * 180.0 / std::numbers::pi;
}

Room LearnRoom(const std::vector<DepthImage>& frames, const std::vector<DepthImage>& empty,
               const PinholeCamera& camera, const CutoutSettings& settings) {
  const std::vector<const DepthImage*> measured = Measured(frames);
  const std::vector<const DepthImage*> without_person = Measured(empty);
  Room room;
  room.camera = camera;
  room.background = DepthImage(camera.width, camera.height);
  room.noise_at_1m_m =
      NoiseAt1m(without_person.empty() ? measured : without_person, settings.noise_at_1m_m);
  constexpr double kMedian = 0.5;
  const BackgroundSettings& b = settings.background;
  if (b.source == BackgroundSource::kRecording && measured.size() > 1)
    room.background = FarDepths(measured, b.far_share, b.seen_share, room, settings.noise_sigmas);
  if (b.source == BackgroundSource::kEmptyFrames)
    room.background = FarDepths(without_person, kMedian, b.seen_share, room, settings.noise_sigmas);
  if (settings.floor.remove) {
    room.floor = FindFloor(without_person.empty() ? measured : without_person, camera,
                           room.noise_at_1m_m, settings);
  }
  return room;
}

RoomDepth RoomDepthAt(const Room& room, const CutoutSettings& s, int u, int v) {
  if (const auto background = BackgroundAt(room, s, u, v)) return *background;
  if (!room.floor) return {kBeyondRange, 0.0f};
  const float descent = -room.floor->up.dot(
      room.camera.Unproject(static_cast<float>(u), static_cast<float>(v), 1.0f));
  if (descent <= 0.0f) return {kBeyondRange, 0.0f};
  const float floor = room.floor->height_m / descent;
  return {floor, std::max(static_cast<float>(s.floor.margin_m) / descent,
                          static_cast<float>(s.noise_sigmas) * room.NoiseAt(floor))};
}

MaskImage ForegroundOf(const DepthImage& depth, const Room& room, const CutoutSettings& s) {
  MaskImage foreground(depth.width(), depth.height());
  MaskImage certain(depth.width(), depth.height());
  const auto near = static_cast<float>(s.near_m), far = static_cast<float>(s.far_m);
  const auto sigmas = static_cast<float>(s.noise_sigmas);
  const auto floor_margin = static_cast<float>(s.floor.margin_m);
  const auto certain_height = static_cast<float>(s.floor.certain_m);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const float z = depth(u, v);
      if (!(z >= near && z <= far)) continue;
      const std::optional<RoomDepth> background = BackgroundAt(room, s, u, v);
      if (background && z > background->depth_m - background->margin_m) continue;
      float height = kBeyondRange;
      if (room.floor) {
        const Vector3f point =
            room.camera.Unproject(static_cast<float>(u), static_cast<float>(v), z);
        height = room.floor->HeightOf(point);
        const float noise = FloorNoise(*room.floor, point, room.noise_at_1m_m);
        if (!background && height < std::max(floor_margin, sigmas * noise)) continue;
      }
      foreground(u, v) = 255;
      if (height > certain_height) certain(u, v) = 255;
    }
  }
  if (room.floor) KeepNearCertain(depth, certain, s.floor, room.camera, foreground);
  return foreground;
}

}  // namespace vitruvia
