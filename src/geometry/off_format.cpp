#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "geometry/mesh_formats.h"
#include "geometry/text_lines.h"

namespace vitruvia {
namespace {

using Words = std::vector<std::string_view>;

// The words of the next line that has any; a comment begins with # and ends with the line.
Words NextLine(TextLines& lines) {
  while (lines.Next()) {
    Words words = SplitAtBlanks(WithoutComment(lines.text()));
    if (!words.empty()) return words;
  }
  return {};
}

double Number(std::string_view word, const TextLines& lines) {
  const auto number = ParseNumber(word);
  if (!number) lines.Fail(fmt::format("expected a number, got '{}'", word));
  return *number;
}

std::int64_t Integer(std::string_view word, std::int64_t least, const TextLines& lines) {
  const auto integer = ParseInteger(word);
  if (!integer || *integer < least || *integer > std::numeric_limits<std::int32_t>::max()) {
    lines.Fail(fmt::format("expected a whole number of at least {}, got '{}'", least, word));
  }
  return *integer;
}

// The numbers of vertices, of faces and, mostly, of edges: in the keyword's line or the next.
Words Counts(TextLines& lines) {
  Words words = NextLine(lines);
  if (words.empty()) lines.Fail("the file is empty, expected OFF");
  constexpr std::string_view kKinds[] = {"OFF",   "COFF",   "NOFF",   "CNOFF",
                                         "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
  if (std::find(std::begin(kKinds), std::end(kKinds), words[0]) == std::end(kKinds)) {
    lines.Fail(fmt::format("expected OFF, COFF, NOFF, STOFF or a mixture, got '{}'", words[0]));
  }
  words.erase(words.begin());
  if (words.empty()) words = NextLine(lines);
  if (words.size() != 2 && words.size() != 3) {
    lines.Fail("expected the numbers of vertices, faces and edges");
  }
  return words;
}

}  // namespace

TriangleMesh ParseOff(std::string_view content, const std::string& file) {
  TriangleMesh mesh;
  TextLines lines(content, file);
  const Words counts = Counts(lines);
  const std::int64_t vertices = Integer(counts[0], 0, lines), faces = Integer(counts[1], 0, lines);
  std::size_t numbers_each = 0;  // normals, colours and texture coordinates follow the place
  for (std::int64_t v = 0; v < vertices; ++v) {
    const Words words = NextLine(lines);
    if (words.size() < 3) {
      lines.Fail(fmt::format("vertex {} of {} has {} numbers, expected at least 3 in its line", v,
                             vertices, words.size()));
    }
    if (v == 0) numbers_each = words.size();
    if (words.size() != numbers_each) {
      lines.Fail(fmt::format("vertex {} has {} numbers, the first one {}: is one doubled or lost?",
                             v, words.size(), numbers_each));
    }
    for (const std::string_view word : words) Number(word, lines);
    mesh.vertices.push_back(
        Vector3d(Number(words[0], lines), Number(words[1], lines), Number(words[2], lines))
            .cast<float>());
  }
  std::size_t colors_of_first = 0;
  for (std::int64_t f = 0; f < faces; ++f) {
    const Words words = NextLine(lines);
    if (words.empty()) lines.Fail(fmt::format("cut short before face {} of {}", f, faces));
    if (const auto corners = Integer(words[0], 0, lines); corners != 3) {
      lines.Fail(
          fmt::format("face {} has {} corners, expected 3 (triangulate the mesh)", f, corners));
    }
    if (words.size() < 4) lines.Fail(fmt::format("cut short within face {} of {}", f, faces));
    const std::size_t colors = words.size() - 4;
    if (f == 0) colors_of_first = colors;
    const bool is_no_color = colors == 2 || colors > 4 || (colors == 1) != (colors_of_first == 1);
    if (is_no_color) {
      lines.Fail(fmt::format(
          "face {} has {} words after its corners, expected those of a colour (0, 1, 3 or 4; the "
          "first face has {}): is a number doubled?",
          f, colors, colors_of_first));
    }
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = static_cast<std::int32_t>(
          Integer(words[k + 1], std::numeric_limits<std::int32_t>::min(), lines));
    }
    mesh.triangles.push_back(triangle);
  }
  if (const Words rest = NextLine(lines); !rest.empty()) {
    lines.Fail(fmt::format("expected the end of the file after {} vertices and {} faces, got '{}'",
                           vertices, faces, rest[0]));
  }
  return mesh;
}

}  // namespace vitruvia
