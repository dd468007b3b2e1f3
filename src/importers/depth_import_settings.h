// Settings of the import of a depth recording.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/settings.h"
#include "cutout/settings.h"
#include "geometry/camera.h"
#include "importers/depth_orientation.h"

namespace vitruvia {

// Intrinsics that the user has to state.
struct StatedCamera {
  int width = 0, height = 0;
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;

  PinholeCamera AsCamera() const { return {width, height, fx, fy, cx, cy}; }
  void Describe(Fields& fields);
};

enum class MissingFrames {
  kEmpty,  // each is replaced by an image without measurements, so that frames keep their times
  kSkip,   // they are skipped: the following frames move up
};

// Which part of the recording is used.
struct FrameRange {
  int first = 0;
  int count = 0;  // 0: all following frames

  void Describe(Fields& fields);
};

// Frames without a person, of the same camera in the same place.
struct EmptyFrames {
  std::filesystem::path images;  // "": frames of the recording itself
  int first = 0, count = 0;

  void Describe(Fields& fields);
};

struct DepthImportSettings {
  std::string title;
  std::filesystem::path images;
  StatedCamera camera;  // of the stored images
  double unit_m = 0.001;
  std::vector<double> invalid;
  OrientationSettings orientation;
  FrameRange frames;
  MissingFrames missing_frames = MissingFrames::kEmpty;
  double fps = 0.0;
  EmptyFrames empty_frames;
  CutoutSettings cutout;
  std::filesystem::path subject;  // "": none
  double depth_unit_m = 0.001;

  void Describe(Fields& fields);
  std::string Problem() const;
};

}  // namespace vitruvia
