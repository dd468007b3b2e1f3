// Pictures of the surfaces that a run without frames stored.
#pragma once

#include <filesystem>

#include "records/surface_strips.h"
#include "reports/pictures/mesh_view.h"
#include "reports/pictures/pictures.h"

namespace vitruvia {

// Fills titles, strips and the error scale of `run`.
void DrawSurfaceStrips(const std::vector<SurfaceStrip>& strips, MeshView& view, RunPictures& run);
// The same for a run's stored strips; sets the run's problem if there are none or files are
// damaged.
void DrawSurfaceStrips(const std::filesystem::path& run_folder, MeshView& view, RunPictures& run);

}  // namespace vitruvia
