// Previews of a scene.
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

// `count` evenly spaced frames of the scene, including the first and the last; all if it has fewer.
ScenePreview PreviewScene(const SceneSettings& settings, int count);

}  // namespace vitruvia
