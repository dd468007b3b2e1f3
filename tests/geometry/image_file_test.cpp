#include "geometry/image_file.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "support/temporary_folder.h"
#include "support/written_image.h"

namespace vitruvia {
namespace {

Image<float> Ramp(float step) {
  Image<float> image(7, 5);
  for (std::size_t i = 0; i < image.pixels().size(); ++i)
    image.pixels()[i] = step * static_cast<float>(i);
  return image;
}

TEST(ImageFile, EveryKindGivesBackItsNumbers) {
  const TemporaryFolder folder;
  const auto same = [&](const std::string& name, const Image<float>& image, int numbers) {
    EXPECT_TRUE(IsImageFile(folder / name));
    WriteImageFile(folder / name, image, numbers);
    EXPECT_EQ(ReadImageFile(folder / name).values.pixels(), image.pixels()) << name;
  };
  same("8.png", Ramp(7.0f), CV_8UC1);
  same("16.png", Ramp(1900.0f), CV_16UC1);
  same("16.PGM", Ramp(1900.0f), CV_16UC1);
  same("16.tiff", Ramp(1900.0f), CV_16UC1);
  same("float.tif", Ramp(0.123f), CV_32FC1);
  same("float.exr", Ramp(0.123f), CV_32FC1);
}

TEST(ImageFile, NumbersThatAreNotFiniteStay) {
  const TemporaryFolder folder;
  Image<float> image = Ramp(0.5f);
  image(1, 1) = std::numeric_limits<float>::quiet_NaN();
  image(2, 1) = std::numeric_limits<float>::infinity();
  WriteImageFile(folder / "a.tiff", image, CV_32FC1);
  const Image<float> read = ReadImageFile(folder / "a.tiff").values;
  EXPECT_TRUE(std::isnan(read(1, 1)));
  EXPECT_TRUE(std::isinf(read(2, 1)));
}

TEST(ImageFile, DamagedFilesAreNamed) {
  const TemporaryFolder folder;
  WriteImageFile(folder / "a.png", Ramp(1900.0f), CV_16UC1);
  const std::string whole = ReadWholeFile(folder / "a.png");
  for (const std::string& content : {std::string(), std::string("text"), whole.substr(0, 40)}) {
    WriteWholeFile(folder / "a.png", content);
    try {
      ReadImageFile(folder / "a.png");
      ADD_FAILURE() << content.size();
    } catch (const DataError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("a.png"));
    }
  }
  EXPECT_FALSE(IsImageFile("a.jpg"));
}

}  // namespace
}  // namespace vitruvia
