#include "geometry/mesh_io.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <mutex>
#include <sstream>
#include <string>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace {

using OpenMeshMesh = OpenMesh::PolyMesh_ArrayKernelT<>;

// OpenMesh's readers and writers work on its own half-edge meshes, which leave out faces that are
// not manifold. These adaptors let them fill and read flat arrays instead: every face stays, in
// order, and what is wrong with it can be told.
class Importer : public OpenMesh::IO::ImporterT<OpenMeshMesh> {
 public:
  explicit Importer(OpenMeshMesh& unused) : ImporterT(unused) {}

  OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3f& p) override {
    mesh.vertices.emplace_back(p[0], p[1], p[2]);
    return OpenMesh::VertexHandle(static_cast<int>(mesh.vertices.size()) - 1);
  }
  OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3d& p) override {
    return add_vertex(OpenMesh::Vec3f(p));
  }
  OpenMesh::VertexHandle add_vertex() override { return add_vertex(OpenMesh::Vec3f(0, 0, 0)); }
  void set_point(OpenMesh::VertexHandle v, const OpenMesh::Vec3f& p) override {
    mesh.vertices.at(v.idx()) = {p[0], p[1], p[2]};
  }
  OpenMesh::FaceHandle add_face(const VHandles& corners) override {
    if (corners.size() == 3) {
      mesh.triangles.push_back({corners[0].idx(), corners[1].idx(), corners[2].idx()});
    } else if (problem.empty()) {
      problem = fmt::format("face {} has {} corners, expected 3", face_count, corners.size());
    }
    return OpenMesh::FaceHandle(static_cast<int>(face_count++));
  }
  void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle,
                          const std::vector<OpenMesh::Vec2f>&) override {}
  void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle,
                          const std::vector<OpenMesh::Vec3f>&) override {}
  void reserve(unsigned int vertices, unsigned int, unsigned int faces) override {
    announced_vertices = vertices;
    announced_faces = faces;
  }
  OpenMesh::BaseKernel* kernel() override { return nullptr; }
  std::size_t n_vertices() const override { return mesh.vertices.size(); }
  std::size_t n_faces() const override { return face_count; }
  std::size_t n_edges() const override { return 0; }

  TriangleMesh mesh;
  std::size_t face_count = 0;
  std::size_t announced_vertices = 0, announced_faces = 0;  // by the file's header, if it has one
  std::string problem;
};

class Exporter : public OpenMesh::IO::ExporterT<OpenMeshMesh> {
 public:
  Exporter(const TriangleMesh& mesh, const OpenMeshMesh& unused) : ExporterT(unused), mesh_(mesh) {}

  OpenMesh::Vec3f point(OpenMesh::VertexHandle v) const override {
    const Vector3f& p = mesh_.vertices[v.idx()];
    return {p.x(), p.y(), p.z()};
  }
  OpenMesh::Vec3d pointd(OpenMesh::VertexHandle v) const override {
    return OpenMesh::Vec3d(point(v));
  }
  unsigned int get_vhandles(OpenMesh::FaceHandle f,
                            std::vector<OpenMesh::VertexHandle>& corners) const override {
    corners.clear();
    for (const std::int32_t v : mesh_.triangles[f.idx()]) corners.emplace_back(v);
    return static_cast<unsigned int>(corners.size());
  }
  bool is_triangle_mesh() const override { return true; }
  std::size_t n_vertices() const override { return mesh_.vertices.size(); }
  std::size_t n_faces() const override { return mesh_.triangles.size(); }
  std::size_t n_edges() const override { return 0; }

 private:
  const TriangleMesh& mesh_;
};

// While it lives, OpenMesh's complaints go into `text_` instead of the user's terminal. (Its
// streams have a disconnect() for this, which loses memory.)
class CapturedMessages {
 public:
  CapturedMessages()
      : lock_(Mutex()), errors_(omerr().rdbuf(text_.rdbuf())), log_(omlog().rdbuf(nullptr)) {}
  ~CapturedMessages() {
    omerr().rdbuf(errors_);
    omlog().rdbuf(log_);
  }
  CapturedMessages(const CapturedMessages&) = delete;
  CapturedMessages& operator=(const CapturedMessages&) = delete;

