#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "geometry/mesh_formats.h"
#include "geometry/text_lines.h"

namespace vitruvia {
namespace {

// Statements that change neither vertices nor faces.
constexpr std::array<std::string_view, 18> kSkipped = {
    "vt",     "vn",     "vp", "g", "s",     "mg",       "o",        "usemtl", "mtllib",
    "usemap", "maplib", "l",  "p", "bevel", "c_interp", "d_interp", "lod",    "shadow_obj"};

// The statement that begins in the current line: without its comment, joined with the lines after
// it while they end with a backslash.
std::string Statement(TextLines& lines) {
  std::string statement;
  while (true) {
    const std::string_view text = WithoutComment(lines.text());
    statement += text;
    if (!text.ends_with('\\')) return statement;
    statement.back() = ' ';
    if (!lines.Next()) lines.Fail("cut short: the last line ends with a backslash");
  }
}

Vector3f Position(const std::vector<std::string_view>& words, const TextLines& lines) {
  // After x, y and z: a weight or a colour or both.
  const std::size_t count = words.size() - 1;
  if (count != 3 && count != 4 && count != 6 && count != 7) {
    lines.Fail(fmt::format("a vertex of {} numbers, expected 3, 4, 6 or 7", count));
  }
  Vector3f position;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto number = ParseNumber(words[i]);
    if (!number) lines.Fail(fmt::format("expected a number, got '{}'", words[i]));
    if (i == 4 && count != 6 && *number != 1.0)
      lines.Fail(fmt::format("a vertex of weight {}, expected 1 (rational surfaces are not read)",
                             words[i]));
    if (i <= 3) position[static_cast<Eigen::Index>(i - 1)] = static_cast<float>(*number);
  }
  return position;
}

// Of a corner "v", "v/vt", "v//vn" or "v/vt/vn" the vertex, counted from 0. Some programs leave the
// other two empty ("v//").
std::int32_t Corner(std::string_view corner, std::size_t vertices, const TextLines& lines) {
  const auto refuse = [&] {
    lines.Fail(fmt::format("expected a corner such as 7, 7/1, 7//1 or 7/1/1, got '{}'", corner));
  };
  std::string_view rest = corner;
  std::int64_t vertex = 0;
  for (int part = 0;; ++part) {
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const auto index = ParseInteger(rest.substr(0, slash));
    const bool may_be_empty = part > 0 && slash == 0;
    if (part > 2 || (!may_be_empty && index.value_or(0) == 0)) refuse();
    if (part == 0) vertex = *index;
    if (slash == rest.size()) break;
    rest.remove_prefix(slash + 1);
  }
  const std::int64_t from_zero =
      vertex > 0 ? vertex - 1 : static_cast<std::int64_t>(vertices) + vertex;
  if (from_zero < 0 || from_zero > std::numeric_limits<std::int32_t>::max()) {
    lines.Fail(
        fmt::format("vertex {} of a face, but there are {} vertices so far", vertex, vertices));
  }
  return static_cast<std::int32_t>(from_zero);
}

}  // namespace

TriangleMesh ParseObj(std::string_view content, const std::string& file) {
  TriangleMesh mesh;
  TextLines lines(content, file);
  while (lines.Next()) {
    const std::string statement = Statement(lines);
    const std::vector<std::string_view> words = SplitAtBlanks(statement);
    if (words.empty()) continue;
    if (words[0] == "v") {
      mesh.vertices.push_back(Position(words, lines));
    } else if (words[0] == "f") {
      if (words.size() != 4) {
        lines.Fail(fmt::format("face {} has {} corners, expected 3 (triangulate the mesh)",
                               mesh.triangles.size(), words.size() - 1));
      }
      const std::size_t count = mesh.vertices.size();
      mesh.triangles.push_back({Corner(words[1], count, lines), Corner(words[2], count, lines),
                                Corner(words[3], count, lines)});
    } else if (std::find(kSkipped.begin(), kSkipped.end(), words[0]) == kSkipped.end()) {
      lines.Fail(fmt::format("unknown statement '{}', expected v, f or another of polygonal OBJ",
                             words[0]));
    }
  }
  return mesh;
}

}  // namespace vitruvia
