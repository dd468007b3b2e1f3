#include "geometry/grey_png.h"

#include <string>
#include <string_view>

#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);

}  // namespace

cv::Mat DecodeImage(std::string& bytes, const std::string& where) {
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1, bytes.data());
  try {
    return cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw DataError(fmt::format("{}: cannot be decoded: {}", where, error.err));
  }
}

cv::Mat ReadGreyPng(const std::filesystem::path& file, int bits, int width, int height) {
  const std::string where = file.string();
  std::string bytes = ReadWholeFile(file);
  if (!bytes.starts_with(kSignature)) throw DataError(fmt::format("{}: is not a PNG file", where));
  cv::Mat raw = DecodeImage(bytes, where);
  if (raw.empty()) {
    throw DataError(bytes.ends_with(kEnd)
                        ? fmt::format("{}: damaged: its pixels cannot be decoded", where)
                        : fmt::format("{}: cut short at byte {}", where, bytes.size()));
  }
  if (raw.type() != (bits == 16 ? CV_16UC1 : CV_8UC1)) {
    throw DataError(fmt::format("{}: expected one channel of {} bits, found {} of {} bits", where,
                                bits, raw.channels(), 8 * raw.elemSize1()));
  }
  if (raw.cols != width || raw.rows != height) {
    throw DataError(fmt::format("{}: expected {}×{} pixels, found {}×{}", where, width, height,
                                raw.cols, raw.rows));
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
