#include "experiments/cli/index_command.h"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "reports/pages/index_page.h"

namespace vitruvia {

void AddIndexCommand(CLI::App& app) {
  const auto folder = std::make_shared<std::filesystem::path>("out");
  CLI::App* index =
      app.add_subcommand("index", "Write one page about all experiments of an output folder");
  index->add_option("DIR", *folder, "the folder of experiments; out without");
  index->callback([folder] { fmt::print("index: {}\n", WriteIndex(*folder).string()); });
}

}  // namespace vitruvia
