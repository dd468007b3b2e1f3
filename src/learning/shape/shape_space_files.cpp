// The shape space on disk (see shape_space.h).
#include <bit>
#include <cstring>

#include "config/stored_data.h"
#include "core/error.h"
#include "core/files.h"
#include "learning/shape/shape_space.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kSpaceFile = "space.json";

static_assert(std::endian::native == std::endian::little, "matrices are copied as they lie");

template <class Matrix>
void WriteMatrix(const fs::path& file, const Matrix& matrix) {
  WriteWholeFile(file, {reinterpret_cast<const char*>(matrix.data()),
                        static_cast<std::size_t>(matrix.size()) * sizeof(*matrix.data())});
}

template <class Matrix>
Matrix ReadMatrix(const fs::path& file, Eigen::Index rows, Eigen::Index columns) {
  Matrix matrix(rows, columns);
  const std::string bytes = ReadWholeFile(file);
  const std::size_t expected = static_cast<std::size_t>(matrix.size()) * sizeof(*matrix.data());
  if (bytes.size() != expected) {
    throw DataError(fmt::format("{}: {} bytes, expected {} for {} × {} numbers", file.string(),
                                bytes.size(), expected, rows, columns));
  }
  std::memcpy(matrix.data(), bytes.data(), expected);
  if (!matrix.allFinite()) throw DataError(file.string() + ": holds numbers that are not finite");
  return matrix;
}

struct SpaceHeader {
  static constexpr StoredFormat kFormat{"vitruvia-shape-space", 1, 1, "learn the space again"};

  int components = 0;

  void Describe(Fields& f) {
    f.Integer("components", components,
              {.meaning = "principal components", .min = 1, .max = 10000});
  }
};

}  // namespace

void WriteShapeSpace(const fs::path& folder, const ShapeSpace& space) {
  StagedFolder staged(folder, kSpaceFile);
  WriteStored(staged.path() / kSpaceFile, SpaceHeader{space.components()}, 2);
  WriteMatrix(staged.path() / "mean.bin", space.mean);
  WriteMatrix(staged.path() / "basis.bin", space.basis);
  WriteMatrix(staged.path() / "joint_mean.bin", space.joint_mean);
  WriteMatrix(staged.path() / "joint_basis.bin", space.joint_basis);
  WriteMatrix(staged.path() / "place_mean.bin", space.place_mean);
  WriteMatrix(staged.path() / "place_basis.bin", space.place_basis);
  WriteMatrix(staged.path() / "attribute_mean.bin", space.attribute_mean);
  WriteMatrix(staged.path() / "attribute_basis.bin", space.attribute_basis);
  WriteMatrix(staged.path() / "density.bin", space.density_kg_m3);
  WriteBodyModel(staged.path() / "reference", space.reference);
  staged.Commit();
}

ShapeSpace ReadShapeSpace(const fs::path& folder) {
  const Eigen::Index components = ReadStored<SpaceHeader>(folder / kSpaceFile).components;
  ShapeSpace space;
  space.reference = ReadBodyModel(folder / "reference");
  const auto coordinates = static_cast<Eigen::Index>(3 * space.reference.rest.vertices.size());
  constexpr Eigen::Index kJointCoordinates = 6 * kBoneCount;
  space.mean = ReadMatrix<Eigen::VectorXf>(folder / "mean.bin", coordinates, 1);
  space.basis = ReadMatrix<Eigen::MatrixXf>(folder / "basis.bin", coordinates, components);
  space.joint_mean = ReadMatrix<Eigen::VectorXd>(folder / "joint_mean.bin", kJointCoordinates, 1);
  space.joint_basis =
      ReadMatrix<Eigen::MatrixXd>(folder / "joint_basis.bin", kJointCoordinates, components);
  space.place_mean = ReadMatrix<Eigen::VectorXd>(folder / "place_mean.bin", 3, 1);
  space.place_basis = ReadMatrix<Eigen::MatrixXd>(folder / "place_basis.bin", 3, components);
  space.attribute_mean =
      ReadMatrix<Eigen::MatrixXd>(folder / "attribute_mean.bin", kAttributeCount, 1);
  space.attribute_basis =
      ReadMatrix<Eigen::MatrixXd>(folder / "attribute_basis.bin", kAttributeCount, components);
  space.density_kg_m3 = ReadMatrix<Eigen::VectorXd>(folder / "density.bin", 2, 1);
  return space;
}

}  // namespace vitruvia
