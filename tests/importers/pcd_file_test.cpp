// Organised clouds: known points in all three layouts, and refusals.
#include "importers/pcd_file.h"

#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;

std::string Header(const std::string& data, const std::string& size = "WIDTH 2\nHEIGHT 2\n") {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x rgb y z\nSIZE 4 1 4 4\nTYPE F U F F\nCOUNT 1 3 1 1\n" +
         size + "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA " + data + "\n";
}

void AddFloat(float value, std::string& bytes) {
  char raw[4];
  std::memcpy(raw, &value, 4);
  bytes.append(raw, 4);
}

float X(int i) { return 0.5f + static_cast<float>(i); }
float Z(int i) { return i == 3 ? NAN : 2.0f + static_cast<float>(i); }

class PcdFile : public testing::Test {
 protected:
  void ExpectPoints(const std::string& content) const {
    WriteWholeFile(file_, content);
    const OrganisedCloud cloud = ReadOrganisedPcd(file_);
    ASSERT_EQ(cloud.width, 2);
    ASSERT_EQ(cloud.height, 2);
    for (int i = 0; i < 4; ++i) {
      const Vector3f& p = cloud.points[static_cast<std::size_t>(i)];
      EXPECT_EQ(p.x(), X(i));
      EXPECT_EQ(p.y(), -X(i));
      EXPECT_TRUE(p.z() == Z(i) || (std::isnan(p.z()) && i == 3)) << i;
    }
  }

  void ExpectRefused(const std::string& content, const std::string& words) const {
    WriteWholeFile(file_, content);
    try {
      ReadOrganisedPcd(file_);
      FAIL() << "expected: " << words;
    } catch (const DataError& error) {
      EXPECT_THAT(error.what(), HasSubstr(words));
    }
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "cloud.pcd";
};

std::string BinaryPoints() {
  std::string bytes;
  for (int i = 0; i < 4; ++i) {
    AddFloat(X(i), bytes);
    bytes += "rgb";
    AddFloat(-X(i), bytes);
    AddFloat(Z(i), bytes);
  }
  return bytes;
}

TEST_F(PcdFile, AsciiAndBinaryHoldTheSamePoints) {
  ExpectPoints(Header("ascii") +
               "0.5 1 2 3 -0.5 2\n1.5 1 2 3 -1.5 3\n2.5 1 2 3 -2.5 4\n3.5 1 2 3 -3.5 nan\n");
  ExpectPoints(Header("binary") + BinaryPoints());
}

// The compressed layout: field after field; literal runs and one back reference.
TEST_F(PcdFile, CompressedPointsUnpack) {
  std::string x, y, z;
  for (int i = 0; i < 4; ++i) {
    AddFloat(X(i), x);
    AddFloat(-X(i), y);
    AddFloat(Z(i), z);
  }
  const auto literal = [](const std::string& bytes) {
    return std::string(1, static_cast<char>(bytes.size() - 1)) + bytes;
  };
  // "rgbrgbrgbrgb": three literals, then nine bytes from three back (length 7 + 2, distance 3).
  const std::string colors = literal("rgb") + std::string("\xE0\x00\x02", 3);
  const std::string packed = literal(x) + colors + literal(y) + literal(z);
  const auto size_of = [](std::size_t size) {
    const auto value = static_cast<std::uint32_t>(size);
    char raw[4];
    std::memcpy(raw, &value, 4);
    return std::string(raw, 4);
  };
  const std::string sizes = size_of(packed.size()) + size_of(4 * 15);
  ExpectPoints(Header("binary_compressed") + sizes + packed);
  ExpectRefused(Header("binary_compressed") + sizes + packed.substr(0, 20), "cut short");
  std::string damaged = packed;
  damaged[0] = 30;  // a literal run that eats the next command
  ExpectRefused(Header("binary_compressed") + sizes + damaged, "do not unpack");
}

TEST_F(PcdFile, DamagedCloudsAreRefused) {
  ExpectRefused("", "line DATA");
  ExpectRefused("\x89PNG", "PCD header");
  ExpectRefused(Header("binary") + "x", "cut short: expected 60 bytes");
  ExpectRefused(Header("ascii") + "0.5 1 2 3 -0.5 2\n", "cut short");
  ExpectRefused(Header("ascii") + "0.5 1 2 3 -0.5 two\n", "expected a number");
  ExpectRefused(Header("zip"), "DATA: expected ascii");
  ExpectRefused(Header("binary", "WIDTH 4\nHEIGHT 1\n"), "expected an organised cloud");
  ExpectRefused("FIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 2\nHEIGHT 2\nDATA ascii\n",
                "found no z");
  ExpectRefused("FIELDS x y z\nSIZE 4 4\n", "expected 3 words");
}

}  // namespace
}  // namespace vitruvia
