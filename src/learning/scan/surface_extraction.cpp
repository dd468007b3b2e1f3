// The zero level of a volume. VTK's only place in scan fusion.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include "learning/scan/scan_surface.h"

namespace vitruvia {
namespace {

// A distance of exactly zero would put several vertices at one place; this moves the surface by
// less than a micrometre.
constexpr float kZeroNudgeM = 1e-6f;
// A vertex this near to a lattice point does not tell along which edge it lies.
constexpr float kOnLatticePoint = 1e-4f;

using Lattice = TsdfVolume::Lattice;

struct Box {
  Lattice low{}, size{};  // lattice points
};

// Round all blocks, and a point more on every side.
Box BoxOf(const TsdfVolume& volume) {
  constexpr int kMax = std::numeric_limits<int>::max();
  Lattice low{kMax, kMax, kMax}, high{-kMax, -kMax, -kMax};
  for (const Lattice& corner : volume.block_corners()) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], corner[axis] - 1);
      high[axis] = std::max(high[axis], corner[axis] + TsdfVolume::kBlockSide);
    }
  }
  return {low, {high[0] - low[0] + 1, high[1] - low[1] + 1, high[2] - low[2] + 1}};
}

bool Observed(const TsdfVolume::Voxel& voxel, double min_weight) {
  return voxel.weight > 0.0f && voxel.weight >= static_cast<float>(min_weight);
}

// Distances in a box; unobserved points count as outside.
vtkNew<vtkImageData> DenseDistances(const TsdfVolume& volume, const Box& box, double min_weight) {
  vtkNew<vtkFloatArray> values;
  const std::int64_t row = box.size[0], slice = row * box.size[1];
  values->SetNumberOfValues(slice * box.size[2]);
  float* out = values->GetPointer(0);
  std::fill(out, out + slice * box.size[2], 1.0f);
  for (const Lattice& corner : volume.block_corners()) {
    for (int z = 0; z < TsdfVolume::kBlockSide; ++z) {
      for (int y = 0; y < TsdfVolume::kBlockSide; ++y) {
        for (int x = 0; x < TsdfVolume::kBlockSide; ++x) {
          const Lattice at = {corner[0] + x, corner[1] + y, corner[2] + z};
          const TsdfVolume::Voxel voxel = volume.At(at);
          if (!Observed(voxel, min_weight)) continue;
          out[(at[2] - box.low[2]) * slice + (at[1] - box.low[1]) * row + at[0] - box.low[0]] =
              std::abs(voxel.distance_m) < kZeroNudgeM ? kZeroNudgeM : voxel.distance_m;
        }
      }
    }
  }
  vtkNew<vtkImageData> image;
  image->SetDimensions(box.size[0], box.size[1], box.size[2]);
  image->GetPointData()->SetScalars(values);
  return image;
}

// The volume's weight at a vertex, between the ends of the lattice edge that it lies on; 0 if one
// of them is unobserved: the surface there is only the border of what was seen.
float WeightAt(const TsdfVolume& volume, const Vector3f& position, double min_weight) {
  const Vector3f base = position.array().floor();
  const Vector3f fraction = position - base;
  int axis = 0;
  (fraction.array() * (1.0f - fraction.array())).maxCoeff(&axis);
  const Vector3f nearest = (position.array() + 0.5f).floor();
  Lattice from{}, to{};
  for (int i = 0; i < 3; ++i) from[i] = to[i] = static_cast<int>(nearest[i]);
  float share = 0.0f;
  if (fraction[axis] > kOnLatticePoint && fraction[axis] < 1.0f - kOnLatticePoint) {
    from[axis] = static_cast<int>(base[axis]);
    to[axis] = from[axis] + 1;
    share = fraction[axis];
  }
  const TsdfVolume::Voxel a = volume.At(from), b = volume.At(to);
  if (!Observed(a, min_weight) || !Observed(b, min_weight)) return 0.0f;
  return (1.0f - share) * a.weight + share * b.weight;
}

}  // namespace

RawSurface ExtractSurface(const TsdfVolume& volume, double min_weight) {
  RawSurface surface;
  if (volume.block_count() == 0) return surface;
  const Box box = BoxOf(volume);
  const vtkNew<vtkImageData> image = DenseDistances(volume, box, min_weight);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  vtkPolyData* contoured = contour->GetOutput();

  const Vector3f low(static_cast<float>(box.low[0]), static_cast<float>(box.low[1]),
                     static_cast<float>(box.low[2]));
  for (vtkIdType i = 0; i < contoured->GetNumberOfPoints(); ++i) {
    double point[3];
    contoured->GetPoint(i, point);
    const Vector3f position = Vector3d(point[0], point[1], point[2]).cast<float>() + low;
    surface.mesh.vertices.push_back(volume.FromLattice(position));
    surface.weights.push_back(WeightAt(volume, position, min_weight));
  }
  vtkCellArray* cells = contoured->GetPolys();
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i) {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    cells->GetCellAtId(i, size, corners);
    Triangle triangle;
    bool observed = true;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = static_cast<std::int32_t>(corners[k]);
      observed = observed && surface.weights[static_cast<std::size_t>(corners[k])] > 0.0f;
    }
    // VTK turns triangles towards growing values, which here lie outside: counter-clockwise seen
    // from inside.
    std::swap(triangle[1], triangle[2]);
    if (observed) surface.mesh.triangles.push_back(triangle);
  }
  return surface;
}

}  // namespace vitruvia
