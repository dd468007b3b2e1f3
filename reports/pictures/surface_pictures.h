// Pictures of the surfaces that a run without frames left behind.
#pragma once

#include <filesystem>

#include "records/surface_strips.h"
#include "reports/pictures/mesh_view.h"
#include "reports/pictures/pictures.h"

namespace vitruvia {

// Fills titles, strips and the error scale of `run`.
void DrawSurfaceStrips(const std::vector<SurfaceStrip>& strips, MeshView& view, RunPictures& run);
// Of the strips that a run left; its problem where it left none or files are damaged.
void DrawSurfaceStrips(const std::filesystem::path& run_folder, MeshView& view, RunPictures& run);

}  // namespace vitruvia
