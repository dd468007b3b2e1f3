#include "experiments/cli/verify_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "verification/verification.h"

namespace vitruvia {
namespace fs = std::filesystem;

void VerifyStored(const fs::path& folder) {
  VerifySequence(folder);
  const std::size_t warnings =
      RequireConsistent(SequenceReader(folder), FrameSelection::kAll, folder).size();
  fmt::print("{}: complete and consistent{}\n", folder.string(),
             warnings == 0 ? "" : fmt::format(", with {} warnings", warnings));
}

void AddVerifyCommand(CLI::App& app) {
  auto folder = std::make_shared<fs::path>();
  CLI::App* verify = app.add_subcommand(
      "verify",
      "Check a sequence: files are intact, and depth, camera, truth and subject are consistent");
  verify->add_option("SEQ", *folder, "folder of the sequence")->required();
  verify->callback([folder] { VerifyStored(*folder); });
}

}  // namespace vitruvia
