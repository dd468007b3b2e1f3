#include "verification/depth_agreement.h"

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

// A box of depth whose edges lie `inset` pixels within 20 columns by 60 rows.
DepthImage Box(int inset) {
  DepthImage depth(80, 100);
  for (int v = 20 + inset; v < 80 - inset; ++v) {
    for (int u = 30 + inset; u < 50 - inset; ++u) depth(u, v) = 2.0f;
  }
  return depth;
}

// A sensor that loses a pixel at each edge makes a narrow outline a tenth narrower: its edges tell
// that from another focal length.
TEST(CompareOutlines, TellsHowFarEdgesAreMoved) {
  const OutlineDifference difference = CompareOutlines(Box(1), Box(0));
  EXPECT_NEAR(difference.scale_u, 18.0 / 20.0, 1e-3);
  EXPECT_NEAR(difference.scale_v, 58.0 / 60.0, 1e-3);
  EXPECT_NEAR(difference.edges_u_px, 1.0, 0.01);
  EXPECT_NEAR(difference.edges_v_px, 1.0, 0.01);
  EXPECT_NEAR(difference.shift_u_px, 0.0, 1e-9);
}

}  // namespace
}  // namespace vitruvia
