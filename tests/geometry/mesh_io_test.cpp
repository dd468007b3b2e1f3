#include "geometry/mesh_io.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "core/random.h"
#include "support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const char* const kFormats[] = {"ply", "obj", "off"};

// Vertices of many magnitudes; faces that no half-edge mesh would hold all at once: three at one
// edge, two of them equal, and a vertex without any.
TriangleMesh AwkwardMesh() {
  RandomStream random(1, "awkward");
  TriangleMesh mesh;
  for (int v = 0; v < 50; ++v) {
    const double scale = std::pow(10.0, random.Uniform(-6.0, 3.0));
    mesh.vertices.push_back(
        (scale * Vector3d(random.Normal(), random.Normal(), random.Normal())).cast<float>());
  }
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {4, 0, 1}, {48, 7, 9}, {9, 7, 20}, {3, 2, 1}};
  return mesh;
}

class MeshIo : public testing::Test {
 protected:
  // Reads `content` as a file of that name and expects a DataError that names file and reason.
  void ExpectRefused(const std::string& name, const std::string& content,
                     const std::string& reason) {
    WriteWholeFile(folder_ / name, content);
    EXPECT_THAT([&] { ReadMesh(folder_ / name); },
                ThrowsMessage<DataError>(testing::AllOf(HasSubstr(name), HasSubstr(reason))))
        << content.substr(0, 200);
  }

  TemporaryFolder folder_;
};

TEST_F(MeshIo, GivesBackExactlyWhatWasWritten) {
  for (const TriangleMesh& mesh : {AwkwardMesh(), Triangulated(shapes::Sphere(3))}) {
    for (const std::string format : kFormats) {
      const auto file = folder_ / ("mesh." + format);
      WriteMesh(file, mesh);
      const TriangleMesh read = ReadMesh(file);
      EXPECT_EQ(read.vertices, mesh.vertices) << format;
      EXPECT_EQ(read.triangles, mesh.triangles) << format;
    }
  }
}

TEST_F(MeshIo, WritesLittleEndianBinaryPly) {
  const TriangleMesh mesh = AwkwardMesh();
  WriteMesh(folder_ / "mesh.ply", mesh);
  const std::string content = ReadWholeFile(folder_ / "mesh.ply");
  EXPECT_THAT(content, HasSubstr("format binary_little_endian 1.0"));
  const std::size_t body = content.find("end_header\n") + 11;
  ASSERT_EQ(content.size() - body, 50 * 12 + 7 * 13u);
  Vector3f first;
  std::memcpy(first.data(), content.data() + body, 12);
  EXPECT_EQ(first, mesh.vertices.front());
}

TEST_F(MeshIo, TakesExtensionsInCapitals) {
  WriteMesh(folder_ / "MESH.PLY", AwkwardMesh());
  EXPECT_EQ(ReadMesh(folder_ / "MESH.PLY").triangles, AwkwardMesh().triangles);
}

// A tetrahedron's corner: two triangles that share an edge.
const TriangleMesh kSmall{{{0, 0, 0.25f}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}};

constexpr char kPlyVertices[] =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
constexpr char kPlyFaces[] = "element face 2\nproperty list uchar int vertex_indices\n";
constexpr char kPlyVertexLines[] = "0 0 .25\n1 0 0\n0 1 0\n0 0 1\n";
constexpr char kPlyFaceLines[] = "3 0 1 2\n3 0 2 3\n";

std::string TextPly(const std::string& header, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}

std::string WithLineEnds(const std::string& text, const std::string& line_end) {
  std::string result;
  for (const char c : text) result += c == '\n' ? line_end : std::string(1, c);
  return result;
}

struct NamedText {
  std::string name, content;
};

