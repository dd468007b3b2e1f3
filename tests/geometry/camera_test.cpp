#include "geometry/camera.h"

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

TEST(PinholeCamera, SeesWhatLiesInItsPixels) {
  const PinholeCamera camera{64, 48, 50.0, 55.0, 30.2, 25.1};
  for (const double u : {-0.49, 0.0, 63.0, 63.49}) {
    for (const double v : {-0.49, 0.0, 47.0, 47.49}) {
      EXPECT_TRUE(camera.InView(camera.Unproject(u, v, 2.0))) << u << " " << v;
    }
  }
  EXPECT_FALSE(camera.InView(camera.Unproject(-0.51, 10.0, 2.0)));
  EXPECT_FALSE(camera.InView(camera.Unproject(63.51, 10.0, 2.0)));
  EXPECT_FALSE(camera.InView(camera.Unproject(10.0, -0.51, 2.0)));
  EXPECT_FALSE(camera.InView(camera.Unproject(10.0, 47.51, 2.0)));
  EXPECT_FALSE(camera.InView(camera.Unproject(10.0, 10.0, -2.0)));  // behind
  EXPECT_FALSE(camera.InView(Vector3<double>(0.0, 0.0, 0.0)));
}

}  // namespace
}  // namespace vitruvia
