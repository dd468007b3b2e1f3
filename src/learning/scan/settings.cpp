#include "learning/scan/settings.h"

#include <algorithm>

#include <fmt/format.h>

namespace vitruvia {
namespace {

constexpr double kMaxBlocksPerAxis = 200;
constexpr double kBlockSide = 8;
constexpr std::size_t kMaxLevels = 5;

}  // namespace

void VolumeSettings::Describe(Fields& f) {
  f.Number("voxel_m", voxel_m,
           {.meaning = "edge length of a voxel",
            .unit = "m",
            .min = 0.001,
            .max = 0.1,
            .origin = Origin::kGuessed,
            .source = "half a pixel of 320 columns at 2 m"});
  f.Number("truncation_m", truncation_m,
           {.meaning = "truncation: distances are kept up to this far from the surface; choose it "
                       "larger than the depth noise and smaller than the body's thinnest parts",
            .unit = "m",
            .min = 0.002,
            .max = 0.5,
            .origin = Origin::kGuessed,
            .source = "four voxels"});
  f.Number("max_weight", max_weight,
           {.meaning = "upper bound of a voxel's weight; beyond it, new frames replace old ones",
            .min = 1.0,
            .max = 1e6,
            .origin = Origin::kGuessed,
            .source = "more than a scan's frames: the mean of all of them"});
  f.Numbers("low_m", low_m,
            {.meaning = "lowest corner of the scanned space, subject frame",
             .unit = "m",
             .min = -10.0,
             .max = 10.0,
             .origin = Origin::kGuessed,
             .source = "a tall subject in the T-pose with room to sway"});
  f.Numbers("high_m", high_m,
            {.meaning = "highest corner of the scanned space, subject frame",
             .unit = "m",
             .min = -10.0,
             .max = 10.0,
             .origin = Origin::kGuessed,
             .source = "a tall subject in the T-pose with room to sway"});
  f.Number("min_cosine", min_cosine,
           {.meaning = "surfaces seen at a smaller cosine of the angle between normal and ray are "
                       "left out",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "78°: depth there says little"});
  f.Number(
      "depth_jump_m", depth_jump_m,
      {.meaning = "neighbouring pixels whose depths differ by more belong to different surfaces",
       .unit = "m",
       .min = 0.001,
       .max = 1.0,
       .origin = Origin::kGuessed,
       .source = "a pixel of 320 columns at 2 m, seen at 80°"});
}

std::string VolumeSettings::Problem() const {
  if (truncation_m < voxel_m) {
    return fmt::format("truncation_m is {:g}, less than a voxel of {:g} m", truncation_m, voxel_m);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double blocks = (high_m[axis] - low_m[axis]) / (kBlockSide * voxel_m);
    if (blocks > 0.0 && blocks <= kMaxBlocksPerAxis) continue;
    return fmt::format(
        "the scanned space reaches from {:g} to {:g} m along {}; expected more than 0 and at most "
        "{:g} m at voxels of {:g} m",
        low_m[axis], high_m[axis], "xyz"[axis], kMaxBlocksPerAxis * kBlockSide * voxel_m, voxel_m);
  }
  return "";
}

void SmoothingSettings::Describe(Fields& f) {
  f.Number(
      "sigma_px", sigma_px,
      {.meaning = "bilateral filter of the depth that is aligned (not of that which is fused): "
                  "reach in the image; 0: no filter",
       .unit = "px",
       .min = 0.0,
       .max = 10.0,
       .origin = Origin::kGuessed,
       .source = "KF, eq. 2 gives none"});
  f.Number("sigma_m", sigma_m,
           {.meaning = "standard deviation of the bilateral filter in depth",
            .unit = "m",
            .min = 0.0001,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "KF, eq. 2 gives none"});
}

void AlignmentSettings::Describe(Fields& f) {
  f.Integers(
      "iterations", iterations,
      {.meaning = "maximum number of ICP iterations at each level of the pyramid, finest first",
       .min = 0,
       .max = 100,
       .origin = Origin::kTuned,
       .source = "KF, sec. 3.5 has 10, 5, 4; the finest level stops earlier here"});
  f.Number("max_distance_m", max_distance_m,
           {.meaning = "maximum distance between matched points",
            .unit = "m",
            .min = 0.001,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "KF gives none; a fast camera moves 0.03 m a frame"});
  f.Number("max_angle_deg", max_angle_deg,
           {.meaning = "maximum angle between the normals of matched points",
            .unit = "deg",
            .min = 1.0,
            .max = 90.0,
            .origin = Origin::kGuessed,
            .source = "KF gives none"});
  f.Number("stop_rotation_deg", stop_rotation_deg,
           {.meaning = "a pyramid level ends when a step turns the camera by less than this and "
                       "moves it by less than stop_translation_m",
            .unit = "deg",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "a hundredth of what a pixel resolves"});
  f.Number("stop_translation_m", stop_translation_m,
           {.meaning = "a pyramid level ends when a step moves the camera by less than this and "
                       "turns it by less than stop_rotation_deg",
            .unit = "m",
            .min = 0.0,
            .max = 0.01,
            .origin = Origin::kGuessed,
            .source = "a hundredth of what a pixel resolves"});
}

std::string AlignmentSettings::Problem() const {
  if (iterations.empty() || iterations.size() > kMaxLevels) {
    return fmt::format("iterations has {} levels, expected 1 … {}", iterations.size(), kMaxLevels);
  }
  for (const int count : iterations) {
    if (count < 0 || count > 100) return fmt::format("iterations: {} is not in 0 … 100", count);
  }
  return "";
}

void LossSettings::Describe(Fields& f) {
  f.Number(
      "min_matched_share", min_matched_share,
      {.meaning = "the camera is lost when a smaller share of a frame's points matches the model",
       .min = 0.0,
       .max = 1.0,
       .origin = Origin::kGuessed,
       .source = "a good frame matches 0.8 and more"});
  f.Number("max_rms_m", max_rms_m,
           {.meaning =
                "the camera is lost when the RMS distance of matched points to the model is larger",
            .unit = "m",
            .min = 0.0001,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "well above a depth camera's noise at 2 m"});
  f.Number("max_condition", max_condition,
           {.meaning = "the camera is lost when the condition number of the alignment's normal "
                       "equations is larger: the view does not determine its pose",
            .min = 1.0,
            .max = 1e12,
            .origin = Origin::kGuessed,
            .source = "a view of a whole body has about 100"});
  f.Number(
      "max_step_m", max_step_m,
      {.meaning =
           "the camera is lost when it seems to have moved farther than this between two frames",
       .unit = "m",
       .min = 0.001,
       .max = 10.0,
       .origin = Origin::kGuessed,
       .source = "3 m/s at 30 frames/s"});
  f.Number(
      "max_step_deg", max_step_deg,
      {.meaning =
           "the camera is lost when it seems to have turned farther than this between two frames",
       .unit = "deg",
       .min = 0.1,
       .max = 180.0,
       .origin = Origin::kGuessed,
       .source = "150°/s at 30 frames/s"});
}

void SurfaceSettings::Describe(Fields& f) {
  f.Number("min_weight", min_weight,
           {.meaning = "the surface is extracted between voxels of at least this weight; a frame "
                       "adds the cosine between surface normal and ray per metre of distance, "
                       "multiplied by the stride of the frames",
            .min = 0.0,
            .max = 1e6,
            .origin = Origin::kGuessed,
            .source = "a few frames: flying pixels have less"});
  f.Number("island_share", island_share,
           {.meaning = "pieces with less than this share of the largest piece's area are dropped",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "a hand has 0.02 of a body's surface"});
}

void ScanFusionSettings::Describe(Fields& f) {
  f.Section("volume", volume, {.meaning = "the volume of signed distances"});
  f.Section("smoothing", smoothing, {.meaning = "bilateral filter of the depth before alignment"});
  f.Section("alignment", alignment, {.meaning = "alignment of each frame with the model by ICP"});
  f.Section("loss", loss, {.meaning = "conditions under which the camera counts as lost"});
  f.Section("surface", surface, {.meaning = "how the surface is extracted and cleaned"});
  f.Integer("stride", stride,
            {.meaning = "use every n-th frame and skip the others",
             .min = 1,
             .max = 1000,
             .origin = Origin::kPaper,
             .source = "KF uses every frame"});
  f.Integer("threads", threads,
            {.meaning = "number of threads; the result does not depend on it",
             .min = 1,
             .max = 64,
             .origin = Origin::kGuessed,
             .source = "two cores"});
}

}  // namespace vitruvia
