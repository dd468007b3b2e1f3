#include "cutout/sheet.h"

#include <algorithm>
#include <array>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.h"

namespace vitruvia {
namespace {

constexpr int kTileWidth = 320, kOnlyTileWidth = 960;  // pixels; of many frames and of one
constexpr int kColumns = 4;
constexpr int kBorder = 4;

using Color = cv::Vec3f;  // blue, green, red
constexpr std::array<std::array<float, 3>, 5> kOthers{
    {{255, 160, 40}, {40, 160, 255}, {220, 90, 220}, {220, 220, 60}, {90, 90, 255}}};
const Color kChosen(60, 210, 60);

bool IsChosen(int person, const ChosenPerson& chosen) {
  return std::find(chosen.numbers.begin(), chosen.numbers.end(), person) != chosen.numbers.end();
}

Color ColorOf(int person, const ChosenPerson& chosen) {
  if (IsChosen(person, chosen)) return kChosen;
  const auto& color = kOthers[static_cast<std::size_t>(person) % kOthers.size()];
  return {color[0], color[1], color[2]};
}

// Near is bright; black where nothing is measured.
std::pair<float, float> DepthRange(const DepthImage& depth) {
  std::vector<float> measured;
  for (const float z : depth.pixels()) {
    if (z > 0.0f) measured.push_back(z);
  }
  if (measured.empty()) return {0.0f, 1.0f};
  const auto at = [&](double share) {
    const auto place = measured.begin() + static_cast<std::ptrdiff_t>(
                                              share * static_cast<double>(measured.size() - 1));
    std::nth_element(measured.begin(), place, measured.end());
    return *place;
  };
  const float near = at(0.01), far = at(0.99);
  return {near, std::max(far, near + 0.1f)};
}

cv::Mat Colored(const SheetFrame& frame, const ChosenPerson& chosen) {
  const auto [near, far] = DepthRange(frame.depth);
  cv::Mat picture(frame.depth.height(), frame.depth.width(), CV_8UC3);
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const float z = frame.depth(u, v);
      const float grey =
          z > 0.0f ? 60.0f + 180.0f * std::clamp((far - z) / (far - near), 0.0f, 1.0f) : 0.0f;
      const int person = frame.people(u, v);
      Color color(grey, grey, grey);
      if (person > 0) color = 0.35f * color + 0.65f * ColorOf(person, chosen);
      for (int c = 0; c < 3; ++c)
        picture.at<cv::Vec3b>(v, u)[c] = static_cast<std::uint8_t>(color[c]);
    }
  }
  return picture;
}

void Write(const std::string& text, cv::Point at, double size, cv::Mat& picture) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, {0, 0, 0}, 3, cv::LINE_AA);
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, {255, 255, 255}, 1, cv::LINE_AA);
}

// Each person's number at the middle of their pixels.
void WriteNumbers(const Image<std::uint8_t>& people, double scale, cv::Mat& tile) {
  struct Sum {
    double u = 0.0, v = 0.0;
    int count = 0;
  };
  std::array<Sum, 256> sums{};
  for (int v = 0; v < people.height(); ++v) {
    for (int u = 0; u < people.width(); ++u) {
      Sum& sum = sums[people(u, v)];
      sum.u += u;
      sum.v += v;
      ++sum.count;
    }
  }
  for (std::size_t person = 1; person < sums.size(); ++person) {
    const Sum& sum = sums[person];
    if (sum.count == 0) continue;
    Write(std::to_string(person),
          {static_cast<int>(scale * sum.u / sum.count) - 5,
           static_cast<int>(scale * sum.v / sum.count) + 5},
          0.5, tile);
  }
}

cv::Mat Tile(const SheetFrame& frame, const ChosenPerson& chosen, int width) {
  const double scale = width / double(frame.depth.width());
  cv::Mat tile;
  cv::resize(Colored(frame, chosen), tile,
             {width, std::max(1, static_cast<int>(scale * frame.depth.height()))}, 0, 0,
             scale < 1.0 ? cv::INTER_AREA : cv::INTER_NEAREST);
  WriteNumbers(frame.people, scale, tile);
  Write("frame " + std::to_string(frame.frame) + (frame.is_unsure ? ", unsure" : ""), {8, 18}, 0.45,
        tile);
  const cv::Scalar border = frame.is_unsure ? cv::Scalar(60, 60, 230) : cv::Scalar(255, 255, 255);
  cv::copyMakeBorder(tile, tile, kBorder, kBorder, kBorder, kBorder, cv::BORDER_CONSTANT, border);
  return tile;
}

}  // namespace

std::string CutoutSheet(const std::vector<SheetFrame>& frames, const ChosenPerson& chosen) {
  Require(!frames.empty(), "CutoutSheet: no frames");
  std::vector<cv::Mat> tiles;
  const int tile_width = frames.size() == 1 ? kOnlyTileWidth : kTileWidth;
  for (const SheetFrame& frame : frames) tiles.push_back(Tile(frame, chosen, tile_width));
  const int columns = std::min(kColumns, static_cast<int>(tiles.size()));
  const int rows = (static_cast<int>(tiles.size()) + columns - 1) / columns;
  const int width = tiles.front().cols, height = tiles.front().rows;
  cv::Mat sheet(rows * height, columns * width, CV_8UC3, cv::Scalar(255, 255, 255));
  for (int i = 0; i < static_cast<int>(tiles.size()); ++i) {
    tiles[static_cast<std::size_t>(i)].copyTo(
        sheet(cv::Rect((i % columns) * width, (i / columns) * height, width, height)));
  }
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", sheet, bytes)) throw RunError("preview cannot be encoded as PNG");
  return {bytes.begin(), bytes.end()};
}

}  // namespace vitruvia
