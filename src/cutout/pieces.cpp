#include "cutout/pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/disjoint_sets.h"

namespace vitruvia {
namespace {

constexpr int kMostPieces = std::numeric_limits<std::int16_t>::max();

// Joins the pixels of one image.
class Joining {
 public:
  Joining(const DepthImage& depth, const MaskImage& foreground, const Room& room,
          const CutoutSettings& s)
      : depth_(depth),
        foreground_(foreground),
        room_(room),
        step_m_(static_cast<float>(s.pieces.step_m)),
        sigmas_(2.0f * static_cast<float>(s.noise_sigmas)),
        gap_m_(static_cast<float>(s.pieces.gap_m)),
        sets_(depth.pixels().size()) {}

  DisjointSets& Joined() {
    const int width = depth_.width(), height = depth_.height();
    const auto reach_u = static_cast<float>(gap_m_ * room_.camera.fx);
    const auto reach_v = static_cast<float>(gap_m_ * room_.camera.fy);
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        const int pixel = v * width + u;
        if (foreground_.pixels()[static_cast<std::size_t>(pixel)] == 0) continue;
        const float z = depth_.pixels()[static_cast<std::size_t>(pixel)];
        const float step = std::max(step_m_, sigmas_ * room_.NoiseAt(z));
        JoinNext(pixel, 1, std::min(width - 1 - u, 1 + static_cast<int>(reach_u / z)), z, step);
        JoinNext(pixel, width, std::min(height - 1 - v, 1 + static_cast<int>(reach_v / z)), z,
                 step);
      }
    }
    return sets_;
  }

 private:
  // Along a row or column, `stride` pixels apart, over at most `most` of them.
  void JoinNext(int pixel, int stride, int most, float z, float step) {
    for (int i = 1, other = pixel + stride; i <= most; ++i, other += stride) {
      const float next = depth_.pixels()[static_cast<std::size_t>(other)];
      if (!(next > 0.0f) || next < z - step) continue;
      if (next <= z + step && foreground_.pixels()[static_cast<std::size_t>(other)] != 0)
        sets_.Join(pixel, other);
      return;
    }
  }

  const DepthImage& depth_;
  const MaskImage& foreground_;
  const Room& room_;
  float step_m_, sigmas_, gap_m_;
  DisjointSets sets_;
};

void Add(const Vector3f& point, const Room& room, Piece& piece) {
  const Vector3f up = room.floor ? room.floor->up : -Vector3f::UnitY();
  const float height = room.floor ? room.floor->HeightOf(point) : up.dot(point);
  piece.lowest_m = piece.pixels == 0 ? height : std::min(piece.lowest_m, height);
  piece.highest_m = piece.pixels == 0 ? height : std::max(piece.highest_m, height);
  ++piece.pixels;
  piece.mean_depth_m += point.z();
  piece.area_m2 += double{point.z()} * point.z() / (room.camera.fx * room.camera.fy);
  piece.box.extend(point);
}

bool IsPersonSized(const Piece& piece, const PersonSizeSettings& size) {
  return piece.height_m() >= size.least_height_m && piece.height_m() <= size.most_height_m &&
         piece.box.sizes().x() <= size.most_width_m && piece.area_m2 >= size.least_area_m2;
}

// Numbers in place of the sets' names, in the order of their first pixels.
int LabelPixels(const MaskImage& foreground, DisjointSets& sets, Image<std::int16_t>& labels) {
  std::vector<std::int16_t> label_of(foreground.pixels().size(), 0);
  int count = 0;
  for (std::size_t i = 0; i < foreground.pixels().size(); ++i) {
    if (foreground.pixels()[i] == 0) continue;
    std::int16_t& label = label_of[static_cast<std::size_t>(sets.Find(static_cast<int>(i)))];
    if (label == 0 && count < kMostPieces) label = static_cast<std::int16_t>(++count);
    labels.pixels()[i] = label;
  }
  return count;
}

// Keeps the pieces that are large enough, the largest first.
void Sort(double least_area_m2, Pieces& found) {
  const std::vector<Piece> pieces = std::move(found.pieces);
  std::vector<int> order(pieces.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](int i) -> const Piece& { return pieces[static_cast<std::size_t>(i)]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return at(a).area_m2 > at(b).area_m2; });
  found.pieces.clear();
  std::vector<std::int16_t> new_label(pieces.size() + 1, 0);
  for (const int i : order) {
    if (at(i).area_m2 < least_area_m2) break;
    found.pieces.push_back(at(i));
    new_label[static_cast<std::size_t>(i) + 1] = static_cast<std::int16_t>(found.pieces.size());
  }
  for (std::int16_t& label : found.labels.pixels())
    label = new_label[static_cast<std::size_t>(label)];
}

}  // namespace

void MeasurePieces(const DepthImage& depth, const Room& room, const CutoutSettings& settings,
                   Pieces& pieces) {
  pieces.pieces.assign(pieces.pieces.size(), {});
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const int label = pieces.labels(u, v);
      if (label == 0) continue;
      Add(room.camera.Unproject(static_cast<float>(u), static_cast<float>(v), depth(u, v)), room,
          pieces.pieces[static_cast<std::size_t>(label - 1)]);
    }
  }
  for (Piece& piece : pieces.pieces) {
    piece.mean_depth_m /= std::max(1, piece.pixels);
    piece.person_sized = IsPersonSized(piece, settings.person.size);
  }
  Sort(settings.pieces.least_area_m2, pieces);
}

Pieces FindPieces(const DepthImage& depth, const MaskImage& foreground, const Room& room,
                  const CutoutSettings& settings) {
  Joining joining(depth, foreground, room, settings);
  Pieces pieces;
  pieces.labels = Image<std::int16_t>(depth.width(), depth.height());
  const int count = LabelPixels(foreground, joining.Joined(), pieces.labels);
  pieces.pieces.resize(static_cast<std::size_t>(count));
  MeasurePieces(depth, room, settings, pieces);
  return pieces;
}

}  // namespace vitruvia
