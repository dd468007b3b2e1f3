#include "experiments/studies/held_out_people.h"

#include "core/error.h"

namespace vitruvia {

void RequireEnoughHeldOut(int people, const LearningSettings& learning,
                          const std::filesystem::path& experiment_file) {
  if (people <= learning.held_out) return;
  throw ConfigError(fmt::format("{}: people: expected at most the {} held-out subjects, got {}",
                                experiment_file.string(), learning.held_out, people));
}

}  // namespace vitruvia
