#include "geometry/point_cloud.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/random.h"

namespace vitruvia {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(SampleDepth, MixesNoPixelWithoutMeasurementIn) {
  for (const float missing : {kNan, 0.0f, -1.0f}) {
    for (int corner = 0; corner < 4; ++corner) {
      DepthImage depth(2, 2);
      for (float& z : depth.pixels()) z = 1.0f;
      depth(corner % 2, corner / 2) = missing;
      // The sample lies nearest to pixel (0, 0): its depth is the answer, if it has one.
      EXPECT_EQ(SampleDepth(depth, 0.25f, 0.25f, 0.02f), corner == 0 ? 0.0f : 1.0f)
          << missing << " at corner " << corner;
    }
  }
}

TEST(CloudFromDepth, LeavesOutWhatIsNoMeasurement) {
  DepthImage depth(4, 1);
  depth(0, 0) = kNan;
  depth(1, 0) = 2.0f;
  depth(2, 0) = 5.0f;
  depth(3, 0) = -1.0f;
  PinholeCamera camera;
  camera.width = 4;
  camera.height = 1;
  PointCloud cloud;
  CloudFromDepth(depth, camera, 1, 4.0f, cloud);
  EXPECT_EQ(cloud.pixels, std::vector<int>{1});
}

// The reference looks at every pixel. Images narrower than eight pixels, strides that divide eight
// and that do not, and depths at both ends of the rows.
TEST(CloudFromDepth, SkipsNoMeasuredPixelAmongEmptyOnes) {
  RandomStream random(1, "cloud");
  PinholeCamera camera;
  camera.height = 3;
  for (camera.width = 1; camera.width <= 37; ++camera.width) {
    for (int stride = 1; stride <= 11; ++stride) {
      DepthImage depth(camera.width, camera.height);
      for (float& z : depth.pixels()) z = random.Uniform() < 0.05 ? 1.5f : 0.0f;
      depth(camera.width - 1, 0) = 2.0f;
      depth(0, camera.height - 1) = 2.0f;
      std::vector<int> measured;
      for (int v = 0; v < camera.height; v += stride) {
        for (int u = 0; u < camera.width; u += stride) {
          if (depth(u, v) > 0.0f) measured.push_back(v * camera.width + u);
        }
      }
      PointCloud cloud;
      CloudFromDepth(depth, camera, stride, 4.0f, cloud);
      EXPECT_EQ(cloud.pixels, measured) << camera.width << " columns, stride " << stride;
    }
  }
}

}  // namespace
}  // namespace vitruvia