  // The first line, as the rest follows from it.
  std::string FirstLine() const {
    std::string line;
    std::istringstream lines(text_.str());
    std::getline(lines, line);
    return line;
  }

 private:
  static std::mutex& Mutex() {
    static std::mutex mutex;
    return mutex;
  }
  std::lock_guard<std::mutex> lock_;
  std::ostringstream text_;
  std::streambuf *errors_, *log_;
};

enum class MeshFormat { kPly, kObj, kOff };

MeshFormat FormatOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".ply") return MeshFormat::kPly;
  if (extension == ".obj") return MeshFormat::kObj;
  if (extension == ".off") return MeshFormat::kOff;
  throw DataError(fmt::format("{}: unknown kind of mesh file '{}', expected .ply, .obj or .off",
                              file.string(), extension));
}

const char* Extension(MeshFormat format) {
  switch (format) {
    case MeshFormat::kPly:
      return ".ply";
    case MeshFormat::kObj:
      return ".obj";
    case MeshFormat::kOff:
      return ".off";
  }
  return "";
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

// What an OBJ file holds, as its reader says nothing of lines that it does not understand.
void CountObjElements(const std::string& content, Importer& importer) {
  std::istringstream lines(content);
  for (std::string line; std::getline(lines, line);) {
    std::string keyword;
    std::istringstream(line) >> keyword;
    if (keyword == "v") ++importer.announced_vertices;
    if (keyword == "f") ++importer.announced_faces;
  }
}

}  // namespace

TriangleMesh ReadMesh(const std::filesystem::path& file) {
  const MeshFormat format = FormatOf(file);
  const std::string content = ReadWholeFile(file);
  const auto refuse = [&](const std::string& reason) {
    throw DataError(fmt::format("{}: {}", file.string(), reason));
  };
  std::istringstream stream(content);
  // OBJ has neither counts nor an end mark: its reader stops where reading fails. The others must
  // not get that far, and the PLY reader would search a header cut short for ever.
  if (format != MeshFormat::kObj) stream.exceptions(std::ios::failbit | std::ios::badbit);
  OpenMeshMesh unused;
  Importer importer(unused);
  OpenMesh::IO::Options options;
  CapturedMessages messages;
  bool success = false;
  try {
    success = OpenMesh::IO::IOManager().read(stream, Extension(format), importer, options);
  } catch (const std::ios::failure&) {
    refuse("cut short, or has something else where a number should be");
  } catch (const std::exception& error) {
    refuse(fmt::format("damaged: {}", error.what()));
  }
  if (!success) refuse(fmt::format("is no readable mesh file: {}", messages.FirstLine()));
  if (format == MeshFormat::kObj) CountObjElements(content, importer);
  if (importer.mesh.vertices.size() != importer.announced_vertices ||
      importer.face_count != importer.announced_faces) {
    refuse(fmt::format("cut short or damaged: {} vertices and {} faces announced, {} and {} read",
                       importer.announced_vertices, importer.announced_faces,
                       importer.mesh.vertices.size(), importer.face_count));
  }
  if (!importer.problem.empty()) refuse(importer.problem);
  const std::string problem = ContentProblem(importer.mesh);
  if (!problem.empty()) refuse(problem);
  return std::move(importer.mesh);
}

void WriteMesh(const std::filesystem::path& file, const TriangleMesh& mesh) {
  const MeshFormat format = FormatOf(file);
  OpenMesh::IO::Options options;
  if (format == MeshFormat::kPly) {
    options += OpenMesh::IO::Options::Binary;
    options += OpenMesh::IO::Options::LSB;
  }
  std::ostringstream stream;
  const OpenMeshMesh unused;
  Exporter exporter(mesh, unused);
  {
    CapturedMessages messages;
    // So many digits that a float comes back as it was.
    if (!OpenMesh::IO::IOManager().write(stream, Extension(format), exporter, options,
                                         std::numeric_limits<float>::max_digits10)) {
      throw RunError(fmt::format("{}: cannot be written: {}", file.string(), messages.FirstLine()));
    }
  }
  WriteWholeFile(file, stream.view());
}

}  // namespace vitruvia
