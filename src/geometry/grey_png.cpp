#include "geometry/grey_png.h"

#include <png.h>
#include <string>
#include <string_view>

#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);

// Images of depth and masks are read once for each run and written once. Rows as they are, at this
// level of zlib, are read in a third of the time that differences of neighbours with run lengths
// take. Level 3 takes two and a half times as long to write noisy depth and saves an eighth of its
// bytes.
constexpr int kCompression = 1;

void AppendBytes(png_structp png, png_bytep bytes, png_size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))
      ->append(reinterpret_cast<const char*>(bytes), count);
}

[[noreturn]] void Refuse(png_structp /*png*/, png_const_charp message) {
  throw RunError(fmt::format("cannot be encoded as PNG: {}", message));
}

struct Encoder {
  Encoder() : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, Refuse, nullptr)) {
    info = png_create_info_struct(png);
    png_set_write_fn(png, &bytes, AppendBytes, nullptr);
  }
  ~Encoder() { png_destroy_write_struct(&png, &info); }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  std::string bytes;
  png_structp png;
  png_infop info = nullptr;
};

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
  Encoder encoder;
  png_set_IHDR(encoder.png, encoder.info, static_cast<png_uint_32>(raw.cols),
               static_cast<png_uint_32>(raw.rows), static_cast<int>(8 * raw.elemSize1()),
               raw.channels() == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(encoder.png, kCompression);
  png_set_filter(encoder.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_write_info(encoder.png, encoder.info);
  png_set_swap(encoder.png);  // to big-endian
  for (int row = 0; row < raw.rows; ++row) png_write_row(encoder.png, raw.ptr(row));
  png_write_end(encoder.png, nullptr);
  WriteWholeFile(file, encoder.bytes);
}

}  // namespace vitruvia
