// A run's joints for other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "body/body_model.h"
#include "reports/export/exported_run.h"

namespace vitruvia {

// A table with one row for each frame and joint: frame,time_s,joint,x_m,y_m,z_m of the estimate;
// true_x_m,true_y_m,true_z_m,visible,error_m, which are empty where the joint's truth is not known.
// Camera frame (x right, y down, z forward). `frames` as in OpenForExport; returns how many.
int ExportJointTable(const std::filesystem::path& experiment_folder, const std::string& run_id,
                     std::vector<int> frames, const std::filesystem::path& file);

// The estimated motion in Biovision's format, all frames: centimetres, y up, z towards the camera.
// Every joint has position channels, since bones of an estimate need not keep their lengths. How
// each bone is turned is fitted to the surface (scoring/bone_placement.h). `subject`: the one that
// was tracked.
int ExportBvh(const ExportedRun& run, const BodyModel& subject, const std::filesystem::path& file);

}  // namespace vitruvia
