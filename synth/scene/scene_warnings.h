// Warnings for users of a scene's sequence.
#pragma once

#include <string>
#include <vector>

#include "synth/scene/stage.h"

namespace vitruvia {

// Warnings about the motion's file, about a scene that is longer than its motion, and about a first
// frame that does not show the whole person and nothing else.
std::vector<std::string> SceneWarnings(const SceneSettings& settings, const Motion& motion,
                                       Stage& stage);

}  // namespace vitruvia
