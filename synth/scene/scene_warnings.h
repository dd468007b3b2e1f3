// What somebody who reads a scene's sequence should know.
#pragma once

#include <string>
#include <vector>

#include "synth/scene/stage.h"

namespace vitruvia {

// Of the motion's file; of a scene that goes on when its motion has ended; of a first frame in
// which a tracker does not see the whole person and nothing else.
std::vector<std::string> SceneWarnings(const SceneSettings& settings, const Motion& motion,
                                       Stage& stage);

}  // namespace vitruvia
