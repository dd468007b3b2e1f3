#include "reports/figures/tree_drawing.h"

#include <algorithm>
#include <cmath>

namespace vitruvia {
namespace {

constexpr double kColumnWidth = 138.0, kRowHeight = 38.0, kTreeMargin = 16.0;
constexpr double kNameSize = 12.0, kDetailSize = 10.0, kDotRadius = 4.0, kTextGap = 8.0;
constexpr double kNameRise = 8.0, kDetailFall = 9.0;  // of the text beside a node
constexpr Color kInk{0x22, 0x22, 0x22}, kSoftInk{0x5a, 0x63, 0x6b}, kLineInk{0xBB, 0xBB, 0xBB};

// Where each node stands, in columns (its depth) and rows (its leaves' middle).
struct TreeLayout {
  std::vector<int> column;
  std::vector<double> row;
  int columns = 0, rows = 0;
};

// Nodes are in the order parents first, so children come later than their parents.
TreeLayout LayOut(const BoneTree& tree) {
  const std::size_t count = tree.nodes.size();
  TreeLayout layout{std::vector<int>(count, 0), std::vector<double>(count, 0.0), 0, 0};
  std::vector<std::vector<std::size_t>> children(count);
  for (std::size_t i = 1; i < count; ++i) {
    const auto parent = static_cast<std::size_t>(tree.nodes[i].parent);
    children[parent].push_back(i);
    layout.column[i] = layout.column[parent] + 1;
  }
  layout.columns = 1 + *std::max_element(layout.column.begin(), layout.column.end());
  // Leaves take rows in depth-first order, so that lines do not cross.
  std::vector<std::size_t> open{0};
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    if (children[node].empty()) layout.row[node] = layout.rows++;
    open.insert(open.end(), children[node].rbegin(), children[node].rend());
  }
  for (std::size_t i = count; i-- > 0;) {
    if (children[i].empty()) continue;
    layout.row[i] = 0.5 * (layout.row[children[i].front()] + layout.row[children[i].back()]);
  }
  return layout;
}

Point PlaceOf(const TreeLayout& layout, std::size_t node) {
  return {kTreeMargin + kColumnWidth * layout.column[node],
          kTreeMargin + kRowHeight * (layout.row[node] + 0.5)};
}

}  // namespace

TreeSize SizeOf(const BoneTree& tree) {
  const TreeLayout layout = LayOut(tree);
  return {static_cast<int>(std::lround(2 * kTreeMargin + kColumnWidth * layout.columns)),
          static_cast<int>(std::lround(2 * kTreeMargin + kRowHeight * layout.rows))};
}

void DrawTree(Canvas& canvas, const BoneTree& tree) {
  const TreeSize size = SizeOf(tree);
  const TreeLayout layout = LayOut(tree);
  canvas.Rectangle({0, 0}, size.width, size.height, {0xFF, 0xFF, 0xFF});
  for (std::size_t i = 1; i < tree.nodes.size(); ++i) {
    const Point from = PlaceOf(layout, static_cast<std::size_t>(tree.nodes[i].parent));
    const Point to = PlaceOf(layout, i);
    const double bend = to.x - kTextGap;  // beyond the parent's text
    canvas.Polyline({from, {bend, from.y}, {bend, to.y}, to}, {kLineInk, 1.5});
  }
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Point at = PlaceOf(layout, i);
    canvas.Disc(at, kDotRadius, kInk);
    canvas.Text({at.x + kTextGap, at.y - kNameRise}, tree.nodes[i].name,
                {.size = kNameSize, .color = kInk, .bold = true});
    canvas.Text({at.x + kTextGap, at.y + kDetailFall}, tree.nodes[i].detail,
                {.size = kDetailSize, .color = kSoftInk});
  }
}

}  // namespace vitruvia
