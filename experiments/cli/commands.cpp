#include "experiments/cli/commands.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/build_info.h"
#include "core/error.h"
#include "core/files.h"
#include "core/message.h"
#include "core/progress.h"
#include "core/write_failure.h"
#include "experiments/cli/argument_checks.h"
#include "experiments/cli/compare_command.h"
#include "experiments/cli/explain_command.h"
#include "experiments/cli/export_command.h"
#include "experiments/cli/import_command.h"
#include "experiments/cli/index_command.h"
#include "experiments/cli/learn_command.h"
#include "experiments/cli/learn_joints_command.h"
#include "experiments/cli/learn_shape_command.h"
#include "experiments/cli/regress_command.h"
#include "experiments/cli/report_command.h"
#include "experiments/cli/reproduce_command.h"
#include "experiments/cli/rescore_command.h"
#include "experiments/cli/rig_command.h"
#include "experiments/cli/run_command.h"
#include "experiments/cli/run_one_command.h"
#include "experiments/cli/scan_command.h"
#include "experiments/cli/schema_command.h"
#include "experiments/cli/status_command.h"
#include "experiments/cli/subject_command.h"
#include "experiments/cli/submit_command.h"
#include "experiments/cli/sufficient_command.h"
#include "experiments/cli/synth_command.h"
#include "experiments/cli/track_command.h"
#include "experiments/cli/verify_command.h"
#include "experiments/cli/view_command.h"
#include "experiments/plan/run_plan.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 success, 1 internal error, 2 bad configuration or arguments, 3 bad data, "
    "4 failed run or output not writable, 5 accuracy regressed, 6 speed regressed, 7 nothing "
    "measured, 8 too many failed frames, 9 processor without the needed instructions, "
    "130 interrupted.";

std::string VersionText() {
  const BuildInfo& build = GetBuildInfo();
  return fmt::format(
      "vitruvia {}\ncommit:    {}\ncompiler:  {}\nbuild:     {}\nflags:     {}\nlibraries: {}",
      build.version, build.commit, build.compiler, build.build_type, build.flags, build.libraries);
}

void PrintConfigs(const fs::path& folder) {
  std::vector<std::string> files;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() == ".json") files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) fmt::print("  {}\n", file);
  if (files.empty()) fmt::print("  none: there is no folder {} here\n", folder.string());
}

void List() {
  fmt::print("methods:\n");
  for (const MethodInfo& method : Methods())
    fmt::print("  {:<16} {}\n", method.name, method.description);
  fmt::print("config files:\n");
  PrintConfigs("configs");
}

// Every argument of every command refuses an empty text.
void RefuseEmptyArguments(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_items_expected_max() > 0) option->check(NotEmpty());
  }
  for (CLI::App* command : app.get_subcommands({})) RefuseEmptyArguments(*command);
}

void AddCommands(CLI::App& app) {
  app.set_version_flag("--version", VersionText());
  app.require_subcommand(0, 1);  // CLI11's own demand for one would hide a misspelt command's name
  app.footer(kExitCodes);

  app.add_subcommand("list", "List methods and config files")->callback(List);

  AddSynthCommand(app);
  AddVerifyCommand(app);
  AddTrackCommand(app);
  AddRunCommand(app);
  AddRunOneCommand(app);
  AddStatusCommand(app);
  AddSubmitCommand(app);
  AddSufficientCommand(app);
  AddReproduceCommand(app);
  AddRescoreCommand(app);
  AddViewCommand(app);
  AddExportCommand(app);
  AddImportCommand(app);
  AddReportCommand(app);
  AddIndexCommand(app);
  AddCompareCommand(app);
  AddRegressCommand(app);
  AddSchemaCommand(app);
  AddLearnCommand(app);
  AddScanCommand(app);
  AddFitCommand(app);
  AddStandInJointsCommand(app);
  AddRigCommand(app);
  AddSubjectCommand(app);
  AddExplainCommand(app);
  RefuseEmptyArguments(app);
}

}  // namespace

int RunCommandLine(int argc, const char* const* argv) {
  // Whole lines, so that standard output and standard error can go to one file.
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  std::signal(SIGINT, [](int) { RequestInterrupt(); });
  std::signal(SIGTERM, [](int) { RequestInterrupt(); });
  std::signal(SIGXFSZ, SIG_IGN);  // a file that must not grow is an error that is told
  CLI::App app("Measures how well and how fast a human body can be tracked from one depth camera.",
               "vitruvia");
  try {
    AddCommands(app);
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) {
      throw ConfigError(
          "expected a command: list, synth, import, verify, learn, scan, fit, rig, subject, track, "
          "run, status, submit, rescore, view, export, report, index, compare, sufficient, "
          "reproduce, regress, "
          "schema or explain (--help)");
    }
    if (std::fflush(stdout) != 0) FailToWrite("standard output", errno);
    return static_cast<int>(ExitCode::kSuccess);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::RuntimeError& error) {  // the run's own process has written the details to
                                              // its folder
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return static_cast<int>(ExitCode::kBadConfiguration);
  } catch (const Error& error) {
    PrintMessage("vitruvia: {}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const fs::filesystem_error& error) {
    PrintMessage("vitruvia: {}: {}\n", error.path1().string(), error.code().message());
    return static_cast<int>(ExitCode::kFailedRun);
  } catch (const std::system_error& error) {  // fmt's, of the only stream that is printed to
    PrintMessage("vitruvia: standard output: {}\n", error.code().message());
    return static_cast<int>(ExitCode::kFailedRun);
  } catch (const std::exception& error) {
    PrintMessage("vitruvia: internal error: {}\n", error.what());
    return static_cast<int>(ExitCode::kInternalError);
  }
}

}  // namespace vitruvia
