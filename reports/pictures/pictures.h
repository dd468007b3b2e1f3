// Picture strips: the observed depth, the estimate, and its error.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "reports/drawing/drawing_writer.h"

namespace vitruvia {

inline constexpr int kPictureSize = 300;     // pixels, width and height of each picture
inline constexpr double kSheetCell = 210.0;  // page units, width and height of each on a sheet
// Pixels of a PNG per page unit, at which a sheet's pictures are as they were drawn.
inline constexpr double kSheetPngScale = kPictureSize / kSheetCell;

struct PictureStrip {
  std::string label, sublabel;  // "frame 90", "3.00 s"
  std::string note;             // how a tracker ended, with its message; errors
  int frame = 0;
  double error_mean_m = 0.0, error_max_m = 0.0;
  std::vector<Picture> pictures;  // in the order of the run's titles
};

struct ColorKey {
  Color color;
  std::string meaning;
};

struct RunPictures {
  std::string run_id;
  std::string problem;                       // why there are none; "" if there are pictures
  std::vector<std::string> titles;           // of a strip's pictures
  double nearest_m = 0.0, farthest_m = 0.0;  // ends of the depth colours; both 0: no depth shown
  double error_scale_m = 0.0;                // end of the error colours; 0: no errors shown
  double own_error_scale_m = 0.0;            // where they would end if there were no other run
  std::vector<ColorKey> keys;                // what plain colours mean
  std::vector<PictureStrip> strips;
};

// Of a tracking run's strips; of one whose sequence has no true surface the first three.
const std::vector<std::string>& PictureTitles();
std::vector<std::string> PictureTitlesWithoutTruth();

class DrawnBefore;

// Callback for a run's pictures as soon as they are drawn, on the thread that drew them.
using PictureUse = std::function<void(RunPictures&)>;

// One entry per finished run: at the experiment's picture frames that the run has, or, of a run
// that left surfaces instead of frames (records/surface_strips.h), those. The error of a vertex is
// its distance to the corresponding true point, which is the closest one in the common rest pose.
// All runs share one error scale, so that their colours are comparable. Runs are drawn on all
// cores; pictures that an earlier report drew of the same data are reused.
std::vector<RunPictures> MakePictures(const ReportedExperiment& experiment,
                                      const DrawnBefore& before, const PictureUse& use = {});

// Of a run's sheet in a folder of figures: without the ending.
std::filesystem::path SheetStem(const std::filesystem::path& folder, const std::string& run_id);

struct SheetStyle {
  double text_size = 12.0;      // page units
  std::optional<double> width;  // of the sheet; without it pictures have their usual size
};

// Writes all strips of a run with their titles, keys and colour bars to one drawing.
void WritePictureSheet(const DrawingWriter& writer, const std::filesystem::path& stem,
                       const RunPictures& pictures, const SheetStyle& style = {});

}  // namespace vitruvia
