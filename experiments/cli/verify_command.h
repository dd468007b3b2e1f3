// vitruvia verify SEQ
#pragma once

#include <filesystem>

namespace CLI {
class App;
}

namespace vitruvia {

void AddVerifyCommand(CLI::App& app);

// Decodes a whole sequence and holds its parts against each other. Prints warnings; DataError with
// the first thing that cannot be true.
void VerifyStored(const std::filesystem::path& folder);

}  // namespace vitruvia
