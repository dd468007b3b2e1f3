#include "tracking/depth_gap.h"

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

TEST(SquaredDepthGap, CountsDifferencesUpToFiveCentimetresPerRenderedPixel) {
  DepthImage rendered(4, 2), measured(4, 2);
  rendered(0, 0) = 2.0f, measured(0, 0) = 2.01f;  // 1 cm
  rendered(1, 0) = 2.0f, measured(1, 0) = 1.0f;   // covered
  rendered(2, 0) = 2.0f;                          // nothing measured
  measured(3, 0) = 2.0f;                          // nothing rendered
  rendered(0, 1) = 2.0f, measured(0, 1) = 9.0f;   // out of the sensor's range
  EXPECT_NEAR(SquaredDepthGap_m2(rendered, measured, 1, 8.0), (1e-4 + 4 * 25e-4) / 4, 1e-9);
  EXPECT_NEAR(SquaredDepthGap_m2(rendered, measured, 2, 8.0), (1e-4 + 25e-4) / 2, 1e-9);
  EXPECT_EQ(SquaredDepthGap_m2(DepthImage(4, 2), measured, 1, 8.0), 0.0);
}

// Ten columns: the last two do not fill a group of eight.
TEST(SquaredDepthGap, CountsPixelsThatOnlyOneImageHoldsAtTheEndOfARow) {
  DepthImage rendered(10, 1), measured(10, 1);
  rendered(0, 0) = 2.0f, measured(0, 0) = 2.01f;  // 1 cm
  rendered(8, 0) = 2.0f;                          // nothing measured
  measured(9, 0) = 2.0f;                          // nothing rendered
  EXPECT_NEAR(SquaredDepthGap_m2(rendered, measured, 1, 8.0), (1e-4 + 2 * 25e-4) / 2, 1e-9);
  EXPECT_NEAR(SquaredDepthGap_m2(rendered, measured, 2, 8.0), (1e-4 + 25e-4) / 2, 1e-9);
  EXPECT_NEAR(SquaredDepthGap_m2(rendered, measured, 3, 8.0), 1e-4 + 25e-4, 1e-9);  // columns 0, 9
}

}  // namespace
}  // namespace vitruvia
