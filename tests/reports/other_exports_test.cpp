// What is exported for other programs, read back by them: glTF by VTK, Khronos' validator and f3d,
// BVH by our own reader of motion capture.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkGLTFReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include "core/error.h"
#include "core/files.h"
#include "records/estimate.h"
#include "reports/drawing/color_image.h"
#include "reports/export/gltf_export.h"
#include "reports/export/joint_export.h"
#include "reports/synthetic_experiment.h"
#include "sequence/sequence.h"
#include "support/temporary_folder.h"
#include "synth/motions/bvh.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

class OtherExports : public testing::Test {
 protected:
  TemporaryFolder folder_;
  fs::path experiment_ = WriteSyntheticExperiment(folder_.path());
  EstimateReader estimate_{experiment_ / kWavingRun / "estimate"};
  SequenceReader sequence_{folder_ / "sequences" / "wave"};
};

template <class Scalar>
Vector3d Upright(const Vector3<Scalar>& camera_point) {
  return {camera_point.x(), -camera_point.y(), -camera_point.z()};
}

// The meshes that a reader shows at a time.
void CollectMeshes(vtkDataObject* data, std::vector<vtkPolyData*>& meshes) {
  if (auto* mesh = vtkPolyData::SafeDownCast(data)) meshes.push_back(mesh);
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(data);
  for (unsigned i = 0; blocks != nullptr && i < blocks->GetNumberOfBlocks(); ++i)
    CollectMeshes(blocks->GetBlock(i), meshes);
}

TEST_F(OtherExports, VtkReadsTheAnimatedSurfacesOfGltf) {
  const fs::path file = folder_ / "run.glb";
  EXPECT_EQ(ExportGltf(experiment_, kWavingRun, {}, file), kSyntheticFrames);
  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName(file.c_str());
  reader->ApplyDeformationsToGeometryOn();
  reader->UpdateInformation();
  ASSERT_EQ(reader->GetNumberOfAnimations(), 1);
  reader->EnableAnimation(0);
  reader->SetFrameRate(30);
  reader->UpdateInformation();
  for (const int frame : {0, 1, 7, kSyntheticFrames - 1}) {
    reader->UpdateTimeStep(frame / sequence_.info().fps);
    std::vector<vtkPolyData*> meshes;
    CollectMeshes(reader->GetOutputDataObject(0), meshes);
    ASSERT_EQ(meshes.size(), 2u) << "estimate and truth";
    const std::vector<std::vector<Vector3f>> expected = {estimate_.ReadVertices(frame),
                                                         sequence_.ReadTrueVertices(frame)};
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      ASSERT_EQ(meshes[m]->GetNumberOfPoints(), static_cast<vtkIdType>(expected[m].size()));
      for (std::size_t v = 0; v < expected[m].size(); ++v) {
        const double* place = meshes[m]->GetPoint(static_cast<vtkIdType>(v));
        EXPECT_LT((Vector3d(place[0], place[1], place[2]) - Upright(expected[m][v])).norm(), 1e-5)
            << "frame " << frame << " mesh " << m << " vertex " << v;
      }
    }
  }
}

TEST_F(OtherExports, GltfIsValid) {
  const fs::path validator = fs::path(VITRUVIA_SOURCE_DIR) / "synth/node_modules/gltf-validator";
  if (!fs::exists(validator)) GTEST_SKIP() << validator << " is not there; make data installs it";
  const fs::path file = folder_ / "run.glb";
  ExportGltf(experiment_, kWavingRun, {0, 4, kPictureFrame}, file);
  const std::string command = fmt::format(
      "node -e 'require(process.argv[1]).validateBytes(new "
      "Uint8Array(require(\"fs\").readFileSync(process.argv[2]))).then(r => "
      "console.log(JSON.stringify(r.issues)))' '{}' '{}'",
      validator.string(), file.string());
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::array<char, 4096> buffer{};
  const std::string output(buffer.data(), std::fread(buffer.data(), 1, buffer.size(), pipe.get()));
  EXPECT_THAT(output, HasSubstr("\"numErrors\":0"));
  EXPECT_THAT(output, HasSubstr("\"numWarnings\":0"));
}

bool HasProgram(const char* name) {
  return std::system(fmt::format("command -v {} >/dev/null 2>&1", name).c_str()) == 0;
}

