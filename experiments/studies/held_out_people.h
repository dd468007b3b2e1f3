// The people that a study keeps for testing.
#pragma once

#include <filesystem>

#include "subjects/learned_model.h"

namespace vitruvia {

// ConfigError naming the experiment file if it asks for more people than are held out.
void RequireEnoughHeldOut(int people, const LearningSettings& learning,
                          const std::filesystem::path& experiment_file);

}  // namespace vitruvia
