#include "reports/export/mesh_export.h"

#include <gmock/gmock.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include "core/error.h"
#include "core/files.h"
#include "math/statistics.h"
#include "records/estimate.h"
#include "records/run_record.h"
#include "reports/synthetic_experiment.h"
#include "sequence/sequence.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class MeshExport : public testing::Test {
 protected:
  TemporaryFolder folder_;
  fs::path experiment_ = WriteSyntheticExperiment(folder_.path());
  fs::path meshes_ = folder_ / "meshes";
};

std::vector<double> Values(vtkPolyData& data, const char* name) {
  vtkDataArray* array = data.GetPointData()->GetArray(name);
  std::vector<double> values;
  for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfTuples(); ++i)
    values.push_back(array->GetTuple1(i));
  return values;
}

TEST_F(MeshExport, ReadBackByVtkTheMeshesHoldPlacesAndErrors) {
  EXPECT_EQ(ExportMeshes(experiment_, kWavingRun, {0, kPictureFrame}, meshes_), 2);
  vtkNew<vtkXMLPolyDataReader> reader;
  const fs::path file = meshes_ / fmt::format("estimate_{:06}.vtp", kPictureFrame);
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkPolyData& data = *reader->GetOutput();

  const EstimateReader estimate(experiment_ / kWavingRun / "estimate");
  const std::vector<Vector3f> vertices = estimate.ReadVertices(kPictureFrame);
  ASSERT_EQ(data.GetNumberOfPoints(), static_cast<vtkIdType>(vertices.size()));
  ASSERT_EQ(data.GetNumberOfPolys(), static_cast<vtkIdType>(estimate.rest_mesh().triangles.size()));
  vtkDataArray* to_truth = data.GetPointData()->GetArray("to_truth_m");
  ASSERT_NE(to_truth, nullptr);
  const std::vector<double> errors = Values(data, "error_m");
  ASSERT_EQ(errors.size(), vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double* place = data.GetPoint(static_cast<vtkIdType>(v));
    EXPECT_EQ(Vector3d(place[0], place[1], place[2]), vertices[v].cast<double>());
    const double* step = to_truth->GetTuple3(static_cast<vtkIdType>(v));
    EXPECT_NEAR(Vector3d(step[0], step[1], step[2]).norm(), errors[v], 1e-6);
  }
  const RunRecord record = ReadRunRecord(experiment_, kWavingRun);
  EXPECT_NEAR(Mean(errors), record.frames.at("l2_mean_m")[kPictureFrame], 1e-6);
  EXPECT_NEAR(Maximum(errors), record.frames.at("l2_max_m")[kPictureFrame], 1e-6);
}

TEST_F(MeshExport, CollectionsNameAllFramesWithTheirTimes) {
  EXPECT_EQ(ExportMeshes(experiment_, kExactRun, {}, meshes_), kSyntheticFrames);
  const SequenceReader sequence(experiment_ /
                                ReadRunRecord(experiment_, kExactRun).sequence_folder);
  for (const std::string surface : {"estimate", "truth"}) {
    const std::string text = ReadWholeFile(meshes_ / (surface + ".pvd"));
    EXPECT_THAT(text, HasSubstr(fmt::format("timestep=\"{:.6f}\" file=\"{}_000011.vtp\"",
                                            11 / sequence.info().fps, surface)));
    EXPECT_TRUE(fs::is_regular_file(meshes_ / (surface + "_000011.vtp")));
  }
  vtkNew<vtkXMLPolyDataReader> reader;
  const fs::path file = meshes_ / "estimate_000005.vtp";
  reader->SetFileName(file.c_str());
  reader->Update();
  EXPECT_EQ(Maximum(Values(*reader->GetOutput(), "error_m")), 0.0);  // the truth as the estimate
}

TEST_F(MeshExport, FramesThatAreNotThereAndStrangersFoldersAreRefused) {
  EXPECT_THROW(ExportMeshes(experiment_, kWavingRun, {kSyntheticFrames}, meshes_), ConfigError);
  EXPECT_THROW(ExportMeshes(experiment_, kWavingRun, {-1}, meshes_), ConfigError);
  EXPECT_THROW(ExportMeshes(experiment_, kMissingRun, {0}, meshes_), DataError);
  EXPECT_FALSE(fs::exists(meshes_));
  MakeFolder(meshes_ / "thesis");
  EXPECT_THROW(ExportMeshes(experiment_, kWavingRun, {0}, meshes_), RunError);
}

}  // namespace
}  // namespace vitruvia
