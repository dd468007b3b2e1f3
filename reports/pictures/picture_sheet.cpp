// All strips of a run on one sheet.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include "reports/drawing/color_maps.h"
#include "reports/pictures/pictures.h"

namespace vitruvia {
namespace {

// Lengths in units of the usual style; a style with other text scales them all.
constexpr double kUsualText = 12.0;
constexpr double kCellGap = 6.0, kEdge = 8.0, kTextLine = 18.0;
constexpr double kBarWidth = 250.0, kBarHeight = 12.0, kLegendGap = 36.0, kLegendHeight = 52.0;
constexpr double kWidestLabels = 0.3;  // as a share of a sheet of fixed width
constexpr int kBarSteps = 60;

// A title's two parts: what is shown, and from where.
std::pair<std::string, std::string> TitleParts(const std::string& title) {
  const std::size_t comma = title.find(", ");
  if (comma == std::string::npos) return {title, ""};
  return {title.substr(0, comma), title.substr(comma + 2)};
}

void DrawTextLines(Canvas& canvas, Point at, const std::vector<std::string>& lines,
                   const TextStyle& style, double distance) {
  for (const std::string& line : lines) {
    canvas.Text(at, line, style);
    at.y += distance;
  }
}

struct ColorBar {
  std::string label;
  Color (*color_of)(double);
  std::vector<std::string> ticks;  // evenly spaced
};

// What the colours mean: bars, and plain colours with a line each.
struct LegendBox {
  double width = 0.0, height = 0.0;
  std::vector<ColorBar> bar;  // one or none
  std::vector<ColorKey> keys;
  Point top_left{};
};

class Sheet {
 public:
  Sheet(const RunPictures& run, const SheetStyle& style)
      : run_(run), u_(style.text_size / kUsualText), text_{.size = style.text_size} {
    bold_ = text_;
    bold_.bold = true;
    FindColumns(style.width);
    NameColumns();
    for (const std::string& head : heads_) {
      const auto [what, where] = TitleParts(head);
      const std::size_t lines =
          WrappedText(what, cell_, bold_).size() + WrappedText(where, cell_, text_).size();
      header_ = std::max(header_, (static_cast<double>(lines) * kTextLine + 10.0) * u_);
    }
    key_top_ = header_;
    for (const PictureStrip& strip : run_.strips) {
      row_tops_.push_back(key_top_);
      key_top_ += std::max(cell_, LabelOf(strip).height) + gap();
    }
    legend_top_ = key_top_;
    if (!letter_key_.empty())
      legend_top_ += (static_cast<double>(letter_key_.size()) + 0.5) * kTextLine * u_;
    PlaceLegend();
  }

  double width() const { return std::ceil(width_); }
  double height() const { return std::ceil(height_); }

  void Draw(Canvas& canvas) const {
    for (std::size_t i = 0; i < heads_.size(); ++i) DrawHead(canvas, i);
    DrawTextLines(canvas, {kEdge * u_, key_top_ + kTextLine * u_}, letter_key_, text_,
                  kTextLine * u_);
    for (std::size_t row = 0; row < run_.strips.size(); ++row) DrawRow(canvas, row);
    for (const LegendBox& box : legend_) DrawBox(canvas, box);
  }

 private:
  double gap() const { return kCellGap * u_; }
  double X(std::size_t column) const {
    return margin_ + static_cast<double>(column) * (cell_ + gap());
  }

  void FindColumns(const std::optional<double>& width) {
    double labels = 0.0;
    for (const PictureStrip& strip : run_.strips)
      labels = std::max({labels, TextWidth(strip.label, bold_), TextWidth(strip.sublabel, text_)});
    const double columns = static_cast<double>(run_.titles.size());
    margin_ = labels + 2.0 * kEdge * u_;
    if (width) margin_ = std::min(margin_, kWidestLabels * *width);
    cell_ = width ? (*width - margin_) / columns - gap() : kSheetCell * u_;
    width_ = margin_ + columns * (cell_ + gap());
    // A sheet of one column still has room for its legend.
    if (!width) width_ = std::max(width_, margin_ + WidestBox() + 2.0 * kEdge * u_);
  }

