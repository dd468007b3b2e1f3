#include "reports/drawing/cairo_page.h"

#include <cairo-pdf.h>
#include <cairo.h>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include "core/error.h"

namespace vitruvia {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

Surface Owned(cairo_surface_t* surface) { return {surface, cairo_surface_destroy}; }
Context DrawingOn(const Surface& surface) { return {cairo_create(surface.get()), cairo_destroy}; }

void Check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw RunError(fmt::format("Cairo cannot draw: {}", cairo_status_to_string(status)));
}

cairo_status_t Append(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void SetColor(cairo_t* cairo, const Color& color, double opacity = 1.0) {
  cairo_set_source_rgba(cairo, color[0] / 255.0, color[1] / 255.0, color[2] / 255.0, opacity);
}

void SetFont(cairo_t* cairo, const TextStyle& style) {
  cairo_select_font_face(cairo, kFontFamily, CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, style.size);
  // Widths proportional to the size, so that lines break at the same places at each scale.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(cairo, options);
  cairo_font_options_destroy(options);
}

double Width(cairo_t* cairo, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text.c_str(), &extents);
  return extents.x_advance;
}

void AddPath(cairo_t* cairo, const std::vector<Point>& points) {
  for (const Point& point : points) cairo_line_to(cairo, point.x, point.y);
}

void Draw(cairo_t* cairo, const PolylineShape& line) {
  SetColor(cairo, line.stroke.color);
  cairo_set_line_width(cairo, line.stroke.width);
  const double dash = line.stroke.dash;
  cairo_set_dash(cairo, &dash, dash > 0.0 ? 1 : 0, 0.0);
  AddPath(cairo, line.points);
  cairo_stroke(cairo);
}

void Draw(cairo_t* cairo, const PolygonShape& polygon) {
  SetColor(cairo, polygon.fill, polygon.opacity);
  AddPath(cairo, polygon.points);
  cairo_close_path(cairo);
  cairo_fill(cairo);
}

void Draw(cairo_t* cairo, const DiscShape& disc) {
  SetColor(cairo, disc.fill);
  cairo_new_path(cairo);
  cairo_arc(cairo, disc.center.x, disc.center.y, disc.radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(cairo);
}

void Draw(cairo_t* cairo, const TextShape& text) {
  SetColor(cairo, text.style.color);
  SetFont(cairo, text.style);
  const double width = Width(cairo, text.text);
  const double start = text.style.anchor == Anchor::kStart    ? 0.0
                       : text.style.anchor == Anchor::kMiddle ? -0.5 * width
                                                              : -width;
  cairo_save(cairo);
  cairo_translate(cairo, text.at.x, text.at.y);
  if (text.style.direction == Direction::kUpwards) cairo_rotate(cairo, -0.5 * std::numbers::pi);
  cairo_move_to(cairo, start, BaselineShift(text.style));
  cairo_show_text(cairo, text.text.c_str());
  cairo_restore(cairo);
  cairo_new_path(cairo);
}

// Cairo's pixels: native-endian words of opacity and colours multiplied by it.
Surface ToSurface(const ColorImage& picture) {
  Surface surface =
      Owned(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, picture.width(), picture.height()));
  Check(cairo_surface_status(surface.get()));
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int v = 0; v < picture.height(); ++v) {
    for (int u = 0; u < picture.width(); ++u) {
      const ColorPixel& p = picture(u, v);
      const auto times_opacity = [&](int c) {
        return static_cast<std::uint32_t>(p[c] * p[3] / 255);
      };
      const std::uint32_t word = static_cast<std::uint32_t>(p[3]) << 24 | times_opacity(0) << 16 |
                                 times_opacity(1) << 8 | times_opacity(2);
      std::memcpy(data + static_cast<std::ptrdiff_t>(v) * stride + 4 * u, &word, sizeof word);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

// Of an opaque surface.
ColorImage FromSurface(const Surface& surface) {
  cairo_surface_flush(surface.get());
  const unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  ColorImage image(cairo_image_surface_get_width(surface.get()),
                   cairo_image_surface_get_height(surface.get()));
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      std::uint32_t word = 0;
      std::memcpy(&word, data + static_cast<std::ptrdiff_t>(v) * stride + 4 * u, sizeof word);
      const auto byte = [word](int shift) {
        return static_cast<std::uint8_t>(word >> shift & 0xff);
      };
      image(u, v) = {byte(16), byte(8), byte(0), 255};
    }
  }
  return image;
}

void Draw(cairo_t* cairo, const PictureShape& shape) {
  const Surface picture = ToSurface(shape.picture->image);
  cairo_save(cairo);
  cairo_translate(cairo, shape.top_left.x, shape.top_left.y);
  const ColorImage& image = shape.picture->image;
  cairo_scale(cairo, shape.width / image.width(), shape.height / image.height());
  cairo_set_source_surface(cairo, picture.get(), 0.0, 0.0);
  cairo_paint(cairo);
  cairo_restore(cairo);
}

void Draw(cairo_t* /*cairo*/, const HintShape& /*hint*/) {}

void DrawAll(const Surface& surface, const std::vector<PageShape>& shapes, double scale) {
  const Context context = DrawingOn(surface);
  cairo_scale(context.get(), scale, scale);
  for (const PageShape& shape : shapes) {
    std::visit([&](const auto& s) { Draw(context.get(), s); }, shape);
  }
  Check(cairo_status(context.get()));
}

}  // namespace

std::string ToPdf(const std::vector<PageShape>& shapes, double width, double height,
                  double unit_pt) {
  std::string file;
  const Surface surface =
      Owned(cairo_pdf_surface_create_for_stream(Append, &file, width * unit_pt, height * unit_pt));
  // A fixed date, so that the same drawing gives the same file.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  DrawAll(surface, shapes, unit_pt);
  cairo_surface_finish(surface.get());
  Check(cairo_surface_status(surface.get()));
  return file;
}

std::string ToPng(const std::vector<PageShape>& shapes, double width, double height, double scale) {
  const Surface surface = Owned(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(width * scale)),
                                 static_cast<int>(std::ceil(height * scale))));
  {
    const Context context = DrawingOn(surface);
    SetColor(context.get(), {255, 255, 255});
    cairo_paint(context.get());
  }
  DrawAll(surface, shapes, scale);
  return EncodePng(FromSurface(surface));
}

double MeasuredWidth(const std::string& text, const TextStyle& style) {
  const Surface surface = Owned(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const Context context = DrawingOn(surface);
  SetFont(context.get(), style);
  return Width(context.get(), text);
}

}  // namespace vitruvia
