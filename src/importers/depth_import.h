// Converts recordings of depth cameras to sequences: the person is segmented; there is no ground
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
  int people = 0;  // number of labels assigned, one each time that a person enters
  ChosenPerson chosen;
  CutoutReport cut;
};

// Writes the sequence (sequence/sequence.h) with masks and preview. The result is the same for any
// number of threads. DataError, and nothing is written, if a file is damaged, the images do not
// match the stated camera, their depths are implausible for a room, nothing is measured or nobody
// is found.
DepthImport ImportDepthSequence(const DepthImportSettings& settings, int threads,
                                const std::filesystem::path& folder);

}  // namespace vitruvia
