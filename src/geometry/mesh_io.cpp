#include "geometry/mesh_io.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <iterator>
#include <string>

#include "core/error.h"
#include "core/files.h"
#include "geometry/mesh_formats.h"

namespace vitruvia {
namespace {

struct MeshFormat {
  std::string_view extension;
  TriangleMesh (*parse)(std::string_view content, const std::string& file);
  std::string (*format)(const TriangleMesh& mesh);
};

// Binary, little-endian.
std::string FormatPly(const TriangleMesh& mesh) {
  static_assert(std::endian::native == std::endian::little, "values are copied as they are");
  std::string content = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float "
      "y\n"
      "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (const Vector3f& v : mesh.vertices) {
    content.append(reinterpret_cast<const char*>(v.data()), sizeof(Vector3f));
  }
  for (const Triangle& t : mesh.triangles) {
    content.push_back(3);
    content.append(reinterpret_cast<const char*>(t.data()), sizeof(Triangle));
  }
  return content;
}

// Text: so many digits that a float comes back as it was.
std::string FormatObj(const TriangleMesh& mesh) {
  std::string content;
  for (const Vector3f& v : mesh.vertices) {
    fmt::format_to(std::back_inserter(content), "v {:.9g} {:.9g} {:.9g}\n", v.x(), v.y(), v.z());
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    fmt::format_to(std::back_inserter(content), "f {} {} {}\n", a + 1, b + 1, c + 1);
  }
  return content;
}

std::string FormatOff(const TriangleMesh& mesh) {
  std::string content = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vector3f& v : mesh.vertices) {
    fmt::format_to(std::back_inserter(content), "{:.9g} {:.9g} {:.9g}\n", v.x(), v.y(), v.z());
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    fmt::format_to(std::back_inserter(content), "3 {} {} {}\n", a, b, c);
  }
  return content;
}

constexpr MeshFormat kFormats[] = {
    {".ply", ParsePly, FormatPly}, {".obj", ParseObj, FormatObj}, {".off", ParseOff, FormatOff}};

std::string LowerExtension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

const MeshFormat& FormatOf(const std::filesystem::path& file) {
  const std::string extension = LowerExtension(file);
  for (const MeshFormat& format : kFormats) {
    if (format.extension == extension) return format;
  }
  throw DataError(fmt::format("{}: unknown kind of mesh file '{}', expected .ply, .obj or .off",
                              file.string(), extension));
}

std::string ContentProblem(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return "has no vertices";
  if (mesh.triangles.empty()) return "has no triangles";
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!mesh.vertices[v].allFinite()) return fmt::format("vertex {} is not finite", v);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::int32_t v : mesh.triangles[t]) {
      if (v < 0 || static_cast<std::size_t>(v) >= mesh.vertices.size()) {
        return fmt::format("triangle {} refers to vertex {}, but there are {} vertices", t, v,
                           mesh.vertices.size());
      }
    }
  }
  return "";
}

}  // namespace

bool IsMeshFile(const std::filesystem::path& file) {
  const std::string extension = LowerExtension(file);
  return std::any_of(std::begin(kFormats), std::end(kFormats),
                     [&](const MeshFormat& format) { return format.extension == extension; });
}

TriangleMesh ReadMesh(const std::filesystem::path& file) {
  const MeshFormat& format = FormatOf(file);
  TriangleMesh mesh = format.parse(ReadWholeFile(file), file.string());
  const std::string problem = ContentProblem(mesh);
  if (!problem.empty()) throw DataError(fmt::format("{}: {}", file.string(), problem));
  return mesh;
}

TriangleMesh ReadMesh(const std::filesystem::path& file, double unit_m) {
  TriangleMesh mesh = ReadMesh(file);
  for (Vector3f& v : mesh.vertices) v *= static_cast<float>(unit_m);
  return mesh;
}

void WriteMesh(const std::filesystem::path& file, const TriangleMesh& mesh) {
  WriteWholeFile(file, FormatOf(file).format(mesh));
}

}  // namespace vitruvia
