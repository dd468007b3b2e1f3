// Records a scene with given bodies and motion.
#pragma once

#include <filesystem>

#include "synth/scene/scene.h"

namespace vitruvia {

// Moves `truth`, renders and measures it as `settings` say, and writes the sequence. `subject` is
// the template that is stored with it. Settings of the body, the motion and the refinements are
// only stored in the provenance.
void RecordSequence(const SceneSettings& settings, const BodyModel& truth, const BodyModel& subject,
                    const Motion& motion, const std::filesystem::path& folder);

}  // namespace vitruvia
