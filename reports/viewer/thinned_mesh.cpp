#include "reports/viewer/thinned_mesh.h"

#include <numeric>

#include <vtkCellArray.h>
#include <vtkDecimatePro.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace vitruvia {
namespace {

constexpr const char* kVertexIndex = "vertex";

vtkNew<vtkPolyData> WithVertexIndices(const TriangleMesh& mesh) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkIdTypeArray> indices;
  indices->SetName(kVertexIndex);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    points->InsertNextPoint(mesh.vertices[v].data());
    indices->InsertNextValue(static_cast<vtkIdType>(v));
  }
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : mesh.triangles) cells->InsertNextCell({t[0], t[1], t[2]});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->AddArray(indices);
  return data;
}

}  // namespace

ThinnedMesh Thinned(const TriangleMesh& rest, int most_vertices) {
  ThinnedMesh thinned;
  const auto count = static_cast<int>(rest.vertices.size());
  if (count <= most_vertices) {
    thinned.kept.resize(rest.vertices.size());
    std::iota(thinned.kept.begin(), thinned.kept.end(), 0u);
    thinned.triangles = rest.triangles;
    return thinned;
  }
  const auto data = WithVertexIndices(rest);
  vtkNew<vtkDecimatePro> decimation;  // it takes vertices away and moves none
  decimation->SetInputData(data);
  decimation->SetTargetReduction(1.0 - static_cast<double>(most_vertices) / count);
  decimation->PreserveTopologyOn();
  decimation->Update();
  vtkPolyData& coarse = *decimation->GetOutput();
  const auto* indices =
      vtkIdTypeArray::SafeDownCast(coarse.GetPointData()->GetAbstractArray(kVertexIndex));
  for (vtkIdType v = 0; v < coarse.GetNumberOfPoints(); ++v)
    thinned.kept.push_back(static_cast<std::uint32_t>(indices->GetValue(v)));
  for (vtkIdType cell = 0; cell < coarse.GetNumberOfCells(); ++cell) {
    vtkNew<vtkIdList> corners;
    coarse.GetCellPoints(cell, corners);
    thinned.triangles.push_back({static_cast<std::int32_t>(corners->GetId(0)),
                                 static_cast<std::int32_t>(corners->GetId(1)),
                                 static_cast<std::int32_t>(corners->GetId(2))});
  }
  return thinned;
}

}  // namespace vitruvia