  // Titles stand over their columns where all their words fit; else letters do, and a key below.
  void NameColumns() {
    const bool fit = std::all_of(run_.titles.begin(), run_.titles.end(), [&](const auto& title) {
      std::istringstream words(title);
      return std::all_of(std::istream_iterator<std::string>(words), {},
                         [&](const auto& word) { return TextWidth(word, bold_) <= cell_; });
    });
    if (fit) {
      heads_ = run_.titles;
      return;
    }
    std::string key;
    for (const std::string& title : run_.titles) {
      heads_.emplace_back(1, static_cast<char>('a' + heads_.size()));
      key += fmt::format("{}({}) {}", key.empty() ? "" : "; ", heads_.back(), title);
    }
    letter_key_ = WrappedText(key, width_ - 2.0 * kEdge * u_, text_);
  }

  std::vector<LegendBox> Boxes() const {
    std::vector<LegendBox> boxes;
    const double bar = (kBarWidth + 16.0) * u_;
    if (run_.farthest_m > 0.0) {
      const ColorBar depth{"depth (m)",
                           DepthColor,
                           {fmt::format("{:.1f}", run_.nearest_m),
                            fmt::format("{:.2f}", 0.5 * (run_.nearest_m + run_.farthest_m)),
                            fmt::format("{:.1f}", run_.farthest_m)}};
      boxes.push_back({bar, kLegendHeight * u_, {depth}, {}});
    }
    if (run_.error_scale_m > 0.0) {
      const ColorBar error{"error (mm)",
                           ErrorColor,
                           {"0", fmt::format("{:g}", 500.0 * run_.error_scale_m),
                            fmt::format("≥ {:g}", 1000.0 * run_.error_scale_m)}};
      boxes.push_back({bar, kLegendHeight * u_, {error}, {}});
    }
    if (!run_.keys.empty()) {
      LegendBox keys{
          0.0, static_cast<double>(run_.keys.size()) * kTextLine * u_ + 12.0 * u_, {}, run_.keys};
      for (const ColorKey& key : run_.keys)
        keys.width = std::max(keys.width, TextWidth(key.meaning, text_) + (kBarHeight + 8.0) * u_);
      boxes.push_back(keys);
    }
    return boxes;
  }
  double WidestBox() const {
    double widest = 0.0;
    for (const LegendBox& box : Boxes()) widest = std::max(widest, box.width);
    return widest;
  }

  // From left to right, in as many rows as they need.
  void PlaceLegend() {
    const double left = std::min(margin_ + 10.0 * u_, std::max(width_ - WidestBox(), kEdge * u_));
    double x = left, y = legend_top_ + 10.0 * u_, row_height = 0.0;
    for (LegendBox box : Boxes()) {
      if (x > left && x + box.width > width_) {
        x = left;
        y += row_height;
        row_height = 0.0;
      }
      box.top_left = {x, y};
      x += box.width + kLegendGap * u_;
      row_height = std::max(row_height, box.height);
      legend_.push_back(box);
    }
    height_ = y + row_height + kEdge * u_;
  }

  void DrawHead(Canvas& canvas, std::size_t column) const {
    const auto [what, where] = TitleParts(heads_[column]);
    const auto what_lines = WrappedText(what, cell_, bold_);
    TextStyle bold = bold_, plain = text_;
    bold.anchor = plain.anchor = Anchor::kMiddle;
    const double x = X(column) + 0.5 * cell_, line = kTextLine * u_;
    DrawTextLines(canvas, {x, 0.8 * line}, what_lines, bold, line);
    DrawTextLines(canvas, {x, (0.8 + static_cast<double>(what_lines.size())) * line},
                  WrappedText(where, cell_, text_), plain, line);
  }

