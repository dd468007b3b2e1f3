#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/random.h"
#include "geometry/zbuffer.h"
#include "tracking/classification.h"
#include "tracking/visibility.h"

namespace vitruvia {
namespace {

PinholeCamera SmallCamera() {
  PinholeCamera camera;
  camera.width = 40;
  camera.height = 30;
  camera.fx = camera.fy = 40.0;
  camera.cx = 19.5;
  camera.cy = 14.5;
  return camera;
}

TEST(CloudFromDepth, TakesEveryStridePixelThatWasMeasured) {
  const PinholeCamera camera = SmallCamera();
  DepthImage depth(40, 30);
  depth(4, 6) = 2.0f;
  depth(5, 6) = 2.0f;  // odd column: not sampled
  depth(8, 8) = std::numeric_limits<float>::quiet_NaN();
  depth(10, 8) = -1.0f;
  depth(12, 8) = std::numeric_limits<float>::infinity();
  depth(14, 8) = 9.0f;  // beyond max_depth
  PointCloud cloud;
  CloudFromDepth(depth, camera, 2, 8.0f, cloud);
  ASSERT_EQ(cloud.points.size(), 1u);
  EXPECT_EQ(cloud.pixels[0], 6 * 40 + 4);
  EXPECT_TRUE(cloud.points[0].isApprox(Vector3f((4 - 19.5f) / 40 * 2, (6 - 14.5f) / 40 * 2, 2)));
}

TEST(SampleDepth, IsExactOnAPlaneAndNeverMixesAcrossAStep) {
  DepthImage depth(10, 10);
  for (int v = 0; v < 10; ++v) {
    for (int u = 0; u < 10; ++u)
      depth(u, v) =
          u < 5 ? 1.0f + 0.001f * static_cast<float>(u) + 0.002f * static_cast<float>(v) : 2.0f;
  }
  EXPECT_NEAR(SampleDepth(depth, 2.25f, 3.5f, 0.02f), 1.0 + 0.00225 + 0.007, 1e-6);
  EXPECT_EQ(SampleDepth(depth, 4.4f, 3.0f, 0.02f), depth(4, 3));
  EXPECT_EQ(SampleDepth(depth, 4.6f, 3.0f, 0.02f), 2.0f);
}

TEST(SampleDepth, HasNothingOutsideOrWhereNothingWasMeasured) {
  DepthImage depth(10, 10, 1.0f);
  depth(3, 3) = 0.0f;
  EXPECT_EQ(SampleDepth(depth, 3.2f, 3.1f, 0.02f), 0.0f);
  EXPECT_EQ(SampleDepth(depth, -0.6f, 3.0f, 0.02f), 0.0f);
  EXPECT_EQ(SampleDepth(depth, 3.0f, 9.6f, 0.02f), 0.0f);
  EXPECT_EQ(SampleDepth(depth, std::numeric_limits<float>::quiet_NaN(), 3.0f, 0.02f), 0.0f);
  EXPECT_EQ(SampleDepth(depth, -0.4f, 9.4f, 0.02f), 1.0f);
}

// Two squares, one behind the other.
struct TwoSquares {
  std::vector<Vector3f> vertices;
  std::vector<Triangle> triangles;
  TwoSquares() {
    AddSquare(0.3f, 1.0f);
    AddSquare(0.9f, 2.0f);
  }
  void AddSquare(float half, float z) {
    const auto first = static_cast<std::int32_t>(vertices.size());
    vertices.insert(vertices.end(),
                    {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}});
    vertices.push_back({0.0f, 0.0f, z});
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
};

TEST(ZBuffer, DrawsTheNearerSurfaceWithPerspectiveDepth) {
  const PinholeCamera camera = SmallCamera();
  const TwoSquares scene;
  ZBuffer squares(camera);
  const DepthImage& depth = squares.Render(scene.vertices, scene.triangles);
  EXPECT_FLOAT_EQ(depth(20, 15), 1.0f);
  EXPECT_FLOAT_EQ(depth(5, 15), 2.0f);
  EXPECT_EQ(depth(0, 0), 0.0f);

  // A slanted plane z = 2 + x: depth along a pixel's ray is 2 / (1 − x/z).
  const std::vector<Vector3f> slanted = {{-1, -1, 1}, {1, -1, 3}, {1, 1, 3}, {-1, 1, 1}};
  ZBuffer zbuffer(camera);
  const DepthImage& plane = zbuffer.Render(slanted, {{0, 1, 2}, {0, 2, 3}});
  for (const int u : {10, 15, 20, 25}) {
    const double ray_x = (u - camera.cx) / camera.fx;
    EXPECT_NEAR(plane(u, 15), 2.0 / (1.0 - ray_x), 1e-5) << u;
  }
}

TEST(ZBuffer, LeavesOutTrianglesBehindTheCameraAndWithoutArea) {
  ZBuffer zbuffer(SmallCamera());
  const std::vector<Vector3f> vertices = {{0, 0, -1},      {1, 0, 1},       {0, 1, 1},
                                          {0.1f, 0.1f, 1}, {0.2f, 0.2f, 1}, {0.3f, 0.3f, 1}};
  const DepthImage& depth = zbuffer.Render(vertices, {{0, 1, 2}, {3, 4, 5}});
  for (const float pixel : depth.pixels()) EXPECT_EQ(pixel, 0.0f);
}

TEST(FindVisibleVertices, FindsThoseOnTheRenderedSurface) {
  const PinholeCamera camera = SmallCamera();
  const TwoSquares scene;
  ZBuffer zbuffer(camera);
  std::vector<int> visible;
  FindVisibleVertices(scene.vertices, zbuffer.Render(scene.vertices, scene.triangles), camera,
                      0.002f, visible);
  // The far square's centre hides behind the near one; corners lie on the silhouette's own pixels.
  EXPECT_TRUE(std::find(visible.begin(), visible.end(), 4) != visible.end());
  EXPECT_TRUE(std::find(visible.begin(), visible.end(), 9) == visible.end());
}

// Eight vertices are looked up side by side; the reference asks the camera for each.
TEST(FindVisibleVertices, LooksUpThePixelOfTheCamera) {
  const PinholeCamera camera = SmallCamera();
  DepthImage rendered(camera.width, camera.height);
  for (int u = 3; u < camera.width; ++u) {
    for (int v = 0; v < camera.height; ++v) rendered(u, v) = 1.0f;
  }
  RandomStream random(1, "vertices");
  for (int count = 0; count < 40; ++count) {
    std::vector<Vector3f> vertices;
    for (int i = 0; i < count; ++i) {  // some out of view or behind the camera
      vertices.push_back({static_cast<float>(random.Uniform(-1.0, 1.0)),
                          static_cast<float>(random.Uniform(-1.0, 1.0)),
                          static_cast<float>(random.Uniform(0.99, 1.01))});
      if (i % 7 == 3) vertices.back().z() *= -1.0f;
    }
    std::vector<int> visible, expected;
    FindVisibleVertices(vertices, rendered, camera, 0.005f, visible);
    for (int i = 0; i < count; ++i) {
      const auto pixel = camera.PixelOf(vertices[i]);
      if (!pixel) continue;
      const float z = rendered(pixel->u, pixel->v);
      if (z > 0.0f && std::abs(vertices[i].z() - z) < 0.005f) expected.push_back(i);
    }
    EXPECT_EQ(visible, expected) << count << " vertices";
  }
}

TEST(Classification, SortsVerticesAndPointsByWhatExplainsThem) {
  const PinholeCamera camera = SmallCamera();
  const NearnessSettings nearness{0.05f, 1, 0.02f};
  DepthImage captured(40, 30), rendered(40, 30);
  for (int v = 10; v < 20; ++v) {
    for (int u = 10; u < 20; ++u) captured(u, v) = 1.0f;
    for (int u = 12; u < 22; ++u) rendered(u, v) = 1.01f;
  }
  const auto at = [&](float u, float v, float z) { return camera.Unproject(u, v, z); };
  const std::vector<Vector3f> vertices = {
      at(15, 15, 1.01f),  // on the surface: V1
      at(20, 15, 1.01f),  // one pixel outside: the edge explains it
      at(23, 15, 1.01f),  // far outside: V2
      at(15, 15, 1.20f),  // far behind: V2
  };
  VertexClasses classes;
  ClassifyVertices(vertices, {0, 1, 2, 3}, captured, camera, nearness, classes);
  EXPECT_EQ(classes.near_surface, std::vector<int>{0});
  EXPECT_EQ(classes.observed_depth, std::vector<float>{1.0f});
  EXPECT_EQ(classes.elsewhere, (std::vector<int>{2, 3}));

  PointCloud cloud;
  CloudFromDepth(captured, camera, 1, 8.0f, cloud);
  std::vector<int> unexplained;
  FindUnexplainedPoints(cloud, rendered, nearness, unexplained);
  EXPECT_EQ(unexplained.size(), 10u);  // column 10; column 11 touches the rendered edge
  for (const int i : unexplained) EXPECT_EQ(cloud.pixels[i] % 40, 10);
}

// An image of a slanted surface with steps, holes and pixels that are no number.
DepthImage BrokenSurface(RandomStream& random, int width, int height) {
  DepthImage depth(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double chance = random.Uniform();
      depth(u, v) = static_cast<float>(1.0 + 0.002 * u + 0.001 * v + (chance > 0.9 ? 0.1 : 0.0));
      if (chance < 0.1) depth(u, v) = 0.0f;
      if (chance < 0.03) depth(u, v) = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return depth;
}

TEST(SampleDepth, AtEightPositionsIsThatAtEach) {
  RandomStream random(1, "positions");
  for (const int height : {1, 2, 30}) {
    const DepthImage depth = BrokenSurface(random, 40, height);
    for (int trial = 0; trial < 200; ++trial) {
      FloatLanes u, v;
      for (int lane = 0; lane < kLanes; ++lane) {
        u[lane] = static_cast<float>(random.Uniform(-2.0, 42.0));
        v[lane] = static_cast<float>(random.Uniform(-2.0, height + 2.0));
        if (lane == 3) u[lane] = std::round(u[lane]) + (trial % 2 == 0 ? 0.5f : 0.0f);
        if (lane == 4) v[lane] = std::round(v[lane]) + (trial % 2 == 0 ? 0.5f : 0.0f);
      }
      if (trial % 10 == 0) u[5] = std::numeric_limits<float>::quiet_NaN();
      if (trial % 10 == 1) v[5] = std::numeric_limits<float>::infinity();
      const FloatLanes sampled = SampleDepth(depth, u, v, 0.02f);
      for (int lane = 0; lane < kLanes; ++lane) {
        EXPECT_EQ(sampled[lane], SampleDepth(depth, u[lane], v[lane], 0.02f))
            << u[lane] << " " << v[lane];
      }
    }
  }
}

// Eight vertices are classified side by side; the reference takes one after the other.
TEST(Classification, OfManyVerticesIsThatOfEach) {
  const PinholeCamera camera = SmallCamera();
  RandomStream random(1, "classes");
  const DepthImage captured = BrokenSurface(random, camera.width, camera.height);
  for (const BehindSurface behind : {BehindSurface::kElsewhere, BehindSurface::kHidden}) {
    const NearnessSettings nearness{0.03f, 1, 0.02f, behind};
    std::vector<Vector3f> vertices;
    std::vector<int> visible;
    VertexClasses expected, classes, single;
    for (int i = 0; i < 60; ++i) {
      vertices.push_back(camera.Unproject(static_cast<float>(random.Uniform(-3.0, 43.0)),
                                          static_cast<float>(random.Uniform(-3.0, 33.0)),
                                          static_cast<float>(random.Uniform(0.95, 1.15))));
      if (i % 5 != 0) {
        visible.push_back(i);
        ClassifyVertices(vertices, {i}, captured, camera, nearness, single);
        const auto append = [](const auto& from, auto& to) {
          to.insert(to.end(), from.begin(), from.end());
        };
        append(single.near_surface, expected.near_surface);
        append(single.observed_depth, expected.observed_depth);
        append(single.elsewhere, expected.elsewhere);
        const auto pixel = camera.Project(vertices.back());
        const float z = SampleDepth(captured, pixel.x(), pixel.y(), nearness.smooth_m);
        const bool is_near = z > 0.0f && std::abs(vertices.back().z() - z) < nearness.depth_m;
        ASSERT_EQ(single.near_surface.size(), is_near ? 1u : 0u);
        if (is_near) {
          ASSERT_EQ(single.observed_depth.front(), z);
        }
      }
      ClassifyVertices(vertices, visible, captured, camera, nearness, classes);
      ASSERT_EQ(classes.near_surface, expected.near_surface);
      ASSERT_EQ(classes.observed_depth, expected.observed_depth);
      ASSERT_EQ(classes.elsewhere, expected.elsewhere);
    }
    EXPECT_GT(expected.near_surface.size(), 5u);
    EXPECT_GT(expected.elsewhere.size(), 5u);
  }
}

TEST(PairFinder, FindsWhatBruteForceFinds) {
  RandomStream random(3, "pairs");
  const auto point = [&] {
    return Vector3f(static_cast<float>(random.Uniform()), static_cast<float>(random.Uniform()),
                    static_cast<float>(random.Uniform(1.0, 2.0)));
  };
  std::vector<Vector3f> vertices(200);
  PointCloud cloud;
  for (Vector3f& v : vertices) v = point();
  for (int i = 0; i < 150; ++i) cloud.points.push_back(point());
  std::vector<int> queries, point_queries;
  for (int i = 0; i < 200; i += 3) queries.push_back(i);
  for (int i = 0; i < 150; i += 2) point_queries.push_back(i);
  constexpr float kCutoff = 0.15f;

  const auto near_cloud = MakeNearestNeighbors(Association::kExhaustive, SmallCamera(), 0);
  const auto near_candidates = MakeNearestNeighbors(Association::kExhaustive, SmallCamera(), 0);
  near_cloud->Build(cloud.points);
  std::vector<Vector3f> candidates;
  for (const int i : queries) candidates.push_back(vertices[i]);
  near_candidates->Build(candidates);
  PairFinder finder;
  std::vector<Pair> pairs;
  finder.VerticesToPoints(vertices, queries, cloud, *near_cloud, kCutoff, pairs);
  // Every third candidate reaches half as far.
  const auto cutoff = [](int vertex) { return vertex % 9 == 0 ? 0.5f * kCutoff : kCutoff; };
  finder.PointsToVertices(cloud, point_queries, queries, *near_candidates, kCutoff, cutoff, pairs);

  const auto nearest = [](const Vector3f& from, const std::vector<Vector3f>& to) {
    int best = 0;
    for (std::size_t i = 1; i < to.size(); ++i) {
      if ((to[i] - from).squaredNorm() < (to[best] - from).squaredNorm())
        best = static_cast<int>(i);
    }
    return best;
  };
  std::vector<Pair> reference;
  for (const int i : queries) {
    const Vector3f& target = cloud.points[nearest(vertices[i], cloud.points)];
    if ((target - vertices[i]).norm() < kCutoff) reference.push_back({i, target});
  }
  for (const int i : point_queries) {
    const int k = nearest(cloud.points[i], candidates);
    if ((candidates[k] - cloud.points[i]).norm() < cutoff(queries[k]))
      reference.push_back({queries[k], cloud.points[i]});
  }
  ASSERT_EQ(pairs.size(), reference.size());
  EXPECT_GT(pairs.size(), 50u);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    EXPECT_EQ(pairs[k].vertex, reference[k].vertex);
    EXPECT_EQ(pairs[k].target, reference[k].target);
  }
}

TEST(KdTree, FindsNothingInNothing) {
  KdTree tree;
  tree.Build({});
  std::vector<KdTree::Neighbor> neighbors;
  tree.FindNearest({Vector3f::Zero()}, 1.0f, neighbors);
  ASSERT_EQ(neighbors.size(), 1u);
  EXPECT_EQ(neighbors[0].index, -1);
}

// The mean of captured minus rendered depth round a vertex's pixel, without what is another
// surface.
TEST(AverageObservedDepth, IsTheVertexsDepthPlusTheMeanDifferenceRoundIt) {
  PinholeCamera camera;
  camera.width = 5, camera.height = 5;
  camera.fx = camera.fy = 100.0;
  camera.cx = camera.cy = 2.0;
  DepthImage rendered(5, 5), captured(5, 5);
  for (float& z : rendered.pixels()) z = 2.0f;
  for (float& z : captured.pixels()) z = 2.01f;
  captured(2, 2) = 2.04f;
  captured(1, 1) = 2.5f;  // another surface
  captured(3, 3) = 0.0f;  // not measured
  const std::vector<Vector3f> vertices{{0.001f, 0.0f, 2.002f}};
  VertexClasses classes;
  classes.near_surface = {0};
  classes.observed_depth = {2.04f};
  AverageObservedDepth(vertices, captured, rendered, camera, 1, 0.05f, classes);
  EXPECT_NEAR(classes.observed_depth[0], 2.002 + (6 * 0.01 + 0.04) / 7, 1e-5);
}

TEST(PixelSharing, TheVerticesOfAPixelShareItsWeight) {
  PinholeCamera camera{20, 10, 10.0, 10.0, 9.5, 4.5};
  const auto at = [&](float u, float v) { return camera.Unproject(u, v, 2.0f); };
  const std::vector<Vector3f> vertices{at(3.1f, 4.0f), at(12.0f, 4.0f), at(2.9f, 4.2f),
                                       at(7.0f, 4.0f), at(3.0f, 3.8f)};
  VertexClasses classes;
  classes.near_surface = {0, 1, 2, 4};
  classes.weight.assign(4, 1.0f);
  PixelSharing sharing(camera);
  sharing.Weigh(vertices, 1.0f, classes);
  const auto third = 1.0f / 3.0f;
  EXPECT_EQ(classes.weight, (std::vector<float>{third, 1.0f, third, third}));
  sharing.Weigh(vertices, 0.5f, classes);  // nothing is left of the first call
  for (const int k : {0, 2, 3}) EXPECT_FLOAT_EQ(classes.weight[k], 0.5f + 0.5f / 3.0f);
  EXPECT_EQ(classes.weight[1], 1.0f);
  sharing.Weigh(vertices, 0.0f, classes);
  EXPECT_EQ(classes.weight, (std::vector<float>{1.0f, 1.0f, 1.0f, 1.0f}));
}

}  // namespace
}  // namespace vitruvia