// Ways in which the formats let `kSmall` be written.
std::vector<NamedText> WaysToWriteIt() {
  const std::string vertices = kPlyVertices, faces = kPlyFaces;
  const std::string vertex_lines = kPlyVertexLines, face_lines = kPlyFaceLines;
  const std::string plain = TextPly(vertices + faces, vertex_lines + face_lines);
  const std::string list = "property list uchar float texcoord\n";
  const std::string obj = "v 0 0 .25\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  return {
      {"plain.ply", plain},
      {"CAPITALS.PLY", plain},
      {"byte_order_mark.ply", "\xEF\xBB\xBF" + plain},
      {"cr_lf.ply", WithLineEnds(plain, "\r\n")},
      {"cr.ply", WithLineEnds(plain, "\r")},
      {"no_last_line_end.ply", plain.substr(0, plain.size() - 1)},
      {"blank_lines.ply",
       TextPly(vertices + "\n" + faces, "\n" + vertex_lines + "\n" + face_lines + "\n")},
      {"comment_before_format.ply", "ply\ncomment hello\n" + plain.substr(4)},
      {"comments.ply", TextPly("comment element face 9\n" + vertices + "obj_info made\n" + faces +
                                   "comment end_header\n",
                               vertex_lines + face_lines)},
      {"format_last.ply",
       "ply\n" + vertices + faces + "format ascii 1.0\nend_header\n" + vertex_lines + face_lines},
      {"list_after.ply",
       TextPly(vertices + faces + list, vertex_lines + "3 0 1 2 6 0 0 1 0 0 1\n3 0 2 3 0\n")},
      {"list_before.ply", TextPly(vertices + "element face 2\nproperty uchar flags\n" + list +
                                      "property list uint8 uint32 vertex_index\n",
                                  vertex_lines + "7 6 0 0 1 0 0 1 3 0 1 2\n7 0 3 0 2 3\n")},
      {"faces_first.ply", TextPly(faces + vertices, face_lines + vertex_lines)},
      {"other_elements.ply",
       TextPly("element camera 1\nproperty float f\nproperty list uchar int ids\n" + vertices +
                   "element edge 2\nproperty int vertex1\nproperty int vertex2\n" + faces,
               "1.5 2 7 8\n" + vertex_lines + "0 1\n1 2\n" + face_lines)},
      {"other_order.ply",
       TextPly("element vertex 4\nproperty uchar red\nproperty double z\nproperty float64 x\n"
               "property float quality\nproperty float32 y\n" +
                   faces,
               "255 0.25 0 .5 0\n0 0 1 .5 0\n0 0 0 .5 1\n0 1 0 .5 0\n" + face_lines)},
      {"plain.obj", obj + "f 1 2 3\nf 1 3 4\n"},
      {"byte_order_mark.obj", "\xEF\xBB\xBF" + obj + "f 1 2 3\nf 1 3 4\n"},
      {"cr_lf.OBJ", WithLineEnds(obj + "f 1 2 3\nf 1 3 4", "\r\n")},
      {"continued.obj",
       "v 0 \\\n0 \\\n .25\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 \\\n 2 3\nf 1 3\\\n 4\n"},
      {"continued_cr_lf.obj", WithLineEnds(obj + "f 1 \\\n 2 3\nf 1 3\\\n 4\n", "\r\n")},
      {"comment_with_backslash.obj",
       "# made in C:\\meshes\\\n" + obj + "f 1 2 3 # first\nf 1 3 4\n"},
      {"relative.obj", obj + "f -4 -3 -2\nf -4 -2 -1\n"},
      {"faces_between.obj", "v 0 0 .25\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 0 0 1\nf -4 -2 -1\n"},
      {"texture_and_normals.obj", "o thing\nmtllib a.mtl\n" + obj +
                                      "vt 0 0\nvt 1 0\nvn 0 0 1\ng part\nusemtl skin\ns off\nf "
                                      "1/1/1 2/2/1 3/1/1\nf 1//1 3// 4/2\n"},
      {"colors.obj",
       "v 0 0 .25 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 0 0 1 1\nf 1 2 3\nf 1 3 4\n"},
      {"plain.off", "OFF\n4 2 0\n" + vertex_lines + face_lines},
      {"byte_order_mark.off", "\xEF\xBB\xBFOFF 4 2\n" + vertex_lines + face_lines},
      {"comments.off",
       "# a mesh\nOFF # its kind\n\n4 2 5\n" + vertex_lines + "#faces\n" + face_lines},
      {"colors.OFF",
       "COFF\n4 2 0\n0 0 .25 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n0 0 1 1 0 0 1\n"
       "3 0 1 2 0.5 0.5 0.5\n3 0 2 3\n"},
  };
}

