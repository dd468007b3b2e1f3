#include "experiments/cli/known_person.h"

#include <CLI/CLI.hpp>

#include "experiments/cli/argument_checks.h"

namespace vitruvia {

KnownAttributes PersonOptions::Known() const {
  KnownAttributes known{height_m, weight_kg, {}};
  if (!sex.empty()) known.sex = sex == "male" ? Sex::kMale : Sex::kFemale;
  return known;
}

void AddPersonOptions(CLI::App& command, PersonOptions& person) {
  command.add_option("--height", person.height_m, "the person's height, m, if known")
      ->check(NumberIn(0.6, 2.5));
  command.add_option("--weight", person.weight_kg, "the person's weight, kg, if known")
      ->check(NumberIn(5.0, 300.0));
  command.add_option("--sex", person.sex, "female or male, if known")
      ->check(CLI::IsMember({"female", "male"}));
}

}  // namespace vitruvia
