#include "methods/capsule_icp/capsule_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitruvia::capsule_icp {
namespace {

// Directions across the capsule's axis, right-handed with it.
struct Frame {
  Vector3d axis, across, third;
};

Frame FrameOf(const Capsule& capsule) {
  const Vector3d axis = (capsule.end - capsule.start).normalized();
  const Vector3d across = axis.unitOrthogonal();
  return {axis, across, axis.cross(across)};
}

// Latitudes of a round end, from the ring where it meets the side to its pole: sine and cosine of
// the angle from the axis' plane.
Vector3d OnSphere(const Frame& frame, const Vector3d& center, double radius, double latitude,
                  double longitude) {
  return center + radius * (std::sin(latitude) * frame.axis +
                            std::cos(latitude) * (std::cos(longitude) * frame.across +
                                                  std::sin(longitude) * frame.third));
}

double Taper(const Capsule& c) {
  return std::asin(std::clamp(
      (c.start_radius_m - c.end_radius_m) / std::max((c.end - c.start).norm(), 1e-9), -0.99, 0.99));
}

// Rings from the pole of the start to that of the end; the side lies between two of them.
struct Ring {
  Vector3d center;
  double radius, latitude;
};

std::vector<Ring> RingsOf(const Capsule& c, int round_rings, int side_rings) {
  std::vector<Ring> rings;
  const double taper = Taper(c), quarter = std::numbers::pi / 2.0;
  for (int i = 0; i <= round_rings; ++i) {
    rings.push_back({c.start, c.start_radius_m,
                     std::lerp(-quarter, taper, static_cast<double>(i) / round_rings)});
  }
  for (int i = 1; i < side_rings; ++i) {
    const double t = static_cast<double>(i) / side_rings;
    rings.push_back(
        {c.start + t * (c.end - c.start), std::lerp(c.start_radius_m, c.end_radius_m, t), taper});
  }
  for (int i = 0; i <= round_rings; ++i) {
    rings.push_back(
        {c.end, c.end_radius_m, std::lerp(taper, quarter, static_cast<double>(i) / round_rings)});
  }
  return rings;
}

}  // namespace

std::vector<SurfaceSample> SampleCapsules(const std::vector<Capsule>& capsules, double spacing_m) {
  constexpr double kCovered_m = -0.005;  // inside another capsule by more than that
  std::vector<SurfaceSample> samples;
  const auto count = [&](double length) {
    return std::max(1, static_cast<int>(std::lround(length / spacing_m)));
  };
  for (std::size_t k = 0; k < capsules.size(); ++k) {
    const Capsule& c = capsules[k];
    const Frame frame = FrameOf(c);
    const double radius = std::max(c.start_radius_m, c.end_radius_m);
    const std::vector<Ring> rings =
        RingsOf(c, count(radius * std::numbers::pi / 2.0), count((c.end - c.start).norm()));
    for (const Ring& ring : rings) {
      const double around = 2.0 * std::numbers::pi * ring.radius * std::cos(ring.latitude);
      const int steps = count(around);
      for (int i = 0; i < steps; ++i) {
        const Vector3d place = OnSphere(frame, ring.center, ring.radius, ring.latitude,
                                        2.0 * std::numbers::pi * i / steps);
        const bool is_covered =
            std::any_of(capsules.begin(), capsules.end(), [&](const Capsule& other) {
              return &other != &c && DistanceFrom(other, place).distance_m < kCovered_m;
            });
        if (!is_covered) samples.push_back({c.bone, place});
      }
    }
  }
  return samples;
}

CapsuleMesh Meshed(const std::vector<Capsule>& capsules, int corners) {
  CapsuleMesh result;
  auto& [vertices, triangles] = result.mesh;
  for (const Capsule& c : capsules) {
    const Frame frame = FrameOf(c);
    const std::vector<Ring> rings = RingsOf(c, corners / 4, 1);
    const auto first = static_cast<std::int32_t>(vertices.size());
    const auto count = static_cast<std::int32_t>(rings.size());
    // The first and the last ring are poles: one vertex each.
    const auto vertex = [&](std::int32_t ring, std::int32_t i) -> std::int32_t {
      if (ring == 0) return first;
      if (ring == count - 1) return first + 1 + (count - 2) * corners;
      return first + 1 + (ring - 1) * corners + i % corners;
    };
    for (std::int32_t r = 0; r < count; ++r) {
      const bool is_pole = r == 0 || r == count - 1;
      for (int i = 0; i < (is_pole ? 1 : corners); ++i) {
        vertices.push_back(OnSphere(frame, rings[r].center, rings[r].radius, rings[r].latitude,
                                    2.0 * std::numbers::pi * i / corners)
                               .cast<float>());
        result.bones.push_back(c.bone);
      }
    }
    for (std::int32_t r = 0; r + 1 < count; ++r) {
      for (std::int32_t i = 0; i < corners; ++i) {
        if (r > 0) triangles.push_back({vertex(r, i), vertex(r, i + 1), vertex(r + 1, i)});
        if (r + 2 < count) {
          triangles.push_back({vertex(r, i + 1), vertex(r + 1, i + 1), vertex(r + 1, i)});
        }
      }
    }
  }
  return result;
}

}  // namespace vitruvia::capsule_icp
