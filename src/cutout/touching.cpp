#include "cutout/touching.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace vitruvia {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();

Vector3f UpOf(const Room& room) {
  return room.floor ? room.floor->up : Vector3f(-Vector3f::UnitY());
}

float HeightOf(const Vector3f& point, const Room& room) {
  return room.floor ? room.floor->HeightOf(point) : UpOf(room).dot(point);
}

// The points of one piece, column by column.
class PieceView {
 public:
  PieceView(const DepthImage& depth, const Image<std::int16_t>& labels, int label, const Room& room)
      : depth_(depth), labels_(labels), label_(label), room_(room) {}

  template <class Visit>
  void ForEach(const Visit& visit) const {
    for (int v = 0; v < depth_.height(); ++v) {
      for (int u = 0; u < depth_.width(); ++u) {
        if (labels_(u, v) != label_) continue;
        visit(u, v,
              room_.camera.Unproject(static_cast<float>(u), static_cast<float>(v), depth_(u, v)));
      }
    }
  }

  // The highest point of each column; kNothing where the piece has none.
  std::vector<float> Tops() const {
    std::vector<float> tops(static_cast<std::size_t>(depth_.width()), kNothing);
    ForEach([&](int u, int, const Vector3f& p) {
      float& top = tops[static_cast<std::size_t>(u)];
      top = std::max(top, HeightOf(p, room_));
    });
    return tops;
  }

 private:
  const DepthImage& depth_;
  const Image<std::int16_t>& labels_;
  int label_;
  const Room& room_;
};

// A column from which the outline falls by some height on both sides before it rises higher.
struct Peak {
  float top_m = 0.0f;
  int left = 0, right = 0;  // columns in which the outline is near the top
};

// The last column that is near the top on one side of it (step −1 or 1); nothing where the outline
// rises before it has fallen. Of columns of equal height the leftmost is the top.
std::optional<int> NearTop(const std::vector<float>& tops, int column, int step, float drop_m) {
  const float top = tops[static_cast<std::size_t>(column)];
  int last = column;
  for (int u = column + step; u >= 0 && u < static_cast<int>(tops.size()); u += step) {
    const float here = tops[static_cast<std::size_t>(u)];
    if (here > top || (here == top && step < 0)) return std::nullopt;
    if (here <= top - drop_m) break;
    last = u;
  }
  return last;
}

std::vector<Peak> PeaksOf(const std::vector<float>& tops, float drop_m) {
  std::vector<Peak> peaks;
  for (int u = 0; u < static_cast<int>(tops.size()); ++u) {
    const float top = tops[static_cast<std::size_t>(u)];
    if (top == kNothing) continue;
    const auto left = NearTop(tops, u, -1, drop_m), right = NearTop(tops, u, 1, drop_m);
    if (left && right) peaks.push_back({top, *left, *right});
  }
  return peaks;
}

struct Head {
  Vector3f middle = Vector3f::Zero();
  double area_m2 = 0.0;
};

// What of the piece is near each peak's top.
std::vector<Head> HeadsAt(const std::vector<Peak>& peaks, const PieceView& view, const Room& room,
                          const TouchingSettings& settings) {
  std::vector<Head> heads(peaks.size());
  std::vector<int> counts(peaks.size(), 0);
  const auto drop = static_cast<float>(settings.head_drop_m);
  view.ForEach([&](int u, int, const Vector3f& p) {
    for (std::size_t k = 0; k < peaks.size(); ++k) {
      if (u < peaks[k].left || u > peaks[k].right || HeightOf(p, room) < peaks[k].top_m - drop)
        continue;
      heads[k].middle += p;
      heads[k].area_m2 += double{p.z()} * p.z() / (room.camera.fx * room.camera.fy);
      ++counts[k];
    }
  });
  for (std::size_t k = 0; k < heads.size(); ++k)
    heads[k].middle /= static_cast<float>(std::max(1, counts[k]));
  return heads;
}

float HorizontalDistance(const Vector3f& a, const Vector3f& b, const Vector3f& up) {
  const Vector3f d = a - b;
  return (d - up * up.dot(d)).norm();
}