TEST_F(MeshIo, ReadsWhateverTheFormatsAllow) {
  for (const NamedText& way : WaysToWriteIt()) {
    WriteWholeFile(folder_ / way.name, way.content);
    try {
      const TriangleMesh mesh = ReadMesh(folder_ / way.name);
      EXPECT_EQ(mesh.vertices, kSmall.vertices) << way.name;
      EXPECT_EQ(mesh.triangles, kSmall.triangles) << way.name;
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

// `kSmall` as binary PLY with doubles, 16-bit indices and a second list.
std::string BinaryPly(bool big_endian) {
  std::string content = fmt::format(
      "ply\nformat binary_{}_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property uchar red\nproperty double z\nelement face 2\n"
      "property list ushort float texcoord\nproperty list uchar short vertex_indices\nend_header\n",
      big_endian ? "big" : "little");
  const auto put = [&](const auto value) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof(value));
    if (big_endian) std::reverse(bytes.begin(), bytes.end());
    content += bytes;
  };
  for (const Vector3f& v : kSmall.vertices) {
    put(static_cast<double>(v.x()));
    put(static_cast<double>(v.y()));
    put(std::uint8_t{200});
    put(static_cast<double>(v.z()));
  }
  for (const Triangle& t : kSmall.triangles) {
    put(std::uint16_t{2});
    put(0.5f);
    put(0.25f);
    put(std::uint8_t{3});
    for (const std::int32_t v : t) put(static_cast<std::int16_t>(v));
  }
  return content;
}

TEST_F(MeshIo, ReadsBinaryPlyOfEitherByteOrderAndRefusesItCutAnywhere) {
  for (const bool big_endian : {false, true}) {
    const std::string whole = BinaryPly(big_endian);
    WriteWholeFile(folder_ / "a.ply", whole);
    const TriangleMesh mesh = ReadMesh(folder_ / "a.ply");
    EXPECT_EQ(mesh.vertices, kSmall.vertices);
    EXPECT_EQ(mesh.triangles, kSmall.triangles);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      ExpectRefused("cut.ply", whole.substr(0, size), size == 0 ? "is no PLY file" : "");
    }
    ExpectRefused("long.ply", whole + "\n", "1 bytes follow the last element");
  }
}

TEST_F(MeshIo, SaysWhereAFileIsDamaged) {
  const std::string header = std::string(kPlyVertices) + kPlyFaces;
  const std::string faces = kPlyFaceLines;
  ExpectRefused("a.ply", TextPly(header, "0 0 .25\n1 zero 0\n0 1 0\n0 0 1\n" + faces),
                "a.ply:11: expected a number, got 'zero'");
  ExpectRefused("a.ply", TextPly(header, "0 0 .25\n1 0\n0 1 0\n0 0 1\n" + faces),
                "a.ply:11: a line of 2 values, expected more");
  ExpectRefused("a.ply", TextPly(header, "0 0 .25\n1 0 0 5\n0 1 0\n0 0 1\n" + faces),
                "a.ply:11: a line of 4 values, expected 3");
  ExpectRefused("a.ply", TextPly(header, kPlyVertexLines + faces + "3 0 1 3\n"),
                "a.ply:16: expected the end of the file");
  ExpectRefused("a.ply", TextPly(header, kPlyVertexLines + std::string("3 0 1 2\n3 0 2 .5\n")),
                "a.ply:15: expected a vertex of a face, got 0.5");
  ExpectRefused("a.ply", TextPly(header, kPlyVertexLines + std::string("3 0 1 2\n-3 0 2 3\n")),
                "a.ply:15: a list 'vertex_indices' of -3 items");
  ExpectRefused("a.ply", TextPly(header, kPlyVertexLines + std::string("3 0 1 2\n")),
                "a.ply:14: cut short");
  ExpectRefused("a.ply", "ply\nformat nonsense 1.0\n", "a.ply:2: expected 'format ascii 1.0'");
  ExpectRefused("a.ply", "ply\nformat ascii 1.0\nelement vertex four\n", "a.ply:3: expected 'elem");
  ExpectRefused("a.ply", TextPly("element vertex 1\nproperty real x\n", ""),
                "a.ply:4: unknown type 'real'");
  ExpectRefused("a.ply", TextPly("element vertex 1\nproperty float x\nproperty float x\n", ""),
                "a.ply:5: property 'x' appears twice");
  ExpectRefused(
      "a.ply",
      TextPly("element vertex 1\nproperty float x\nproperty float y\n" + std::string(kPlyFaces),
              "0 0\n" + faces),
      "the vertices have no number 'z'");
  ExpectRefused("a.ply", TextPly(kPlyVertices, kPlyVertexLines), "0 elements 'face', expected one");
  ExpectRefused("a.ply",
                "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
                "property float x\nproperty float y\nproperty float z\n" +
                    std::string(kPlyFaces) + "end_header\nabc",
                "cut short");
  ExpectRefused("a.obj", "v 0 0 0\nv 0 x 1\n", "a.obj:2: expected a number, got 'x'");
  ExpectRefused("a.obj", "v 0 0 0\nw 0 0 1\n", "a.obj:2: unknown statement 'w'");
  ExpectRefused("a.obj", "v 0 0 0\nf 1 1 1/a\n", "a.obj:2: expected a corner such as");
  ExpectRefused("a.obj", "v 0 0 0\nf 1 1 -2\n", "a.obj:2: vertex -2 of a face, but there are 1");
  ExpectRefused("a.obj", "\xFF\xFEv", "is UTF-16 text");
  ExpectRefused("a.off", "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n",
                "a.off:4: vertex 1 of 3 has 2");
  ExpectRefused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0 0\n0 1 0\n3 0 1 2\n",
                "a.off:4: vertex 1 has 4 numbers, the first one 3");
  ExpectRefused("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 2 1\n",
                "a.off:7: face 1 has 1 words after its corners");
  ExpectRefused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2#2\n",
                "a.off:6: expected a whole number");
  ExpectRefused("a.obj", "v 0 0 0\nf 1 1 1#1\n", "a.obj:2: expected a corner such as");
  ExpectRefused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n",
                "a.off:7: expected the end of the file");
}

