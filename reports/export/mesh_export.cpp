#include "reports/export/mesh_export.h"

#include <optional>
#include <utility>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/error.h"
#include "core/files.h"
#include "metrics/vertex_error.h"
#include "reports/export/exported_run.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kCollectionName = "estimate.pvd";

vtkNew<vtkPolyData> SurfaceData(const std::vector<Vector3f>& vertices,
                                const std::vector<Triangle>& triangles) {
  vtkNew<vtkPoints> points;
  for (const Vector3f& vertex : vertices) points->InsertNextPoint(vertex.data());
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : triangles) cells->InsertNextCell({t[0], t[1], t[2]});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

void AddErrors(vtkPolyData& surface, const std::vector<Vector3f>& estimate,
               const std::vector<Vector3f>& truth) {
  vtkNew<vtkFloatArray> error, to_truth;
  error->SetName("error_m");
  to_truth->SetName("to_truth_m");
  to_truth->SetNumberOfComponents(3);
  const std::vector<double> errors = VertexErrors(estimate, truth);
  for (std::size_t v = 0; v < estimate.size(); ++v) {
    error->InsertNextValue(static_cast<float>(errors[v]));
    const Vector3f step = truth[v] - estimate[v];
    to_truth->InsertNextTuple(step.data());
  }
  surface.GetPointData()->SetScalars(error);
  surface.GetPointData()->AddArray(to_truth);
}

void WriteSurface(const fs::path& file, vtkPolyData& surface) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(&surface);
  writer->WriteToOutputStringOn();
  writer->Write();
  WriteWholeFile(file, writer->GetOutputString());
}

std::string FrameFileName(const char* surface, int frame) {
  return fmt::format("{}_{:06}.vtp", surface, frame);
}

// ParaView's list of files with their times.
void WriteCollection(const fs::path& folder, const char* surface, const std::vector<int>& frames,
                     double fps) {
  std::string items;
  for (const int frame : frames) {
    items += fmt::format("    <DataSet timestep=\"{:.6f}\" file=\"{}\"/>\n", frame / fps,
                         FrameFileName(surface, frame));
  }
  WriteWholeFile(folder / fmt::format("{}.pvd", surface),
                 "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
                 "  <Collection>\n" +
                     items + "  </Collection>\n</VTKFile>\n");
}

}  // namespace

int ExportMeshes(const fs::path& experiment_folder, const std::string& run_id,
                 std::vector<int> frames, const fs::path& output) {
  const ExportedRun run = OpenForExport(experiment_folder, run_id, std::move(frames));
  const EstimateReader& estimate = run.estimate;
  const SequenceReader& sequence = run.sequence;
  const bool has_truth = sequence.info().surface;
  std::optional<RestCorrespondence> correspondence;
  if (has_truth) correspondence.emplace(estimate.rest_mesh(), sequence.true_rest_mesh());
  StagedFolder folder(output, kCollectionName);
  for (const int frame : run.frames) {
    const std::vector<Vector3f> estimated = estimate.ReadVertices(frame);
    const auto estimated_surface = SurfaceData(estimated, estimate.rest_mesh().triangles);
    if (has_truth) {
      const std::vector<Vector3f> truth = sequence.ReadTrueVertices(frame);
      AddErrors(*estimated_surface, estimated, correspondence->TruePositions(truth));
      const auto true_surface = SurfaceData(truth, sequence.true_rest_mesh().triangles);
      WriteSurface(folder.path() / FrameFileName("truth", frame), *true_surface);
    }
    WriteSurface(folder.path() / FrameFileName("estimate", frame), *estimated_surface);
  }
  WriteCollection(folder.path(), "estimate", run.frames, sequence.info().fps);
  if (has_truth) WriteCollection(folder.path(), "truth", run.frames, sequence.info().fps);
  folder.Commit();
  return static_cast<int>(run.frames.size());
}

}  // namespace vitruvia
