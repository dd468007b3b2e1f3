#include "tracking/cloud_parts.h"

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

// A surface of 8 × 10 pixels, one of 4 × 10 beside it that is 0.5 m nearer, and a single pixel.
PointCloud TwoSurfaces(const PinholeCamera& camera, int stride) {
  DepthImage depth(camera.width, camera.height);
  for (int v = 20; v < 30; ++v) {
    for (int u = 10; u < 18; ++u) depth(u, v) = 2.5f + 0.01f * static_cast<float>(u);
    for (int u = 18; u < 22; ++u) depth(u, v) = 2.0f;
  }
  depth(100, 100) = 3.0f;
  PointCloud cloud;
  CloudFromDepth(depth, camera, stride, 8.0f, cloud);
  return cloud;
}

TEST(CentersOfParts, SplitsSurfacesWhereDepthJumpsAndDropsSmallOnes) {
  const PinholeCamera camera;
  for (const int stride : {1, 2}) {
    const PointCloud cloud = TwoSurfaces(camera, stride);
    const std::vector<Vector3d> centers = CentersOfParts(cloud, camera.width, stride, 0.1, 0.1);
    ASSERT_EQ(centers.size(), 2u);
    EXPECT_NEAR(centers[0].z(), stride == 1 ? 2.635 : 2.63, 1e-6);
    EXPECT_NEAR(centers[1].z(), 2.0, 1e-6);
    EXPECT_EQ(CentersOfParts(cloud, camera.width, stride, 1.0, 0.1).size(), 1u);
  }
}

TEST(CentersOfParts, FindsNothingInNothing) {
  EXPECT_TRUE(CentersOfParts({}, 320, 2, 0.1, 0.1).empty());
}

}  // namespace
}  // namespace vitruvia
