// The source of a tracking run's pictures: its stored sequence and estimate.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "metrics/vertex_error.h"
#include "records/estimate.h"
#include "sequence/sequence.h"

namespace vitruvia {

struct PictureFrame {
  int number = 0;
  // Per vertex of the estimate; none without a true surface.
  std::vector<double> errors_m;
  std::vector<bool> in_view;  // whether the camera has it in its image
};

// The frames to draw for a run of `count` frames: the existing ones of `asked`, or, if `asked` is
// empty, four from the first to the last.
std::vector<int> FramesToShow(const std::vector<int>& asked, int count);

class PictureSource {
 public:
  // Of the frames to show. DataError if stored data is gone or damaged.
  PictureSource(const std::filesystem::path& experiment_folder, const RunRecord& run,
                const std::vector<int>& frames);

  const SequenceReader& sequence() const { return sequence_; }
  const EstimateReader& estimate() const { return estimate_; }
  const std::vector<PictureFrame>& frames() const { return frames_; }
  bool has_truth() const { return sequence_.info().surface; }

 private:
  SequenceReader sequence_;
  EstimateReader estimate_;
  std::vector<PictureFrame> frames_;
};

// Null, with the reason in `problem`, if stored data is missing or damaged: the report is then
// written without pictures and states the reason.
std::unique_ptr<PictureSource> OpenPictureSource(const ReportedExperiment& experiment,
                                                 const RunRecord& run, std::string& problem);

}  // namespace vitruvia
