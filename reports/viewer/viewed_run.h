// What a viewer's page says of a sequence and of a run: JSON beside packed arrays. viewer_data.js
// reads it.
#pragma once

#include <memory>
#include <vector>

#include <nlohmann/json.hpp>

#include "diagnosis/diagnosis.h"
#include "records/estimate.h"
#include "records/run_record.h"
#include "reports/viewer/packing.h"
#include "reports/viewer/thinned_mesh.h"
#include "sequence/sequence.h"

namespace vitruvia {

// A run's stored data, open.
struct OpenedRun {
  std::filesystem::path folder;  // <experiment>/<run id>
  RunRecord record;
  std::filesystem::path sequence_folder;
  std::shared_ptr<const SequenceReader> sequence;  // runs of one sequence share it
  std::shared_ptr<const EstimateReader> estimate;
  Diagnosis diagnosis;

  int frame_count() const;
};

// DataError as in WriteViewer.
std::vector<OpenedRun> OpenRuns(const std::vector<std::filesystem::path>& run_folders);

// What all parts of a page have in common.
struct PageFrame {
  std::vector<int> stored_frames;
  PositionGrid grid;
  int most_vertices = 0;
  double error_scale_m = 0.0;  // where the colours of errors end
};

// Camera, depth points, true surface and joints, template.
nlohmann::json SequenceContent(const OpenedRun& run, const PageFrame& page, PackedArrays& arrays);

// Surface with its errors, joints, numbers per frame. `sequence`: its index in the page.
nlohmann::json RunContent(const OpenedRun& run, int sequence, const PageFrame& page,
                          PackedArrays& arrays);

// Of all surfaces in those frames.
Eigen::AlignedBox3f BoundingBoxOf(const std::vector<OpenedRun>& runs,
                                  const std::vector<int>& frames);
// That holds nearly all errors of what the camera has in view, in those frames.
double ErrorScaleOf(const std::vector<OpenedRun>& runs, const std::vector<int>& frames);

}  // namespace vitruvia
