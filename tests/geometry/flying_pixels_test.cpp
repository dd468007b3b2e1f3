#include "geometry/flying_pixels.h"

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

constexpr float kWithin_m = 0.05f;

// A square of 6 by 6 pixels, 2 m away, in an empty image.
DepthImage Square() {
  DepthImage depth(12, 10);
  for (int v = 2; v < 8; ++v) {
    for (int u = 3; u < 9; ++u) depth(u, v) = 2.0f;
  }
  return depth;
}

DepthImage Filtered(const DepthImage& depth, int least_neighbors) {
  DepthImage kept;
  RemoveFlyingPixels(depth, least_neighbors, kWithin_m, kept);
  return kept;
}

TEST(FlyingPixels, EdgesAndCornersOfASurfaceAreKeptUpToTheirNumberOfNeighbors) {
  const DepthImage depth = Square();
  EXPECT_EQ(Filtered(depth, 3).pixels(), depth.pixels());
  const DepthImage no_corners = Filtered(depth, 4);
  EXPECT_EQ(no_corners(3, 2), 0.0f);
  EXPECT_EQ(no_corners(4, 2), 2.0f);
  EXPECT_EQ(Filtered(depth, 6)(4, 2), 0.0f);
  EXPECT_EQ(Filtered(depth, 8)(4, 3), 2.0f);
}

TEST(FlyingPixels, PixelsBetweenSurfacesAreRemovedAndNothingElse) {
  DepthImage depth = Square();
  depth(9, 3) = 2.12f;
  depth(9, 4) = 2.27f;
  depth(9, 5) = 2.20f;
  EXPECT_EQ(Filtered(depth, 3).pixels(), Square().pixels());
  EXPECT_EQ(Filtered(depth, 0).pixels(), depth.pixels());
}

TEST(FlyingPixels, AStepWithinTheLimitIsSupport) {
  DepthImage depth = Square();
  for (int v = 2; v < 8; ++v) depth(9, v) = 2.04f;
  EXPECT_EQ(Filtered(depth, 3).pixels(), depth.pixels());
  for (int v = 2; v < 8; ++v) depth(9, v) = 2.06f;  // two neighbours of its own kind
  EXPECT_EQ(Filtered(depth, 3).pixels(), Square().pixels());
}

TEST(FlyingPixels, TheImageBorderAndImagesOfAnotherSizeAreHandled) {
  DepthImage depth(4, 3, 1.5f);
  DepthImage kept(2, 2, 9.0f);
  RemoveFlyingPixels(depth, 3, kWithin_m, kept);
  EXPECT_EQ(kept.pixels(), depth.pixels());
  RemoveFlyingPixels(depth, 4, kWithin_m, kept);
  EXPECT_EQ(kept(0, 0), 0.0f);
  EXPECT_EQ(kept(1, 0), 1.5f);
}

}  // namespace
}  // namespace vitruvia
