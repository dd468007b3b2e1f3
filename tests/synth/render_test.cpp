#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "body/skinning.h"
#include "geometry/zbuffer.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "support/tiny_body.h"
#include "synth/render/depth_renderer.h"

namespace vitruvia {
namespace {

const PinholeCamera kCamera;  // 320×240
// An odd camera: not square, principal point off the middle and between pixels.
const PinholeCamera kOddCamera{123, 77, 140.0, 133.0, 50.3, 41.8};

struct Scene {
  std::vector<Vector3f> vertices;
  std::vector<Triangle> triangles;
};

Scene Quad(const Vector3f& a, const Vector3f& b, const Vector3f& c, const Vector3f& d) {
  return {{a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}};
}

DepthImage RenderWith(const PinholeCamera& camera, const Scene& scene) {
  return DepthRenderer(camera).Render(scene.vertices, scene.triangles);
}

// A wall that fills the view: z = z0 + a x + b y.
Scene Wall(float z0, float a, float b) {
  const auto corner = [&](float x, float y) { return Vector3f(x, y, z0 + a * x + b * y); };
  return Quad(corner(-3, -3), corner(3, -3), corner(3, 3), corner(-3, 3));
}

// Finely cut, so that its facets differ from the sphere by far less than what is asserted.
Scene Sphere(const Vector3f& center, float radius) {
  constexpr int kRings = 400, kSectors = 800;
  Scene s;
  for (int i = 0; i <= kRings; ++i) {
    for (int j = 0; j < kSectors; ++j) {
      const double polar = M_PI * i / kRings, around = 2.0 * M_PI * j / kSectors;
      const Vector3d direction(std::sin(polar) * std::cos(around), std::cos(polar),
                               std::sin(polar) * std::sin(around));
      s.vertices.push_back(center + radius * direction.cast<float>());
    }
  }
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < kSectors; ++j) {
      const int k = (j + 1) % kSectors, row = i * kSectors, next = row + kSectors;
      s.triangles.push_back({row + j, row + k, next + k});
      s.triangles.push_back({row + j, next + k, next + j});
    }
  }
  return s;
}

TEST(DepthRenderer, PlanesHaveTheirDepthAtPixelCentres) {
  const std::vector<std::array<float, 3>> walls{{2.0f, 0.0f, 0.0f}, {3.0f, 0.5f, -0.3f}};
  for (const PinholeCamera& camera : std::vector{kCamera, kOddCamera}) {
    for (const auto& [z0, a, b] : walls) {
      const DepthImage depth = RenderWith(camera, Wall(z0, a, b));
      ASSERT_EQ(depth.width(), camera.width);
      ASSERT_EQ(depth.height(), camera.height);
      double worst = 0.0;
      for (int v = 0; v < camera.height; ++v) {
        for (int u = 0; u < camera.width; ++u) {
          // z = z0 + a x + b y on the ray x = (u − cx)/fx z, y = (v − cy)/fy z.
          const double expected =
              z0 / (1.0 - a * (u - camera.cx) / camera.fx - b * (v - camera.cy) / camera.fy);
          worst = std::max(worst, std::abs(depth(u, v) - expected));
        }
      }
      // Half a pixel off would be 2 mm and more on the slanted wall.
      EXPECT_LT(worst, 3e-5) << "wall at " << z0;
    }
  }
}

TEST(DepthRenderer, SphereHasItsAnalyticDepthAndOutline) {
  const Vector3d center(0.31, -0.22, 2.5);
  const double radius = 0.6;
  const DepthImage depth = RenderWith(kCamera, Sphere(center.cast<float>(), 0.6f));
  double worst = 0.0;
  int outline_differs = 0, compared = 0;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const Vector3d ray = kCamera.Unproject<double>(u, v, 1.0);
      // |t ray − center| = radius; t is z.
      const double a = ray.squaredNorm(), b = ray.dot(center);
      const double discriminant = b * b - a * (center.squaredNorm() - radius * radius);
      if ((discriminant > 0.0) != (depth(u, v) > 0.0f)) ++outline_differs;
      // Near the rim depth runs off to infinite slope; stay where the sphere faces the camera.
      if (discriminant < 0.02 || depth(u, v) == 0.0f) continue;
      ++compared;
      worst = std::max(worst, std::abs(depth(u, v) - (b - std::sqrt(discriminant)) / a));
    }
  }
  EXPECT_GT(compared, 10000);
  EXPECT_LT(worst, 2e-4);
  EXPECT_LE(outline_differs, 4);
}

