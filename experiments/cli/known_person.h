// Options for the known attributes of a person: --height, --weight, --sex.
#pragma once

#include <string>

#include "learning/shape/sized_body.h"

namespace CLI {
class App;
}

namespace vitruvia {

struct PersonOptions {
  std::optional<double> height_m, weight_kg;
  std::string sex;  // "" if not known

  KnownAttributes Known() const;
};
void AddPersonOptions(CLI::App& command, PersonOptions& person);

}  // namespace vitruvia
