// Drawings as files: SVG, PDF and PNG of the same shapes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "reports/drawing/canvas.h"

namespace vitruvia {

enum class FileFormat { kSvg, kPdf, kPng };
const char* Name(FileFormat format);  // its file name's ending, without dot

// How long a page unit is, and in which formats pages are written.
struct PageFormat {
  double unit_pt = 0.75;   // points (1/72 inch); 0.75: a CSS pixel
  double png_scale = 2.0;  // pixels of a PNG per unit
  std::vector<FileFormat> formats{FileFormat::kSvg, FileFormat::kPng};
};

class DrawingWriter {
 public:
  explicit DrawingWriter(PageFormat format = {}) : format_(std::move(format)) {}

  // A drawing of width × height page units, to `stem`.svg and so on. RunError if one cannot be
  // written.
  void Write(const std::filesystem::path& stem, double width, double height,
             const std::function<void(Canvas&)>& draw) const;

 private:
  PageFormat format_;
};

}  // namespace vitruvia
