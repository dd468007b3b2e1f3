// A quick look at a scene.
#pragma once

#include <string>
#include <vector>

#include "synth/scene/scene.h"

namespace vitruvia {

struct PreviewFrame {
  int frame = 0;
  double time_s = 0.0;
  DepthImage depth;  // as the sensor delivers it
  MaskImage body;    // where the person is seen
};

struct ScenePreview {
  std::vector<PreviewFrame> frames;
  std::vector<std::string> warnings;
};

// So many frames of the scene (or all, if it has fewer), the first, the last and between them at
// equal distances.
ScenePreview PreviewScene(const SceneSettings& settings, int count);

}  // namespace vitruvia
