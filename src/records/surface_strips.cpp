#include "records/surface_strips.h"

#include <bit>
#include <cstring>

#include "config/stored_data.h"
#include "core/error.h"
#include "core/files.h"
#include "geometry/mesh_io.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFolder = "surfaces";
constexpr const char* kStripsFile = "strips.json";
static_assert(std::endian::native == std::endian::little, "values are copied as they lie");

struct SurfaceEntry {
  std::string mesh, values;  // files; values "" where there are none
  SurfaceColor color = SurfaceColor::kEstimate;

  void Describe(Fields& f) {
    f.Text("mesh", mesh, {.meaning = "mesh file"});
    f.Text("values", values,
           {.meaning = "file of values per vertex; absent where the colour needs none",
            .optional = true});
    f.Choice("color", color,
             {{"truth", SurfaceColor::kTruth},
              {"estimate", SurfaceColor::kEstimate},
              {"error", SurfaceColor::kError},
              {"bone", SurfaceColor::kBone}},
             {.meaning = "what the colours show"});
  }
};

struct PanelEntry {
  std::string title;
  double turn_deg = 0.0;
  std::vector<SurfaceEntry> surfaces;

  void Describe(Fields& f) {
    f.Text("title", title, {.meaning = "title of the panel"});
    f.Number(
        "turn_deg", turn_deg,
        {.meaning = "rotation of the view about the vertical, 0 from the front", .unit = "deg"});
    f.List("surfaces", surfaces, {.meaning = "surfaces that the panel draws"});
  }
};

struct StripEntry {
  std::string label, note;
  std::vector<PanelEntry> panels;

  void Describe(Fields& f) {
    f.Text("label", label, {.meaning = "what the strip shows"});
    f.Text("note", note, {.meaning = "remark on the strip", .optional = true});
    f.List("panels", panels, {.meaning = "panels of the strip, from left to right"});
  }
};

struct StripsFile {
  static constexpr StoredFormat kFormat{"vitruvia-surfaces", 1, 0, "run the experiment again"};

  std::vector<StripEntry> strips;

  void Describe(Fields& f) { f.List("strips", strips, {.meaning = "strips of panels"}); }
};

std::vector<float> ReadValues(const fs::path& file, std::size_t count) {
  const std::string bytes = ReadWholeFile(file);
  if (bytes.size() != count * sizeof(float)) {
    throw DataError(fmt::format("{}: {} bytes, expected {} for {} vertices", file.string(),
                                bytes.size(), count * sizeof(float), count));
  }
  std::vector<float> values(count);
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

ShownSurface ReadSurface(const fs::path& folder, const SurfaceEntry& entry) {
  ShownSurface surface;
  surface.mesh = ReadMesh(folder / entry.mesh);
  surface.color = entry.color;
  if (!entry.values.empty())
    surface.values = ReadValues(folder / entry.values, surface.mesh.vertices.size());
  return surface;
}

}  // namespace

bool HasSurfaceStrips(const fs::path& run_folder) {
  return fs::is_regular_file(run_folder / kFolder / kStripsFile);
}

void WriteSurfaceStrips(const fs::path& run_folder, const std::vector<SurfaceStrip>& strips) {
  StagedFolder staged(run_folder / kFolder, kStripsFile);
  StripsFile file;
  int number = 0;
  for (const SurfaceStrip& strip : strips) {
    StripEntry& strip_entry = file.strips.emplace_back(StripEntry{strip.label, strip.note, {}});
    for (const SurfacePanel& panel : strip.panels) {
      PanelEntry& panel_entry =
          strip_entry.panels.emplace_back(PanelEntry{panel.title, panel.turn_deg, {}});
      for (const ShownSurface& surface : panel.surfaces) {
        SurfaceEntry entry{fmt::format("{:03}.ply", number), "", surface.color};
        WriteMesh(staged.path() / entry.mesh, surface.mesh);
        if (!surface.values.empty()) {
          Require(surface.values.size() == surface.mesh.vertices.size(),
                  "WriteSurfaceStrips: {} values for {} vertices", surface.values.size(),
                  surface.mesh.vertices.size());
          entry.values = fmt::format("{:03}.bin", number);
          WriteWholeFile(staged.path() / entry.values,
                         {reinterpret_cast<const char*>(surface.values.data()),
                          surface.values.size() * sizeof(float)});
        }
        panel_entry.surfaces.push_back(entry);
        ++number;
      }
    }
  }
  WriteStored(staged.path() / kStripsFile, file);
  staged.Commit();
}

std::vector<SurfaceStrip> ReadSurfaceStrips(const fs::path& run_folder) {
  const fs::path folder = run_folder / kFolder;
  const auto file = ReadStored<StripsFile>(folder / kStripsFile);
  std::vector<SurfaceStrip> strips;
  for (const StripEntry& strip : file.strips) {
    SurfaceStrip& read = strips.emplace_back(SurfaceStrip{strip.label, strip.note, {}});
    for (const PanelEntry& panel : strip.panels) {
      SurfacePanel& read_panel =
          read.panels.emplace_back(SurfacePanel{panel.title, panel.turn_deg, {}});
      for (const SurfaceEntry& entry : panel.surfaces)
        read_panel.surfaces.push_back(ReadSurface(folder, entry));
    }
  }
  return strips;
}

}  // namespace vitruvia
