#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "core/random.h"
#include "geometry/depth_png.h"
#include "geometry/grey_png.h"
#include "geometry/mask_png.h"
#include "tests/support/temporary_folder.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kMillimetre = 0.001;
constexpr int kWidth = 7, kHeight = 5;

DepthImage RandomDepth() {
  RandomStream random(1, "depth");
  DepthImage depth(kWidth, kHeight);
  for (float& z : depth.pixels()) z = static_cast<float>(random.Uniform(0.0, 60.0));
  return depth;
}

class Png : public testing::Test {
 protected:
  DepthImage RoundTrip(const DepthImage& depth, double unit_m) {
    WriteDepthPng(file_, depth, unit_m);
    return ReadDepthPng(file_, unit_m, depth.width(), depth.height());
  }
  void ExpectRefused(const std::string& content, const std::string& reason) {
    WriteWholeFile(file_, content);
    EXPECT_THAT([&] { ReadDepthPng(file_, kMillimetre, kWidth, kHeight); },
                ThrowsMessage<DataError>(testing::AllOf(HasSubstr("a.png"), HasSubstr(reason))));
  }
  std::string Whole() {
    WriteDepthPng(file_, RandomDepth(), kMillimetre);
    return ReadWholeFile(file_);
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "a.png";
};

TEST_F(Png, DepthComesBackToHalfAUnit) {
  const DepthImage depth = RandomDepth(), read = RoundTrip(depth, kMillimetre);
  ASSERT_EQ(read.width(), kWidth);
  ASSERT_EQ(read.height(), kHeight);
  for (std::size_t i = 0; i < depth.pixels().size(); ++i) {
    EXPECT_NEAR(read.pixels()[i], depth.pixels()[i], 0.501 * kMillimetre);
  }
  EXPECT_EQ(RoundTrip(read, kMillimetre).pixels(), read.pixels()) << "whole units are exact";
}

TEST_F(Png, DepthThatDoesNotFitIsCountedAndTheUnitThatWouldDoIsNamed) {
  DepthImage depth(4, 1, 2.0f);
  depth(0, 0) = 0.0f;
  depth(3, 0) = 65.5f;
  EXPECT_EQ(DepthPngProblem(depth, kMillimetre), "");
  depth(3, 0) = 65.6f;
  EXPECT_THAT(DepthPngProblem(depth, kMillimetre),
              testing::AllOf(HasSubstr("1 of 3 measured pixels, 65.6 to 65.6 m deep"),
                             HasSubstr("expected a depth_unit_m of at least 0.001 m")));
  EXPECT_THROW(WriteDepthPng(file_, depth, kMillimetre), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(file_));
  EXPECT_THAT(DepthPngProblem(DepthImage(2, 2, 0.4f), 1.0),
              HasSubstr("4 of 4 measured pixels, 0.4 to 0.4 m deep, do not fit 16 bits: with a "
                        "depth_unit_m of 1 m these hold 1 to 6.554e+04 m; expected a depth_unit_m "
                        "of at most 0.4 m"));
}

TEST_F(Png, HalvesAreRoundedUp) {
  constexpr double kUnit = 0.25;
  DepthImage depth(3, 1);
  depth.pixels() = {0.125f, 0.625f, 0.874f};
  const DepthImage read = RoundTrip(depth, kUnit);
  EXPECT_THAT(read.pixels(), testing::ElementsAre(0.25f, 0.75f, 0.75f));
  EXPECT_THAT(DepthPngProblem(DepthImage(1, 1, 0.1249f), kUnit), HasSubstr("1 of 1"));
  EXPECT_EQ(DepthPngProblem(DepthImage(1, 1, 65535.49f * 0.25f), kUnit), "");
  EXPECT_THAT(DepthPngProblem(DepthImage(1, 1, 65535.5f * 0.25f), kUnit), HasSubstr("1 of 1"));
}

TEST_F(Png, EveryValueOfSixteenBitsSurvives) {
  constexpr double kUnit = 1.0 / 4096.0;  // a power of two: metres are exact
  DepthImage depth(256, 256);
  for (int i = 0; i < 65536; ++i) depth.pixels()[i] = static_cast<float>(i * kUnit);
  EXPECT_EQ(RoundTrip(depth, kUnit).pixels(), depth.pixels());
}

TEST_F(Png, DepthThatIsNegativeOrNotFiniteIsNoMeasurement) {
  DepthImage depth(4, 1);
  depth.pixels() = {65.535f, -1.0f, std::numeric_limits<float>::quiet_NaN(),
                    std::numeric_limits<float>::infinity()};
  const DepthImage read = RoundTrip(depth, kMillimetre);
  EXPECT_FLOAT_EQ(read(0, 0), 65.535f);
  for (int u = 1; u < 4; ++u) EXPECT_EQ(read(u, 0), 0.0f) << "column " << u;
}

TEST_F(Png, RefusesFilesCutShortAnywhere) {
  const std::string whole = Whole();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ExpectRefused(whole.substr(0, size),
                  size < 8 ? "is not a PNG file" : fmt::format("cut short at byte {}", size));
  }
}

TEST_F(Png, RefusesAnyChangedByte) {
  const std::string whole = Whole();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    ExpectRefused(changed, "");
  }
}

TEST_F(Png, RefusesOtherBitsChannelsAndSizes) {
  WriteMaskPng(file_, MaskImage(kWidth, kHeight, 1));
  ExpectRefused(ReadWholeFile(file_), "expected one channel of 16 bits, found 1 of 8 bits");
  WriteGreyPng(file_, cv::Mat(kHeight, kWidth, CV_16UC3, cv::Scalar(1, 2, 3)));
  ExpectRefused(ReadWholeFile(file_), "expected one channel of 16 bits, found 3 of 16 bits");
  WriteDepthPng(file_, DepthImage(kHeight, kWidth), kMillimetre);
  ExpectRefused(ReadWholeFile(file_), "expected 7×5 pixels, found 5×7");
  EXPECT_THAT([&] { ReadDepthPng(folder_ / "none.png", kMillimetre, 1, 1); },
              ThrowsMessage<DataError>(HasSubstr("none.png: cannot be opened")));
}

TEST_F(Png, RefusesMisuse) {
  EXPECT_THROW(WriteDepthPng(file_, DepthImage(), kMillimetre), std::invalid_argument);
  EXPECT_THROW(WriteDepthPng(file_, RandomDepth(), 0.0), std::invalid_argument);
  EXPECT_THAT([&] { WriteDepthPng(folder_ / "no" / "a.png", RandomDepth(), kMillimetre); },
              ThrowsMessage<RunError>(HasSubstr("a.png: cannot be written")));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(Png, MaskComesBack) {
  MaskImage mask(kWidth, kHeight);
  for (int i = 0; i < kWidth * kHeight; ++i) mask.pixels()[i] = i % 3 == 0;
  WriteMaskPng(file_, mask);
  const MaskImage read = ReadMaskPng(file_, kWidth, kHeight);
  for (int i = 0; i < kWidth * kHeight; ++i) EXPECT_EQ(read.pixels()[i] != 0, i % 3 == 0);
  WriteDepthPng(file_, RandomDepth(), kMillimetre);
  EXPECT_THAT([&] { ReadMaskPng(file_, kWidth, kHeight); },
              ThrowsMessage<DataError>(HasSubstr("expected one channel of 8 bits")));
}

}  // namespace
}  // namespace vitruvia