// Heads that are large enough and apart from each other; of two that are near, the larger.
std::vector<Vector3f> PlausibleHeads(std::vector<Head> heads, const Vector3f& up,
                                     const TouchingSettings& settings) {
  std::stable_sort(heads.begin(), heads.end(),
                   [](const Head& a, const Head& b) { return a.area_m2 > b.area_m2; });
  std::vector<Vector3f> kept;
  for (const Head& head : heads) {
    if (head.area_m2 < settings.least_head_m2) break;
    const bool apart = std::all_of(kept.begin(), kept.end(), [&](const Vector3f& other) {
      return HorizontalDistance(head.middle, other, up) >= settings.apart_m;
    });
    if (apart) kept.push_back(head.middle);
  }
  return kept;
}

std::size_t NearestHead(const Vector3f& point, const std::vector<Vector3f>& heads,
                        const Vector3f& up) {
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < heads.size(); ++k) {
    if (HorizontalDistance(point, heads[k], up) < HorizontalDistance(point, heads[nearest], up))
      nearest = k;
  }
  return nearest;
}

// The head whose part is the least like a person; -1 if all parts are like one.
int LeastPlausible(const std::vector<Vector3f>& heads, const Piece& piece, const PieceView& view,
                   const Room& room, const TouchingSettings& settings) {
  const Vector3f up = UpOf(room);
  std::vector<double> areas(heads.size(), 0.0);
  std::vector<float> lowest(heads.size(), std::numeric_limits<float>::infinity());
  std::vector<float> highest(heads.size(), kNothing);
  view.ForEach([&](int, int, const Vector3f& p) {
    const std::size_t k = NearestHead(p, heads, up);
    areas[k] += double{p.z()} * p.z() / (room.camera.fx * room.camera.fy);
    lowest[k] = std::min(lowest[k], HeightOf(p, room));
    highest[k] = std::max(highest[k], HeightOf(p, room));
  });
  const auto smallest =
      static_cast<std::size_t>(std::min_element(areas.begin(), areas.end()) - areas.begin());
  const bool is_tall = highest[smallest] - lowest[smallest] >=
                       settings.least_height_share * static_cast<double>(piece.height_m());
  return areas[smallest] >= settings.least_area_m2 && is_tall ? -1 : static_cast<int>(smallest);
}

// The heads among which a piece is to be divided; fewer than two: it stays whole.
std::vector<Vector3f> HeadsOf(const Piece& piece, const PieceView& view, const Room& room,
                              const TouchingSettings& settings) {
  const std::vector<Peak> peaks = PeaksOf(view.Tops(), static_cast<float>(settings.head_drop_m));
  if (peaks.size() < 2) return {};
  std::vector<Vector3f> heads =
      PlausibleHeads(HeadsAt(peaks, view, room, settings), UpOf(room), settings);
  while (heads.size() > 1) {
    const int worst = LeastPlausible(heads, piece, view, room, settings);
    if (worst < 0) break;
    heads.erase(heads.begin() + worst);
  }
  return heads;
}

}  // namespace

void DivideTouchingPeople(const DepthImage& depth, const Room& room, const CutoutSettings& settings,
                          Pieces& pieces) {
  const TouchingSettings& touching = settings.person.touching;
  const int count = static_cast<int>(pieces.pieces.size());
  for (int label = 1; label <= count; ++label) {
    const Piece& piece = pieces.Labelled(label);
    if (piece.area_m2 < 2.0 * touching.least_area_m2) break;  // and so are all that follow
    if (piece.height_m() > settings.person.size.most_height_m) continue;
    const PieceView view(depth, pieces.labels, label, room);
    const std::vector<Vector3f> heads = HeadsOf(piece, view, room, touching);
    if (heads.size() < 2) continue;
    const int first_new = static_cast<int>(pieces.pieces.size());
    view.ForEach([&](int u, int v, const Vector3f& p) {
      const auto k = static_cast<int>(NearestHead(p, heads, UpOf(room)));
      if (k > 0) pieces.labels(u, v) = static_cast<std::int16_t>(first_new + k);
    });
    pieces.pieces.resize(pieces.pieces.size() + heads.size() - 1);
  }
  if (static_cast<int>(pieces.pieces.size()) > count) MeasurePieces(depth, room, settings, pieces);
}

}  // namespace vitruvia