// One pixel is covered if and only if its centre lies inside: a square round the centre of (u, v)
// that reaches 0.3 pixels to each side covers exactly that pixel.
TEST(DepthRenderer, PixelsAreSampledAtTheirCentres) {
  constexpr float z = 2.0f;
  const std::vector<std::array<int, 2>> pixels{{0, 0}, {319, 239}, {7, 201}};
  for (const auto& [u, v] : pixels) {
    const auto corner = [u = u, v = v](double du, double dv) {
      return kCamera.Unproject<double>(u + du, v + dv, z).cast<float>().eval();
    };
    const DepthImage depth = RenderWith(
        kCamera, Quad(corner(-0.3, -0.3), corner(0.3, -0.3), corner(0.3, 0.3), corner(-0.3, 0.3)));
    int covered = 0;
    for (const float d : depth.pixels()) covered += d > 0.0f ? 1 : 0;
    EXPECT_EQ(covered, 1) << u << ", " << v;
    EXPECT_NEAR(depth(u, v), z, 1e-5);
  }
}

TEST(DepthRenderer, RowsRunDownAndColumnsRight) {
  // Something small to the upper right: x > 0, y < 0.
  const DepthImage depth = RenderWith(
      kCamera, Quad({0.5f, -0.6f, 2}, {0.7f, -0.6f, 2}, {0.7f, -0.4f, 2}, {0.5f, -0.4f, 2}));
  const Eigen::Vector2d middle = kCamera.Project<double>({0.6, -0.5, 2.0});
  EXPECT_FLOAT_EQ(depth(static_cast<int>(middle.x()), static_cast<int>(middle.y())), 2.0f);
  EXPECT_GT(middle.x(), 160.0);
  EXPECT_LT(middle.y(), 120.0);
  EXPECT_EQ(depth(60, 50), 0.0f);
  EXPECT_EQ(depth(240, 190), 0.0f);
}

TEST(DepthRenderer, NearestSurfaceWinsWhateverTheOrderAndBothSidesAreDrawn) {
  Scene scene = Wall(3.0f, 0.0f, 0.0f);
  for (const bool flipped : {false, true}) {
    for (const bool near_first : {false, true}) {
      std::vector<Vector3f> vertices = scene.vertices;
      for (const Vector3f& p : scene.vertices) vertices.emplace_back(p.x(), p.y(), 1.5f);
      std::vector<Triangle> near_wall{{4, 5, 6}, {4, 6, 7}}, triangles = scene.triangles;
      if (flipped) {
        for (Triangle& t : near_wall) std::swap(t[1], t[2]);
      }
      triangles.insert(near_first ? triangles.begin() : triangles.end(), near_wall.begin(),
                       near_wall.end());
      const DepthImage depth = RenderWith(kCamera, {vertices, triangles});
      for (const float d : depth.pixels()) ASSERT_NEAR(d, 1.5f, 1e-5);
    }
  }
}

TEST(DepthRenderer, DrawsNothingOfWhatIsOutOfRangeOrBehind) {
  for (const float z : {-2.0f, 0.1f, 11.0f}) {
    const DepthImage depth =
        RenderWith(kCamera, Quad({-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}));
    for (const float d : depth.pixels()) ASSERT_EQ(d, 0.0f) << z;
  }
  const DepthImage of_nothing = RenderWith(kCamera, {});
  for (const float d : of_nothing.pixels()) ASSERT_EQ(d, 0.0f);
}

TEST(DepthRenderer, SeveralRenderersDoNotDisturbEachOther) {
  const Scene near = Wall(1.0f, 0, 0), far = Wall(4.0f, 0, 0);
  DepthRenderer first(kCamera), second(kOddCamera, 0.5, 6.0);
  const DepthImage alone = first.Render(near.vertices, near.triangles);
  {
    DepthRenderer third(kCamera);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(second.Render(far.vertices, far.triangles)(60, 40), 4.0f, 1e-4);
      EXPECT_NEAR(third.Render(far.vertices, far.triangles)(60, 40), 4.0f, 1e-4);
      EXPECT_EQ(first.Render(near.vertices, near.triangles).pixels(), alone.pixels());
    }
  }
  EXPECT_EQ(first.Render(near.vertices, near.triangles).pixels(), alone.pixels());
  EXPECT_EQ(second.Render({}, {})(60, 40), 0.0f);  // nothing stays from the last picture
}

