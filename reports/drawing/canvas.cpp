#include "reports/drawing/canvas.h"

#include <cmath>

#include <fmt/format.h>
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkRect.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSVGExporter.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

#include "core/error.h"
#include "core/files.h"
#include "core/write_failure.h"
#include "reports/drawing/html_text.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr double kPngScale = 2.0;  // PNG pixels per page unit
constexpr Color kPaper{255, 255, 255};

// Hands VTK's painting over to a function.
class Drawing : public vtkContextItem {
 public:
  static Drawing* New();
  vtkTypeMacro(Drawing, vtkContextItem)

      bool Paint(vtkContext2D* painter) override {
    additions = {};
    Canvas canvas(*painter, page_height, scale, for_svg ? &additions : nullptr);
    canvas.Rectangle({0.0, 0.0}, page_width, page_height, kPaper);
    (*draw)(canvas);
    return true;
  }

  const std::function<void(Canvas&)>* draw = nullptr;
  double page_width = 0.0, page_height = 0.0, scale = 1.0;
  bool for_svg = false;
  SvgAdditions additions;  // of the last painting
};
vtkStandardNewMacro(Drawing)

    vtkNew<vtkImageData> ToVtk(const ColorImage& picture) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(picture.width(), picture.height(), 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (int v = 0; v < picture.height(); ++v) {
    auto* row = static_cast<std::uint8_t*>(data->GetScalarPointer(0, picture.height() - 1 - v, 0));
    for (int u = 0; u < picture.width(); ++u) {
      for (int c = 0; c < 4; ++c) *row++ = picture(u, v)[c];
    }
  }
  return data;
}

std::string SvgElement(const PlacedPicture& p) {
  return fmt::format(
      "<image x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" xlink:href=\"{}\"/>\n",
      p.top_left.x, p.top_left.y, p.width, p.height, DataUri(EncodePng(*p.picture)));
}

std::string SvgElement(const PlacedText& t) {
  // Renderers disagree on dominant-baseline, so the shift is made here, in shares of the size.
  constexpr double kBelowTop = 0.76, kBelowMiddle = 0.36, kBelowBottom = -0.22;
  const double shift = t.style.size * (t.style.baseline == Baseline::kTop      ? kBelowTop
                                       : t.style.baseline == Baseline::kMiddle ? kBelowMiddle
                                                                               : kBelowBottom);
  const char* anchor = t.style.anchor == Anchor::kStart    ? "start"
                       : t.style.anchor == Anchor::kMiddle ? "middle"
                                                           : "end";
  return fmt::format(
      "<text transform=\"translate({:g} {:g}) rotate({})\" y=\"{:.2f}\" font-size=\"{:g}\" "
      "font-weight=\"{}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n",
      t.at.x, t.at.y, t.style.direction == Direction::kUpwards ? -90 : 0, shift, t.style.size,
      t.style.bold ? 600 : 400, anchor, CssColor(t.style.color), Escaped(t.text));
}

// VTK's SVG with what it lacks: a view box, without which it does not scale, pictures and text.
std::string Completed(std::string svg, int width, int height, const SvgAdditions& additions) {
  const std::size_t start = svg.find("<svg "), end = svg.rfind("</svg>");
  if (start == std::string::npos || end == std::string::npos) {
    throw RunError("VTK's SVG exporter wrote no whole drawing");
  }
  std::string elements =
      "<g font-family=\"system-ui, 'Segoe UI', Roboto, 'Noto Sans', 'DejaVu Sans', sans-serif\">\n";
  for (const PlacedPicture& picture : additions.pictures) elements += SvgElement(picture);
  for (const PlacedText& text : additions.texts) elements += SvgElement(text);
  svg.insert(end, elements + "</g>\n");
  svg.insert(start + 5, fmt::format("viewBox=\"0 0 {} {}\" ", width, height));
  return svg;
}

}  // namespace

Canvas::Canvas(vtkContext2D& context, double page_height, double scale, SvgAdditions* additions)
    : context_(&context), page_height_(page_height), scale_(scale), additions_(additions) {}

void Canvas::SetPen(const Stroke& stroke) {
  vtkPen* pen = context_->GetPen();
  pen->SetLineType(vtkPen::SOLID_LINE);
  pen->SetColor(stroke.color[0], stroke.color[1], stroke.color[2], 255);
  pen->SetWidth(static_cast<float>(stroke.width * scale_));
}

void Canvas::Line(Point a, Point b, const Stroke& stroke) { Polyline({a, b}, stroke); }

void Canvas::Polyline(const std::vector<Point>& points, const Stroke& stroke) {
  SetPen(stroke);
  std::vector<float> piece;
  const auto flush = [&] {
    if (piece.size() >= 4) context_->DrawPoly(piece.data(), static_cast<int>(piece.size() / 2));
    piece.clear();
  };
  const auto add = [&](Point p) { piece.insert(piece.end(), {X(p.x), Y(p.y)}); };
  if (stroke.dash <= 0.0) {
    for (const Point& p : points) add(p);
    flush();
    return;
  }
  // Dashes are cut here, since VTK's two devices cut them differently.
  double left = stroke.dash;
  bool drawing = true;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point a = points[i], b = points[i + 1];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const auto along = [&](double s) {
      return Point{a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length};
    };
    if (drawing && piece.empty()) add(a);
    double done = 0.0;
    while (length - done > left) {
      done += left;
      left = stroke.dash;
      add(along(done));
      if (drawing) flush();
      drawing = !drawing;
      if (!drawing) piece.clear();
    }
    left -= length - done;
    if (drawing && length > 0.0) add(b);
  }
  flush();
}

