#include "geometry/grey_png.h"

#include <array>
#include <string>
#include <string_view>

#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr int kGreyscale = 0;  // PNG colour type

std::uint32_t BigEndian32(std::string_view bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

// CRC-32 as PNG defines it (annex D).
std::uint32_t Crc32(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      std::uint32_t c = n;
      for (int k = 0; k < 8; ++k) c = (c & 1) ? 0xedb88320u ^ (c >> 1) : c >> 1;
      table[n] = c;
    }
    return table;
  }();
  std::uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) {
    crc = kTable[(crc ^ static_cast<std::uint8_t>(byte)) & 0xff] ^ (crc >> 8);
  }
  return ~crc;
}

struct PngHeader {
  std::uint32_t width = 0, height = 0;
  int bit_depth = 0, color_type = 0;
};

// Walks all chunks and their check sums. The decoder alone does not do: of a file cut short it
// returns what rows it has, as if they were the image.
PngHeader CheckPng(std::string_view bytes, const std::string& where) {
  const auto refuse = [&](const std::string& reason) {
    throw DataError(fmt::format("{}: {}", where, reason));
  };
  if (bytes.substr(0, kSignature.size()) != kSignature) refuse("is not a PNG file");
  constexpr std::size_t kFrame = 12;  // length, type and check sum round a chunk's data
  constexpr std::size_t kHeaderSize = 13;
  PngHeader header;
  std::size_t at = kSignature.size();
  for (bool first = true;; first = false) {
    if (bytes.size() - at < kFrame) refuse(fmt::format("cut short at byte {}", bytes.size()));
    const std::size_t size = BigEndian32(bytes.substr(at));
    if (bytes.size() - at - kFrame < size) {
      refuse(fmt::format("cut short at byte {}", bytes.size()));
    }
    const std::string_view type = bytes.substr(at + 4, 4), data = bytes.substr(at + 8, size);
    if (Crc32(bytes.substr(at + 4, size + 4)) != BigEndian32(bytes.substr(at + 8 + size))) {
      refuse(fmt::format("damaged: wrong check sum in the chunk at byte {}", at));
    }
    if (first) {
      if (type != "IHDR" || size != kHeaderSize) refuse("damaged: has no PNG header");
      header = {BigEndian32(data), BigEndian32(data.substr(4)), data[8], data[9]};
    }
    if (type == "IEND") return header;
    at += size + kFrame;
  }
}

}  // namespace

cv::Mat ReadGreyPng(const std::filesystem::path& file, int bits, int width, int height) {
  const std::string where = file.string();
  std::string bytes = ReadWholeFile(file);
  const PngHeader header = CheckPng(bytes, where);
  if (header.bit_depth != bits || header.color_type != kGreyscale) {
    throw DataError(
        fmt::format("{}: expected one channel of {} bits, found {} bits of PNG colour type {}",
                    where, bits, header.bit_depth, header.color_type));
  }
  if (std::cmp_not_equal(header.width, width) || std::cmp_not_equal(header.height, height)) {
    throw DataError(fmt::format("{}: expected {}×{} pixels, found {}×{}", where, width, height,
                                header.width, header.height));
  }
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1, bytes.data());
  cv::Mat raw;
  try {
    raw = cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw DataError(fmt::format("{}: cannot be decoded: {}", where, error.err));
  }
  if (raw.type() != (bits == 16 ? CV_16UC1 : CV_8UC1) || raw.cols != width || raw.rows != height) {
    throw DataError(fmt::format("{}: damaged: its pixels cannot be decoded", where));
  }
  return raw;
}

void WriteGreyPng(const std::filesystem::path& file, const cv::Mat& raw) {
  std::vector<std::uint8_t> encoded;
  if (!cv::imencode(".png", raw, encoded)) {
    throw RunError(fmt::format("{}: cannot be encoded as PNG", file.string()));
  }
  WriteWholeFile(file, {reinterpret_cast<const char*>(encoded.data()), encoded.size()});
}

}  // namespace vitruvia