TEST(DepthRenderer, RefusesWhatCannotBeDrawn) {
  EXPECT_THROW(DepthRenderer({0, 240, 285, 285, 0, 0}), std::invalid_argument);
  EXPECT_THROW(DepthRenderer(kCamera, 0.0, 10.0), std::invalid_argument);
  DepthRenderer renderer(kCamera);
  EXPECT_THROW(renderer.Render({{0, 0, 1}}, {{0, 0, 1}}), std::invalid_argument);
  EXPECT_THROW(renderer.Render({{0, 0, NAN}}, {}), std::invalid_argument);
}

// --- Against the z-buffer ------------------------------------------------------------------------

// The least distance in pixels from a pixel's centre to the image of any edge.
double DistanceToEdges(int u, int v, const Scene& scene) {
  const Eigen::Vector2d centre(u, v);
  double least = 1e9;
  for (const Triangle& t : scene.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vector3f &p = scene.vertices[t[k]], &q = scene.vertices[t[(k + 1) % 3]];
      const Eigen::Vector2d a = kCamera.Project<double>(p.cast<double>());
      const Eigen::Vector2d ab = kCamera.Project<double>(q.cast<double>()) - a;
      const double along = std::clamp(ab.dot(centre - a) / ab.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (a + along * ab - centre).norm());
    }
  }
  return least;
}

// What two pictures of one scene have in common.
struct Comparison {
  int body_pixels = 0;       // drawn by either
  int differ = 0;            // drawn by one only, or more than 1 mm apart
  double far_from_edge = 0;  // the largest distance of one that differs from an edge, pixels
  std::vector<double> differences_m;
};

void Compare(const DepthImage& a, const DepthImage& b, const Scene& scene, Comparison& c) {
  for (int v = 0; v < a.height(); ++v) {
    for (int u = 0; u < a.width(); ++u) {
      const float da = a(u, v), db = b(u, v);
      if (da == 0.0f && db == 0.0f) continue;
      ++c.body_pixels;
      const double difference = std::abs(da - db);
      if (difference < 1e-3) {
        c.differences_m.push_back(difference);
        continue;
      }
      ++c.differ;
      c.far_from_edge = std::max(c.far_from_edge, DistanceToEdges(u, v, scene));
    }
  }
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The tiny body bent at every joint, 2.5 m away, turned by `turn` about the vertical.
std::vector<Vector3f> BentBody(const BodyModel& body, double turn) {
  JointPose pose = JointPose::Rest(body.skeleton);
  for (int b = 0; b < kBoneCount; ++b) {
    const Vector3d bend(0.3 * std::sin(1.0 + b), 0.4 * std::sin(2.0 + 3.0 * b),
                        0.5 * std::sin(5.0 * b));
    pose.local_rotations[b] = ExpSo3(bend);
  }
  pose.local_rotations[0] = ExpSo3<double>({0.0, turn, 0.0});
  std::vector<Vector3f> posed;
  SkinLinear(body.rest.vertices, body.weights, ForwardKinematics(body.skeleton, pose), posed);
  for (Vector3f& p : posed) p = Vector3f(p.x(), 0.95f - p.y(), 2.5f - p.z());
  return posed;
}

TEST(DepthRenderer, AgreesWithTheZBufferPixelByPixel) {
  const BodyModel body = TinyBody(5);
  DepthRenderer renderer(kCamera);
  ZBuffer zbuffer(kCamera);
  Comparison c;
  for (int k = 0; k < 12; ++k) {
    const Scene scene{BentBody(body, 2.0 * M_PI * k / 12 + 0.1), body.rest.triangles};
    Compare(renderer.Render(scene.vertices, scene.triangles),
            zbuffer.Render(scene.vertices, scene.triangles), scene, c);
  }
  // A centre within rounding of an edge may fall to either side of it: OSMesa rounds corners to
  // 1/256 pixel. Seen: 3 of 108,836.
  EXPECT_GT(c.body_pixels, 100000);
  EXPECT_LE(c.differ, c.body_pixels / 5000);
  EXPECT_LT(c.far_from_edge, 1.0 / 256);
  EXPECT_LT(Median(c.differences_m), 2e-5);
  RecordProperty("body_pixels", c.body_pixels);
  RecordProperty("differ", c.differ);
  RecordProperty("far_from_edge", std::to_string(c.far_from_edge));
  RecordProperty("median_um", std::to_string(1e6 * Median(c.differences_m)));
}

}  // namespace
}  // namespace vitruvia
