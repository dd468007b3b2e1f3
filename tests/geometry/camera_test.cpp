#include "geometry/camera.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/random.h"

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

// Against the definition: the centre nearest to the projection, of all pixels of the image.
TEST(PinholeCamera, TakesThePixelWhoseCentreIsNearest) {
  const PinholeCamera camera{8, 6, 7.0, 7.5, 3.7, 2.2};
  RandomStream random(1, "pixels");
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3<float> point(static_cast<float>(random.Uniform(-1.5, 1.5)),
                               static_cast<float>(random.Uniform(-1.5, 1.5)),
                               static_cast<float>(random.Uniform(-0.5, 3.0)));
    std::optional<Pixel> expected;
    if (point.z() > 0.0f) {
      const auto uv = camera.Project(point);
      for (int u = 0; u < 8; ++u) {
        for (int v = 0; v < 6; ++v) {
          if (std::abs(uv.x() - static_cast<float>(u)) < 0.5f &&
              std::abs(uv.y() - static_cast<float>(v)) < 0.5f) {
            expected = Pixel{u, v};
          }
        }
      }
    }
    EXPECT_EQ(camera.PixelOf(point), expected);
    inside += expected.has_value();
  }
  EXPECT_GT(inside, 400);
}

TEST(PinholeCamera, GivesTheEdgeBetweenPixelsToTheRightAndLowerOne) {
  const PinholeCamera camera{8, 6, 7.0, 7.5, 3.7, 2.2};
  const auto at = [&](double u, double v) { return camera.PixelAt(Eigen::Vector2d(u, v)); };
  EXPECT_EQ(at(-0.5, -0.5), (Pixel{0, 0}));
  EXPECT_EQ(at(0.5, 1.5), (Pixel{1, 2}));
  EXPECT_EQ(at(7.5, 0.0), std::nullopt);
  EXPECT_EQ(at(0.0, 5.5), std::nullopt);
  EXPECT_EQ(at(std::numeric_limits<double>::quiet_NaN(), 0.0), std::nullopt);
  EXPECT_EQ(at(std::numeric_limits<double>::infinity(), 0.0), std::nullopt);
}

}  // namespace
}  // namespace vitruvia
