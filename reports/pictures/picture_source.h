// What pictures of a tracking run are drawn from: its stored sequence and estimate.
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

// The frames that pictures are taken of, of a run of that length: those asked for that it has, or,
// where none are asked for, four from the first to the last.
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

// Null, and the reason in `problem`, where stored data is gone or damaged: a report can do without
// its pictures, but must say so.
std::unique_ptr<PictureSource> OpenPictureSource(const ReportedExperiment& experiment,
                                                 const RunRecord& run, std::string& problem);

}  // namespace vitruvia