  struct RowLabel {
    std::vector<std::string> label, sublabel;  // lines
    double height;
  };
  RowLabel LabelOf(const PictureStrip& strip) const {
    const double room = margin_ - 1.5 * kEdge * u_;
    RowLabel label{WrappedText(strip.label, room, bold_), WrappedText(strip.sublabel, room, text_),
                   0.0};
    label.height = static_cast<double>(label.label.size() + label.sublabel.size()) * kTextLine * u_;
    return label;
  }

  void DrawRow(Canvas& canvas, std::size_t row) const {
    const PictureStrip& strip = run_.strips[row];
    const auto [label, sublabel, height] = LabelOf(strip);
    const double line = kTextLine * u_, room = std::max(cell_, height);
    const double first = row_tops_[row] + 0.5 * (room - height + line);
    DrawTextLines(canvas, {kEdge * u_, first}, label, bold_, line);
    DrawTextLines(canvas, {kEdge * u_, first + static_cast<double>(label.size()) * line}, sublabel,
                  text_, line);
    const double top = row_tops_[row] + 0.5 * (room - cell_);
    for (std::size_t i = 0; i < strip.pictures.size(); ++i)
      canvas.Image({X(i), top}, cell_, cell_, strip.pictures[i]);
  }

  void DrawBox(Canvas& canvas, const LegendBox& box) const {
    for (const ColorBar& bar : box.bar) DrawBar(canvas, box.top_left, bar);
    for (std::size_t i = 0; i < box.keys.size(); ++i) {
      const double y = box.top_left.y + (static_cast<double>(i) * kTextLine + 6.0) * u_;
      const double side = kBarHeight * u_;
      canvas.Rectangle({box.top_left.x, y}, side, side, box.keys[i].color);
      canvas.Text({box.top_left.x + side + 8.0 * u_, y + 0.5 * side}, box.keys[i].meaning, text_);
    }
  }

  void DrawBar(Canvas& canvas, Point top_left, const ColorBar& bar) const {
    TextStyle style = text_;
    style.baseline = Baseline::kTop;
    canvas.Text(top_left, bar.label, style);
    const double top = top_left.y + kTextLine * u_;
    for (int i = 0; i < kBarSteps; ++i) {
      const double width = kBarWidth * u_ / kBarSteps;
      canvas.Rectangle({top_left.x + i * width, top}, width + 0.5 * u_, kBarHeight * u_,
                       bar.color_of((i + 0.5) / kBarSteps));
    }
    for (std::size_t i = 0; i < bar.ticks.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(bar.ticks.size() - 1);
      style.anchor = i == 0                     ? Anchor::kStart
                     : i + 1 < bar.ticks.size() ? Anchor::kMiddle
                                                : Anchor::kEnd;
      canvas.Text({top_left.x + kBarWidth * u_ * share, top + (kBarHeight + 3.0) * u_},
                  bar.ticks[i], style);
    }
  }

  const RunPictures& run_;
  double u_;
  TextStyle text_, bold_;
  double margin_ = 0.0, cell_ = 0.0, width_ = 0.0, height_ = 0.0;
  double header_ = 0.0, key_top_ = 0.0, legend_top_ = 0.0;
  std::vector<std::string> heads_, letter_key_;
  std::vector<double> row_tops_;
  std::vector<LegendBox> legend_;
};

}  // namespace

std::filesystem::path SheetStem(const std::filesystem::path& folder, const std::string& run_id) {
  return folder / ("pictures-" + run_id);
}

void WritePictureSheet(const DrawingWriter& writer, const std::filesystem::path& stem,
                       const RunPictures& run, const SheetStyle& style) {
  const Sheet sheet(run, style);
  writer.Write(stem, sheet.width(), sheet.height(), [&](Canvas& canvas) { sheet.Draw(canvas); });
}

}  // namespace vitruvia
