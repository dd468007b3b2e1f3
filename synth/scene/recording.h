// The recording of a scene whose bodies and motion are already there.
#pragma once

#include <filesystem>

#include "synth/scene/scene.h"

namespace vitruvia {

// Moves `truth`, renders and measures it as `settings` say, and writes the sequence. `subject` is
// the template that goes with it. Settings of the body, the motion and the refinements are only
// noted in the provenance.
void RecordSequence(const SceneSettings& settings, const BodyModel& truth, const BodyModel& subject,
                    const Motion& motion, const std::filesystem::path& folder);

}  // namespace vitruvia