// A viewer of Debian's that knows nothing of ours; it draws on a display that Xvfb makes up.
TEST_F(OtherExports, GltfIsDrawnByF3d) {
  for (const char* program : {"f3d", "xvfb-run"}) {
    if (!HasProgram(program)) GTEST_SKIP() << program << " is not installed";
  }
  const fs::path file = folder_ / "run.glb", screenshots = VITRUVIA_SCREENSHOTS;
  ExportGltf(experiment_, kWavingRun, {}, file);
  fs::create_directories(screenshots);
  const fs::path picture = screenshots / "f3d.png";
  fs::remove(picture);
  const int status = std::system(
      fmt::format("timeout 60 xvfb-run -a f3d '{}' --output '{}' --resolution 300,300 --bg-color "
                  "1,1,1 >/dev/null 2>&1",
                  file.string(), picture.string())
          .c_str());
  EXPECT_EQ(status, 0);
  const ColorImage drawn = ReadPng(picture);
  const auto is_body = [](const ColorPixel& p) { return p[0] < 250 || p[1] < 250 || p[2] < 250; };
  const auto count = std::ranges::count_if(drawn.pixels(), is_body);
  EXPECT_GT(count, 300 * 300 / 50);
  EXPECT_LT(count, 300 * 300 / 2);
}

TEST_F(OtherExports, BvhHoldsEveryJointToAMillimetre) {
  const fs::path file = folder_ / "joints.bvh";
  EXPECT_EQ(ExportBvh(OpenForExport(experiment_, kWavingRun, {}), sequence_.subject(), file),
            kSyntheticFrames);
  const MocapClip clip = ReadBvh(file);
  ASSERT_EQ(clip.frames.size(), std::size_t{kSyntheticFrames});
  EXPECT_NEAR(clip.frame_s, 1.0 / 30.0, 1e-6);
  constexpr double kMetres = 0.01;
  for (int frame = 0; frame < kSyntheticFrames; ++frame) {
    const MocapPose pose = PoseOf(clip, clip.frames[frame]);
    ASSERT_EQ(pose.positions.size(), std::size_t{kBoneCount});
    for (std::size_t i = 0; i < clip.joints.size(); ++i) {
      const int bone = FindBone(clip.joints[i].name);
      ASSERT_GE(bone, 0) << clip.joints[i].name;
      const Vector3d expected = Upright(estimate_.frames()[frame].joints[bone]);
      EXPECT_LT((kMetres * pose.positions[i] - expected).norm(), 1e-3)
          << "frame " << frame << " " << clip.joints[i].name;
    }
  }
}

// The end of the forearm follows from how the bone is turned, not from a position channel.
TEST_F(OtherExports, BvhTurnsBonesAsTheSurfaceTurns) {
  const fs::path file = folder_ / "joints.bvh";
  ExportBvh(OpenForExport(experiment_, kWavingRun, {}), sequence_.subject(), file);
  const MocapClip clip = ReadBvh(file);
  const Skeleton& skeleton = sequence_.subject().skeleton;
  const int elbow = FindBone("left_forearm"), wrist = FindBone("left_hand");
  for (int frame = 0; frame < kSyntheticFrames; ++frame) {
    const MocapPose pose = PoseOf(clip, clip.frames[frame]);
    for (std::size_t i = 0; i < clip.joints.size(); ++i) {
      if (FindBone(clip.joints[i].name) != elbow) continue;
      const Vector3d rest = skeleton.joints[wrist] - skeleton.joints[elbow];
      const Vector3d end = 0.01 * pose.positions[i] + pose.rotations[i] * rest;
      EXPECT_LT((end - Upright(estimate_.frames()[frame].joints[wrist])).norm(), 1e-3);
    }
  }
}

TEST_F(OtherExports, TableHoldsEstimateAndTruth) {
  const fs::path file = folder_ / "joints.csv";
  EXPECT_EQ(ExportJointTable(experiment_, kWavingRun, {kPictureFrame}, file), 1);
  std::istringstream lines(ReadWholeFile(file));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "frame,time_s,joint,x_m,y_m,z_m,true_x_m,true_y_m,true_z_m,visible,error_m");
  int bone = 0;
  for (; std::getline(lines, line); ++bone) {
    const Vector3d& joint = estimate_.frames()[kPictureFrame].joints[bone];
    const Vector3d& truth = sequence_.true_joints(kPictureFrame).positions[bone];
    EXPECT_EQ(line, fmt::format("{},{:.6f},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},1,{:.6f}",
                                kPictureFrame, kPictureFrame / 30.0, Bones()[bone].joint, joint.x(),
                                joint.y(), joint.z(), truth.x(), truth.y(), truth.z(),
                                (joint - truth).norm()));
  }
  EXPECT_EQ(bone, kBoneCount);
}

TEST_F(OtherExports, FrameThatIsNotThereIsRefused) {
  EXPECT_THROW(ExportGltf(experiment_, kWavingRun, {99}, folder_ / "run.glb"), ConfigError);
  EXPECT_FALSE(fs::exists(folder_ / "run.glb"));
}

}  // namespace
}  // namespace vitruvia
