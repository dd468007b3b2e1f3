// Pictures of the surfaces that a run without frames left behind.
#pragma once

#include <filesystem>

#include "reports/drawing/mesh_view.h"
#include "reports/pictures/pictures.h"

namespace vitruvia {

// Fills titles, strips and the error scale of `run`; its problem where files are damaged.
void DrawSurfaceStrips(const std::filesystem::path& run_folder, MeshView& view, RunPictures& run);

}  // namespace vitruvia
