#include "reports/drawing/thumbnail.h"

#include <algorithm>

#include <fmt/format.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "core/error.h"

namespace vitruvia {
namespace {

ColorPixel MeanOfBlock(const ColorImage& image, int left, int top, int size) {
  std::array<int, 3> sum{};
  for (int k = 0; k < size * size; ++k) {
    const ColorPixel& pixel = image(left + k % size, top + k / size);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += pixel[c];
  }
  ColorPixel mean{0, 0, 0, 255};
  for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<std::uint8_t>(sum[c] / (size * size));
  return mean;
}

}  // namespace

ColorImage ReadPng(const std::filesystem::path& file) {
  vtkNew<vtkPNGReader> reader;
  if (reader->CanReadFile(file.c_str()) == 0)
    throw DataError(fmt::format("{}: not a PNG", file.string()));
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData* data = reader->GetOutput();
  const int* size = data->GetDimensions();
  const int channels = data->GetNumberOfScalarComponents();
  ColorImage image(size[0], size[1]);
  for (int v = 0; v < size[1]; ++v) {
    for (int u = 0; u < size[0]; ++u) {
      const auto* pixel =
          static_cast<const std::uint8_t*>(data->GetScalarPointer(u, size[1] - 1 - v, 0));
      image(u, v) = {pixel[0], pixel[channels > 2 ? 1 : 0], pixel[channels > 2 ? 2 : 0], 255};
    }
  }
  return image;
}

ColorImage Thumbnail(const ColorImage& image, int width, double aspect) {
  const int block = std::max(1, (image.width() + width - 1) / width);
  const int small_width = image.width() / block;
  const int height = std::min(image.height() / block, static_cast<int>(aspect * small_width));
  ColorImage small(small_width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < small_width; ++u)
      small(u, v) = MeanOfBlock(image, u * block, v * block, block);
  }
  return small;
}

}  // namespace vitruvia
