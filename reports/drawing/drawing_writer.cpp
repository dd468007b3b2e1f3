#include "reports/drawing/drawing_writer.h"

#include "core/files.h"
#include "reports/drawing/cairo_page.h"
#include "reports/drawing/svg_page.h"

namespace vitruvia {
namespace fs = std::filesystem;

const char* Name(FileFormat format) {
  switch (format) {
    case FileFormat::kSvg:
      return "svg";
    case FileFormat::kPdf:
      return "pdf";
    case FileFormat::kPng:
      break;
  }
  return "png";
}

void DrawingWriter::Write(const fs::path& stem, double width, double height,
                          const std::function<void(Canvas&)>& draw) const {
  Canvas canvas;
  draw(canvas);
  const auto content = [&](FileFormat format) {
    switch (format) {
      case FileFormat::kSvg:
        return ToSvg(canvas.shapes(), width, height, format_.unit_pt);
      case FileFormat::kPdf:
        return ToPdf(canvas.shapes(), width, height, format_.unit_pt);
      case FileFormat::kPng:
        break;
    }
    return ToPng(canvas.shapes(), width, height, format_.png_scale);
  };
  for (const FileFormat format : format_.formats)
    WriteWholeFile(fs::path(stem).concat(".").concat(Name(format)), content(format));
}

}  // namespace vitruvia
