#include "geometry/point_cloud.h"

#include <limits>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace vitruvia
