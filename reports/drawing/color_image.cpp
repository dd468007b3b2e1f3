#include "reports/drawing/color_image.h"

#include <algorithm>
#include <memory>
#include <png.h>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.h"

namespace vitruvia {
namespace {

// Of 0 … 9. With rows stored as differences, higher levels take several times as long for files
// that are a few per cent smaller.
constexpr int kCompression = 3;

bool IsOpaque(const ColorImage& image) {
  return std::ranges::all_of(image.pixels(), [](const ColorPixel& p) { return p[3] == 255; });
}

void AppendBytes(png_structp png, png_bytep bytes, png_size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))
      ->append(reinterpret_cast<const char*>(bytes), count);
}

[[noreturn]] void Refuse(png_structp /*png*/, png_const_charp message) {
  throw std::runtime_error(fmt::format("libpng cannot encode a picture: {}", message));
}

struct PngWriter {
  PngWriter() : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, Refuse, nullptr)) {
    info = png_create_info_struct(png);
  }
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  png_structp png;
  png_infop info = nullptr;
};

}  // namespace

std::string EncodePng(const ColorImage& image) {
  const int channels = IsOpaque(image) ? 3 : 4;
  std::string file;
  const PngWriter writer;
  png_set_write_fn(writer.png, &file, AppendBytes, nullptr);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width()),
               static_cast<png_uint_32>(image.height()), 8,
               channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(writer.png, kCompression);
  png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_write_info(writer.png, writer.info);
  std::vector<png_byte> row(static_cast<std::size_t>(channels * image.width()));
  for (int v = 0; v < image.height(); ++v) {
    png_byte* to = row.data();
    for (int u = 0; u < image.width(); ++u) to = std::copy_n(image(u, v).data(), channels, to);
    png_write_row(writer.png, row.data());
  }
  png_write_end(writer.png, nullptr);
  return file;
}

ColorImage ReadPng(const std::filesystem::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> owner(&png, png_image_free);
  if (png_image_begin_read_from_file(&png, file.c_str()) == 0)
    throw DataError(fmt::format("{}: not a PNG: {}", file.string(), png.message));
  png.format = PNG_FORMAT_RGBA;
  ColorImage image(static_cast<int>(png.width), static_cast<int>(png.height));
  if (png_image_finish_read(&png, nullptr, image.pixels().data(), 0, nullptr) == 0)
    throw DataError(fmt::format("{}: damaged PNG: {}", file.string(), png.message));
  return image;
}

std::string Base64(const void* bytes, std::size_t count) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* from = static_cast<const std::uint8_t*>(bytes);
  std::string text(4 * ((count + 2) / 3), '=');
  char* to = text.data();
  for (std::size_t i = 0; i < count; i += 3) {
    const std::size_t held = std::min<std::size_t>(3, count - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < held ? from[i + k] : 0u);
    for (std::size_t k = 0; k <= held; ++k) to[k] = kDigits[word >> (18 - 6 * k) & 63u];
    to += 4;
  }
  return text;
}

std::string DataUri(const std::string& png) {
  return "data:image/png;base64," + Base64(png.data(), png.size());
}

ColorImage OnWhite(ColorImage image) {
  for (ColorPixel& pixel : image.pixels()) {
    for (int c = 0; c < 3; ++c) {
      pixel[c] = static_cast<std::uint8_t>((pixel[c] * pixel[3] + 255 * (255 - pixel[3])) / 255);
    }
    pixel[3] = 255;
  }
  return image;
}

}  // namespace vitruvia
