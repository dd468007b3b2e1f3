#include "reports/pictures/picture_source.h"

#include <algorithm>

#include "core/error.h"

namespace vitruvia {
namespace fs = std::filesystem;

std::vector<int> FramesToShow(const std::vector<int>& asked, int count) {
  constexpr int kSpread = 4;
  std::vector<int> frames = asked;
  if (asked.empty()) {
    for (int i = 0; i < std::min(kSpread, count); ++i)
      frames.push_back(i * (count - 1) / std::max(std::min(kSpread, count) - 1, 1));
  }
  std::erase_if(frames, [count](int frame) { return frame < 0 || frame >= count; });
  return frames;
}

PictureSource::PictureSource(const fs::path& experiment_folder, const RunRecord& run,
                             const std::vector<int>& frames)
    : sequence_((experiment_folder / run.sequence_folder).lexically_normal()),
      estimate_(experiment_folder / run.run_id / "estimate") {
  std::optional<RestCorrespondence> correspondence;
  if (has_truth()) correspondence.emplace(estimate_.rest_mesh(), sequence_.true_rest_mesh());
  const int count = std::min(sequence_.info().frames, static_cast<int>(estimate_.frames().size()));
  for (const int frame : FramesToShow(frames, count)) {
    PictureFrame& shown = frames_.emplace_back();
    shown.number = frame;
    if (!correspondence) continue;
    const std::vector<Vector3f> vertices = estimate_.ReadVertices(frame);
    shown.errors_m =
        VertexErrors(vertices, correspondence->TruePositions(sequence_.ReadTrueVertices(frame)));
    for (const Vector3f& vertex : vertices) {
      shown.in_view.push_back(sequence_.info().camera.InView(vertex));
    }
  }
}

std::unique_ptr<PictureSource> OpenPictureSource(const ReportedExperiment& experiment,
                                                 const RunRecord& run, std::string& problem) {
  try {
    auto source =
        std::make_unique<PictureSource>(experiment.folder, run, experiment.record.picture_frames);
    if (source->frames().empty()) problem = "the run has none of the experiment's picture frames";
    return source;
  } catch (const DataError& error) {
    problem = error.what();
    return nullptr;
  }
}

}  // namespace vitruvia
