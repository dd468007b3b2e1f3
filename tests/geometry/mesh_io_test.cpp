#include "geometry/mesh_io.h"

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
  EXPECT_EQ(std::memcmp(content.data() + body, mesh.vertices.front().data(), 12), 0);
}

TEST_F(MeshIo, TakesExtensionsInCapitals) {
  WriteMesh(folder_ / "MESH.PLY", AwkwardMesh());
  EXPECT_EQ(ReadMesh(folder_ / "MESH.PLY").triangles, AwkwardMesh().triangles);
}

TEST_F(MeshIo, ReadsTextPlyWithMoreThanPositions) {
  WriteWholeFile(folder_ / "a.ply",
                 "ply\nformat ascii 1.0\ncomment scanned\nelement vertex 4\nproperty double x\n"
                 "property double y\nproperty double z\nproperty float nx\nproperty float ny\n"
                 "property float nz\nproperty uchar red\nproperty uchar green\n"
                 "property uchar blue\nproperty float quality\nelement face 2\n"
                 "property list uchar int vertex_indices\nend_header\n"
                 "0 0 0.25 0 0 1 255 0 0 0.5\n1 0 0 0 0 1 255 0 0 0.5\n0 1 0 0 0 1 255 0 0 0.5\n"
                 "0 0 1 0 0 1 255 0 0 0.5\n3 0 1 2\n3 0 2 3\n");
  const TriangleMesh mesh = ReadMesh(folder_ / "a.ply");
  EXPECT_EQ(mesh.vertices, (std::vector<Vector3f>{{0, 0, 0.25f}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST_F(MeshIo, ReadsObjWithTextureCoordinatesAndNormals) {
  WriteWholeFile(folder_ / "a.obj",
                 "# a comment\no thing\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\n"
                 "vn 0 0 1\ng part\nf 1/1/1 2/2/1 3/1/1\nf 1//1 3//1 4//1\nf -4 -3 -1\n");
  const TriangleMesh mesh = ReadMesh(folder_ / "a.obj");
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}}));
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
  ExpectRefused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1\n", "3 vertices and 0 faces announced");
  ExpectRefused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3\n",
                "3 vertices and 2 faces announced, 3 and 1 read");
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
  ExpectRefused("nan.off", "OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n", "cut short, or has");
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

TEST_F(MeshIo, SaysNothingOnTheTerminal) {
  testing::internal::CaptureStderr();
  ExpectRefused("text.ply", "ply\nformat nonsense\n", "");
  ExpectRefused("bad.obj", "v 0 0 0\nf 1 7 9 99\nusemtl missing\nmtllib missing.mtl\n", "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(MeshIo, LeavesNothingBehindWhereItCannotWrite) {
  EXPECT_THAT([&] { WriteMesh(folder_ / "missing" / "a.ply", AwkwardMesh()); },
              ThrowsMessage<RunError>(HasSubstr("a.ply: cannot be written")));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

}  // namespace
}  // namespace vitruvia
