// Held-out people for the tests of a study.
#pragma once

#include <filesystem>

#include "subjects/learned_model.h"

namespace vitruvia {

// ConfigError naming the experiment file if it asks for more people than are held out.
void RequireEnoughHeldOut(int people, const LearningSettings& learning,
                          const std::filesystem::path& experiment_file);

}  // namespace vitruvia
