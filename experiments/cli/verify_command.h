// vitruvia verify SEQ
#pragma once

#include <filesystem>

namespace CLI {
class App;
}

namespace vitruvia {

void AddVerifyCommand(CLI::App& app);

// Decodes a whole sequence and checks the consistency of its parts. Prints warnings; DataError with
// the first error.
void VerifyStored(const std::filesystem::path& folder);

}  // namespace vitruvia