TEST_F(MeshIo, RefusesFilesCutShortAnywhere) {
  for (const std::string format : {"ply", "off"}) {
    WriteMesh(folder_ / ("whole." + format), AwkwardMesh());
    std::string whole = ReadWholeFile(folder_ / ("whole." + format));
    // A text file may end without a line break, or lose the last digits of its last number.
    if (format == "off") whole = whole.substr(0, whole.find_last_of(' ') + 1);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      ExpectRefused("cut." + format, whole.substr(0, size), "");
    }
  }
}

// OBJ has no counts: a file cut between two lines of faces cannot be told from a whole one.
TEST_F(MeshIo, RefusesObjLinesCutShort) {
  ExpectRefused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1\n", "a.obj:3: a vertex of 2 numbers");
  ExpectRefused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3\n",
                "a.obj:5: face 1 has 2 corners");
  ExpectRefused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 \\", "cut short");
  ExpectRefused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "has no triangles");
}

TEST_F(MeshIo, RefusesVerticesThatAreNotFinite) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    TriangleMesh mesh = AwkwardMesh();
    mesh.vertices[17].z() = bad;
    WriteMesh(folder_ / "bad.ply", mesh);
    ExpectRefused("bad.ply", ReadWholeFile(folder_ / "bad.ply"), "vertex 17 is not finite");
  }
  ExpectRefused("nan.off", "OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n",
                "vertex 1 is not finite");
}

TEST_F(MeshIo, RefusesIndicesOutOfRange) {
  for (const std::int32_t bad : {50, -1, 1000000}) {
    TriangleMesh mesh = AwkwardMesh();
    mesh.triangles[5][1] = bad;
    WriteMesh(folder_ / "bad.ply", mesh);
    ExpectRefused("bad.ply", ReadWholeFile(folder_ / "bad.ply"),
                  fmt::format("triangle 5 refers to vertex {}, but there are 50 vertices", bad));
  }
  ExpectRefused("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
                "triangle 0 refers to vertex 3");
  ExpectRefused("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "");
  ExpectRefused("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "");
}

TEST_F(MeshIo, RefusesFacesThatAreNoTriangles) {
  ExpectRefused("quad.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n",
                "face 0 has 4 corners, expected 3");
  ExpectRefused("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 2 3 4\n",
                "face 1 has 4 corners, expected 3");
}

TEST_F(MeshIo, RefusesMissingFilesAndOtherKinds) {
  EXPECT_THAT([&] { ReadMesh(folder_ / "none.ply"); },
              ThrowsMessage<DataError>(HasSubstr("none.ply: cannot be opened")));
  EXPECT_THAT([&] { ReadMesh(folder_ / "mesh.stl"); },
              ThrowsMessage<DataError>(HasSubstr("expected .ply, .obj or .off")));
  ExpectRefused("text.ply", "no mesh at all\n", "");
  ExpectRefused("empty.ply", "", "");
  ExpectRefused("empty.obj", "", "has no vertices");
  ExpectRefused("empty.off", "OFF\n0 0 0\n", "has no vertices");
}

TEST_F(MeshIo, LeavesNothingBehindWhereItCannotWrite) {
  EXPECT_THAT([&] { WriteMesh(folder_ / "missing" / "a.ply", AwkwardMesh()); },
              ThrowsMessage<RunError>(HasSubstr("a.ply")));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

}  // namespace
}  // namespace vitruvia
