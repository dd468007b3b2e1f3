// Surfaces that a run without frames stores for its report: strips of panels, each a view of
// coloured meshes.
//
// In the run's folder: surfaces/strips.json, surfaces/NNN.ply (subject frame, metres) and, where a
// surface has values, surfaces/NNN.bin (float32 per vertex, little-endian).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

enum class SurfaceColor {
  kTruth,     // the colour that reports give the truth
  kEstimate,  // the colour that reports give an estimate
  kError,     // values: metres
  kBone,      // values: a bone's index, or between two for a blend
};

struct ShownSurface {
  TriangleMesh mesh;  // subject frame, metres
  SurfaceColor color = SurfaceColor::kEstimate;
  std::vector<float> values;  // per vertex, for colours that need them
};

struct SurfacePanel {
  std::string title;
  double turn_deg = 0.0;  // about the vertical; 0: seen from the front
  std::vector<ShownSurface> surfaces;
};

// All strips of a run have the same titles.
struct SurfaceStrip {
  std::string label, note;
  std::vector<SurfacePanel> panels;
};

bool HasSurfaceStrips(const std::filesystem::path& run_folder);
void WriteSurfaceStrips(const std::filesystem::path& run_folder,
                        const std::vector<SurfaceStrip>& strips);
// DataError if a file is missing or damaged.
std::vector<SurfaceStrip> ReadSurfaceStrips(const std::filesystem::path& run_folder);

}  // namespace vitruvia
