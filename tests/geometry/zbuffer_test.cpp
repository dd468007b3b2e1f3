#include "geometry/zbuffer.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/random.h"
#include "geometry/front_face_zbuffer.h"
#include "tests/geometry/scalar_zbuffer.h"

namespace vitruvia {
namespace {

const PinholeCamera kCamera;

// A closed, convex, many-sided ball round `center`: latitude and longitude.
TriangleMesh Ball(const Vector3f& center, float radius, int steps) {
  TriangleMesh ball;
  const auto point = [&](int ring, int side) {
    const double polar = M_PI * ring / steps, turn = 2.0 * M_PI * side / (2 * steps);
    return Vector3f(center +
                    radius * Vector3f(static_cast<float>(std::sin(polar) * std::cos(turn)),
                                      static_cast<float>(std::cos(polar)),
                                      static_cast<float>(std::sin(polar) * std::sin(turn))));
  };
  for (int ring = 0; ring <= steps; ++ring) {
    for (int side = 0; side < 2 * steps; ++side) ball.vertices.push_back(point(ring, side));
  }
  const auto index = [&](int ring, int side) { return ring * 2 * steps + side % (2 * steps); };
  for (int ring = 0; ring < steps; ++ring) {
    for (int side = 0; side < 2 * steps; ++side) {
      const int a = index(ring, side), b = index(ring, side + 1);
      const int c = index(ring + 1, side + 1), d = index(ring + 1, side);
      ball.triangles.push_back({a, b, c});
      ball.triangles.push_back({a, c, d});
    }
  }
  return ball;
}

// How many pixels of two pictures differ by more than a hundredth of a millimetre.
int DifferentPixels(const DepthImage& a, const DepthImage& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    count += std::abs(a.pixels()[i] - b.pixels()[i]) > 1e-5f ? 1 : 0;
  }
  return count;
}

TEST(ZBuffers, DrawWhatTheReferenceDraws) {
  RandomStream random(1, "balls");
  ZBuffer all(kCamera);
  FrontFaceZBuffer front(kCamera);
  for (int trial = 0; trial < 20; ++trial) {
    const Vector3f center(static_cast<float>(random.Uniform(-1.0, 1.0)),
                          static_cast<float>(random.Uniform(-1.0, 1.0)),
                          static_cast<float>(random.Uniform(1.5, 4.0)));
    const TriangleMesh ball = Ball(center, 0.4f, 24);
    const DepthImage expected = RenderScalar(kCamera, ball);
    EXPECT_EQ(all.Render(ball.vertices, ball.triangles).pixels(), expected.pixels());
    const DepthImage& drawn = front.Render(ball.vertices, ball.triangles);
    int covered = 0;
    for (const float z : expected.pixels()) covered += z > 0.0f ? 1 : 0;
    // Silhouettes fall between pixels; rounding may decide about one of them.
    EXPECT_LE(DifferentPixels(expected, drawn), 2) << "of " << covered;
  }
}

// Eight triangles are drawn side by side; counts in between must not lose or invent one.
TEST(ZBuffers, DrawAnyNumberOfTriangles) {
  ZBuffer all(kCamera);
  FrontFaceZBuffer front(kCamera);
  RandomStream random(1, "slips");
  const auto coordinate = [&](double size) {
    return static_cast<float>(random.Uniform(-size, size));
  };
  for (int count = 0; count <= 25; ++count) {
    TriangleMesh slips;
    for (int i = 0; i < count; ++i) {
      // From less than a pixel to a third of the image, some of them partly or wholly outside.
      const double size = 0.002 * std::pow(2.0, random.Uniform(0.0, 8.0));
      const Vector3f center(coordinate(1.5), coordinate(1.2), 2.5f + coordinate(0.5));
      std::array<Vector3f, 3> corners;
      for (Vector3f& p : corners) {
        p = center + Vector3f(coordinate(size), coordinate(size), coordinate(size));
      }
      const int first = 3 * i;
      slips.vertices.insert(slips.vertices.end(), corners.begin(), corners.end());
      slips.triangles.push_back({first, first + 1, first + 2});
    }
    EXPECT_EQ(all.Render(slips.vertices, slips.triangles).pixels(),
              RenderScalar(kCamera, slips).pixels())
        << count << " triangles";
    for (auto& [a, b, c] : slips.triangles) {
      const Vector3f& corner = slips.vertices[a];
      const Vector3f normal = (slips.vertices[b] - corner).cross(slips.vertices[c] - corner);
      if (normal.dot(corner) > 0.0f) std::swap(b, c);  // front faces
    }
    EXPECT_EQ(front.Render(slips.vertices, slips.triangles).pixels(),
              RenderScalar(kCamera, slips).pixels())
        << count << " front faces";
  }
}

TEST(FrontFaceZBuffer, ForgetsTheFrameBefore) {
  FrontFaceZBuffer zbuffer(kCamera), fresh(kCamera);
  const TriangleMesh left = Ball({-0.5f, 0.0f, 2.0f}, 0.3f, 12);
  const TriangleMesh right = Ball({0.6f, 0.2f, 3.0f}, 0.3f, 12);
  zbuffer.Render(left.vertices, left.triangles);
  EXPECT_EQ(zbuffer.Render(right.vertices, right.triangles).pixels(),
            fresh.Render(right.vertices, right.triangles).pixels());
}

TEST(FrontFaceZBuffer, LeavesOutBackFacesAndWhatIsBehindTheCamera) {
  FrontFaceZBuffer zbuffer(kCamera);
  // Seen from the camera these corners run clockwise on the screen: a back face.
  const std::vector<Vector3f> vertices = {
      {-0.5f, -0.5f, 2.0f}, {0.5f, -0.5f, 2.0f}, {0.0f, 0.5f, 2.0f}, {0.0f, 0.5f, -2.0f}};
  const auto covered = [&](const std::vector<Triangle>& triangles) {
    int count = 0;
    for (const float z : zbuffer.Render(vertices, triangles).pixels()) count += z > 0.0f ? 1 : 0;
    return count;
  };
  const int one_way = covered({{0, 1, 2}}), other_way = covered({{0, 2, 1}});
  EXPECT_EQ(one_way, 0);
  EXPECT_NEAR(other_way, 0.5 * 142.5 * 142.5, 300);
  EXPECT_EQ(covered({{0, 3, 1}, {0, 1, 3}}), 0);
}

// A corner that is no number takes its triangle along, and nothing else.
TEST(ZBuffers, LeaveOutWhatIsNoNumber) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (int axis = 0; axis < 2; ++axis) {
      TriangleMesh ball = Ball({0.1f, 0.0f, 2.0f}, 0.4f, 12);
      ball.vertices[100][axis] = bad;
      ZBuffer all(kCamera);
      EXPECT_EQ(all.Render(ball.vertices, ball.triangles).pixels(),
                RenderScalar(kCamera, ball).pixels());
    }
  }
}

TEST(FrontFaceZBuffer, DrawsNothingForABodyOutOfView) {
  FrontFaceZBuffer zbuffer(kCamera);
  const TriangleMesh ball = Ball({50.0f, 0.0f, 2.0f}, 0.3f, 12);
  const DepthImage& depth = zbuffer.Render(ball.vertices, ball.triangles);
  for (const float z : depth.pixels()) ASSERT_EQ(z, 0.0f);
  const DepthImage& empty = zbuffer.Render({}, {});
  for (const float z : empty.pixels()) ASSERT_EQ(z, 0.0f);
}

}  // namespace
}  // namespace vitruvia