void Canvas::Rectangle(Point top_left, double width, double height, Color fill, double opacity) {
  context_->GetPen()->SetLineType(vtkPen::NO_PEN);
  context_->GetBrush()->SetColor(fill[0], fill[1], fill[2],
                                 static_cast<unsigned char>(std::lround(255 * opacity)));
  context_->DrawRect(X(top_left.x), Y(top_left.y + height), static_cast<float>(width * scale_),
                     static_cast<float>(height * scale_));
}

void Canvas::Disc(Point center, double radius, Color fill) {
  context_->GetPen()->SetLineType(vtkPen::NO_PEN);
  context_->GetBrush()->SetColor(fill[0], fill[1], fill[2], 255);
  const auto r = static_cast<float>(radius * scale_);
  context_->DrawEllipse(X(center.x), Y(center.y), r, r);
}

void Canvas::Cross(Point center, double radius, const Stroke& stroke) {
  const double r = radius;
  Line({center.x - r, center.y - r}, {center.x + r, center.y + r}, stroke);
  Line({center.x - r, center.y + r}, {center.x + r, center.y - r}, stroke);
}

void Canvas::SetFont(const TextStyle& style) {
  vtkTextProperty* font = context_->GetTextProp();
  font->SetFontFamilyToArial();
  font->SetFontSize(static_cast<int>(std::lround(style.size * scale_)));
  font->SetBold(style.bold);
  font->SetColor(style.color[0] / 255.0, style.color[1] / 255.0, style.color[2] / 255.0);
  font->SetOrientation(style.direction == Direction::kUpwards ? 90.0 : 0.0);
  switch (style.anchor) {
    case Anchor::kStart:
      font->SetJustificationToLeft();
      break;
    case Anchor::kMiddle:
      font->SetJustificationToCentered();
      break;
    case Anchor::kEnd:
      font->SetJustificationToRight();
      break;
  }
  switch (style.baseline) {
    case Baseline::kTop:
      font->SetVerticalJustificationToTop();
      break;
    case Baseline::kMiddle:
      font->SetVerticalJustificationToCentered();
      break;
    case Baseline::kBottom:
      font->SetVerticalJustificationToBottom();
      break;
  }
}

void Canvas::Text(Point at, const std::string& text, const TextStyle& style) {
  if (text.empty()) return;
  if (additions_ != nullptr) {
    additions_->texts.push_back({at, text, style});
    return;
  }
  SetFont(style);
  context_->DrawString(X(at.x), Y(at.y), text);
}

void Canvas::Picture(Point top_left, double width, double height, const ColorImage& picture) {
  if (additions_ != nullptr) {
    additions_->pictures.push_back({top_left, width, height, &picture});
    return;
  }
  const vtkNew<vtkImageData> data = ToVtk(picture);
  context_->DrawImage(
      vtkRectf(X(top_left.x), Y(top_left.y + height), static_cast<float>(width * scale_),
               static_cast<float>(height * scale_)),
      data);
}

struct DrawingWriter::Window {
  Window() {
    renderer->AddActor(actor);
    actor->GetScene()->SetRenderer(renderer);
    actor->GetScene()->AddItem(drawing);
    offscreen.vtk().AddRenderer(renderer);
  }
  void Show(int width, int height, double scale) {
    drawing->page_width = width;
    drawing->page_height = height;
    drawing->scale = scale;
    drawing->for_svg = false;
    offscreen.Resize(static_cast<int>(width * scale), static_cast<int>(height * scale));
  }
  void ExportSvg(const fs::path& file) {
    drawing->for_svg = true;
    vtkNew<vtkSVGExporter> exporter;
    exporter->SetRenderWindow(&offscreen.vtk());
    exporter->SetFileName(file.c_str());
    exporter->SetTitle("");
    exporter->SetDescription("");
    exporter->Write();
  }

  vtkNew<Drawing> drawing;
  vtkNew<vtkContextActor> actor;
  vtkNew<vtkRenderer> renderer;
  OffscreenWindow offscreen{1, 1};  // goes first: it frees what the others hold in its context
};

DrawingWriter::DrawingWriter() : window_(std::make_unique<Window>()) {}
DrawingWriter::~DrawingWriter() = default;

void DrawingWriter::Write(const fs::path& stem, int width, int height,
                          const std::function<void(Canvas&)>& draw) {
  window_->drawing->draw = &draw;
  window_->Show(width, height, kPngScale);
  WriteWholeFile(fs::path(stem).concat(".png"), EncodePng(window_->offscreen.DrawAndRead()));
  const fs::path svg = fs::path(stem).concat(".svg");
  window_->Show(width, height, 1.0);
  window_->ExportSvg(svg);
  const std::string exported = fs::exists(svg) ? ReadWholeFile(svg) : "";
  if (exported.find("</svg>") == std::string::npos) FailToWrite(svg, 0);  // or cut short
  WriteWholeFile(svg, Completed(exported, width, height, window_->drawing->additions));
}

}  // namespace vitruvia
