#include "reports/pictures/cause_pictures.h"

#include <algorithm>
#include <map>

#include "core/build_info.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/worker_team.h"
#include "records/estimate.h"
#include "reports/drawing/color_maps.h"
#include "reports/pictures/drawn_before.h"
#include "reports/pictures/mesh_view.h"
#include "reports/pictures/picture_window.h"

namespace vitruvia {
namespace {

constexpr double kEventMargin = 1.15;  // of a picture over the bodies in it

// The window round the truth and, as long as the camera has it in view, the estimate.
PictureWindow WindowRound(const PinholeCamera& camera,
                          const std::vector<std::vector<Vector3f>>& surfaces) {
  std::vector<Vector3f> seen;
  for (const std::vector<Vector3f>& surface : surfaces) {
    for (const Vector3f& vertex : surface) {
      if (camera.InView(vertex)) seen.push_back(vertex);
    }
  }
  if (seen.empty()) {
    const double width = camera.width;
    return {0.0, 0.5 * (camera.height - width), width, width};
  }
  const ImageBounds bounds = Projected(camera, seen);
  return Centered(bounds, kEventMargin * bounds.extent());
}

Picture DrawEvent(const SequenceReader& sequence, const EstimateReader& estimate, int frame,
                  MeshView& view) {
  const PinholeCamera& camera = sequence.info().camera;
  std::vector<std::vector<Vector3f>> surfaces = {estimate.ReadVertices(frame)};
  if (sequence.info().surface) surfaces.push_back(sequence.ReadTrueVertices(frame));
  std::vector<ShadedMesh> meshes = {
      {&surfaces[0], &estimate.rest_mesh().triangles, {kEstimateColor}}};
  if (surfaces.size() > 1)
    meshes.push_back({&surfaces[1], &sequence.true_rest_mesh().triangles, {kTruthColor}});
  return Picture(OnWhite(view.Draw(camera, WindowRound(camera, surfaces), meshes)));
}

void Explain(const SequenceReader& sequence, const std::vector<FrameEvidence>& evidence,
             const std::filesystem::path& run_folder, MeshView& view, RunCauses& run) {
  try {
    const EstimateReader estimate(run_folder / "estimate");
    run.diagnosis = Diagnose(evidence, estimate);
    for (const ErrorEvent& event : run.diagnosis.events)
      run.pictures.push_back(DrawEvent(sequence, estimate, event.worst, view));
  } catch (const DataError& error) {  // the report is written without them and states the reason
    run.problem = error.what();
    run.pictures.clear();
  }
}

}  // namespace

std::vector<RunCauses> FindCauses(const ReportedExperiment& experiment, const DrawnBefore& before) {
  std::vector<RunCauses> all;
  std::map<std::filesystem::path, std::vector<std::size_t>> runs_of_sequence;
  for (const RunRecord* run : experiment.finished()) {
    if (run->frames.empty()) continue;
    if (const RunCauses* found = before.Causes(run->run_id)) {
      all.push_back(*found);
      continue;
    }
    runs_of_sequence[run->sequence_folder].push_back(all.size());
    all.emplace_back().run_id = run->run_id;
  }
  const std::vector<std::pair<std::filesystem::path, std::vector<std::size_t>>> sequences(
      runs_of_sequence.begin(), runs_of_sequence.end());
  WorkerTeam team(GetMachineInfo().threads);
  team.For(static_cast<int>(sequences.size()), 1, [&](int begin, int end) {
    MeshView view(kEventPictureSize, kEventPictureSize);
    for (int i = begin; i < end; ++i) {
      ThrowIfInterrupted();
      const auto& [folder, runs] = sequences[static_cast<std::size_t>(i)];
      try {
        const SequenceReader sequence((experiment.folder / folder).lexically_normal());
        const std::vector<FrameEvidence> evidence = GatherEvidence(sequence);
        for (const std::size_t r : runs)
          Explain(sequence, evidence, experiment.folder / all[r].run_id, view, all[r]);
      } catch (const DataError& error) {
        for (const std::size_t r : runs) all[r].problem = error.what();
      }
    }
  });
  return all;
}

}  // namespace vitruvia
