#include "importers/depth_import_settings.h"

namespace vitruvia {

void StatedCamera::Describe(Fields& f) {
  f.Integer("width", width,
            {.meaning = "width of the stored images",
             .unit = "px",
             .min = 1,
             .max = 1 << 15,
             .required = true});
  f.Integer("height", height,
            {.meaning = "height of the stored images",
             .unit = "px",
             .min = 1,
             .max = 1 << 15,
             .required = true});
  f.Number(
      "fx", fx,
      {.meaning = "focal length in x", .unit = "px", .min = 1.0, .max = 1e6, .required = true});
  f.Number(
      "fy", fy,
      {.meaning = "focal length in y", .unit = "px", .min = 1.0, .max = 1e6, .required = true});
  f.Number(
      "cx", cx,
      {.meaning = "principal point, x", .unit = "px", .min = -1e6, .max = 1e6, .required = true});
  f.Number(
      "cy", cy,
      {.meaning = "principal point, y", .unit = "px", .min = -1e6, .max = 1e6, .required = true});
}

void FrameRange::Describe(Fields& f) {
  f.Integer("first", first, {.meaning = "first frame used", .min = 0, .max = 1e6});
  f.Integer("count", count,
            {.meaning = "number of frames used; 0: all that follow", .min = 0, .max = 1e6});
}

void EmptyFrames::Describe(Fields& f) {
  f.File("images", images,
         {.meaning = "folder or list of images without a person, as `images`; without it frames of "
                     "the recording itself"});
  f.Integer("first", first, {.meaning = "first frame without a person", .min = 0, .max = 1e6});
  f.Integer(
      "count", count,
      {.meaning = "number of frames without a person; 0: all that follow", .min = 0, .max = 1e6});
}

void DepthImportSettings::Describe(Fields& f) {
  f.Text("title", title, {.meaning = "what the recording shows"});
  f.File("images", images,
         {.meaning = "folder of depth images (.png, .pgm, .tif, .exr) or organised point clouds "
                     "(.pcd) in the order of their names, or a list with lines \"seconds path\"",
          .required = true});
  f.Section(
      "camera", camera,
      {.meaning = "intrinsics of the stored images, before they are oriented", .required = true});
  f.Number("unit_m", unit_m,
           {.meaning = "unit of the stored values, in metres: 0.001 for millimetres, 1 for metres "
                       "and point clouds, 0.0002 for the TUM RGB-D benchmark",
            .unit = "m",
            .min = 1e-7,
            .max = 1e3});
  f.NumberList(
      "invalid", invalid,
      {.meaning =
           "stored values that are not measurements, besides 0, negative and non-finite ones"});
  f.Section("orientation", orientation,
            {.meaning = "cropping, mirroring, rotation and resizing of the images, in this order; "
                        "the intrinsics are adapted"});
  f.Section("frames", frames, {.meaning = "the part of the recording that is used"});
  f.Choice("missing_frames", missing_frames,
           {{"empty", MissingFrames::kEmpty}, {"skip", MissingFrames::kSkip}},
           {.meaning = "replacement of frames that are skipped by the numbers in file names or by "
                       "time stamps: images without measurements, or nothing"});
  f.Number("fps", fps,
           {.meaning = "frames per second; 0: from the time stamps, or 30 without them",
            .unit = "1/s",
            .min = 0.0,
            .max = 1e4});
  f.Section("empty_frames", empty_frames,
            {.meaning = "frames without a person, for cutout.background.source empty_frames"});
  f.Section("cutout", cutout, {.meaning = "how the person is cut out"});
  f.File(
      "subject", subject,
      {.meaning = "folder of the person's template: mesh.ply, subject.json, weights.bin; without "
                  "it the sequence has no subject, and whoever tracks it has to name one"});
  f.Number("depth_unit_m", depth_unit_m,
           {.meaning = "step of the sequence's depth", .unit = "m", .min = 1e-6, .max = 0.1});
}

std::string DepthImportSettings::Problem() const {
  if (const std::string problem = CropProblem(orientation.crop, camera.width, camera.height);
      camera.width > 0 && !problem.empty())
    return problem;
  const bool wants_empty = cutout.background.source == BackgroundSource::kEmptyFrames;
  const bool names_empty = !empty_frames.images.empty() || empty_frames.count > 0;
  if (wants_empty && !names_empty)
    return "cutout.background.source is empty_frames, but empty_frames names neither images nor a "
           "count of frames";
  return "";
}

}  // namespace vitruvia
