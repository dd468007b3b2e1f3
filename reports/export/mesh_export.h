// Surfaces of a run as files that other programs open: VTK PolyData, with the error as point data.
//
//   estimate_NNNNNN.vtp   the estimated surface: camera frame, metres; point data error_m (float)
//                         and to_truth_m (3 floats: displacement of each vertex to the true
//                         surface)
//   truth_NNNNNN.vtp      the true surface; if the sequence has none, it and the errors are missing
//   estimate.pvd, truth.pvd   the frames in order with times in seconds, to be opened in ParaView
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitruvia {

// Writes those frames of a run (all if there are none) to a new folder `output`, whole or not at
// all, and returns how many. DataError if the run has no estimate, its sequence is gone, or there
// is no such frame.
int ExportMeshes(const std::filesystem::path& experiment_folder, const std::string& run_id,
                 std::vector<int> frames, const std::filesystem::path& output);

}  // namespace vitruvia
