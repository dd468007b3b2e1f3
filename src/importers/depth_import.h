// Recordings of depth cameras made into sequences of ours: the person is cut out, and there is no
// truth.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cutout/cutout.h"
#include "geometry/camera.h"
#include "importers/depth_import_settings.h"

namespace vitruvia {

struct DepthImport {
  PinholeCamera camera;  // of the sequence
  double fps = 0.0;
  int frames = 0, missing = 0;
  std::vector<std::string> gaps;
  Room room;
  int people = 0;  // numbers given, one for each time that somebody came
  ChosenPerson chosen;
  CutoutReport cut;
};

// Writes the sequence (sequence/sequence.h) with masks and preview. The result is the same for any
// number of threads. DataError, and nothing written, if a file is damaged, the images are not of
// the stated camera, their depths are no metres of a room, nothing is measured or nobody is found.
DepthImport ImportDepthSequence(const DepthImportSettings& settings, int threads,
                                const std::filesystem::path& folder);

}  // namespace vitruvia
