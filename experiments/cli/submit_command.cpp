#include "experiments/cli/submit_command.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "core/files.h"
#include "experiments/run/child_process.h"
#include "experiments/run/experiment_files.h"
#include "experiments/studies/planned_experiment.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr int kMostShards = 1000;  // Slurm's own limit unless it is configured otherwise
constexpr int kDefaultShards = 8;
constexpr int kMostJobsOfTask = 1024;
constexpr std::chrono::milliseconds kAskSbatchAfter{20};

constexpr const char* kSubmitFooter =
    "Each task carries out one shard. All share one output folder, which every node must see and\n"
    "lock files on (a local disk, NFS 4). Timed runs wait for other runs of vitruvia on their "
    "node;\n"
    "to keep other programs away too: --sbatch=--exclusive.\n"
    "vitruvia status and vitruvia report work on the runs that are done; submitting again goes "
    "on.\n"
    "The same shards without a cluster:\n"
    "  parallel vitruvia run X.json --shard {}/8 ::: $(seq 8)       (GNU parallel)\n"
    "  seq 8 | xargs -P 8 -I{} vitruvia run X.json --shard {}/8     (xargs)\n"
    "  shard-%: ; vitruvia run X.json --shard $*/8                  (a rule for make -j 8)";

struct SubmitArguments {
  fs::path experiment, output;
  int shards = kDefaultShards, jobs = 1;
  std::vector<std::string> sbatch_options;
  bool print = false;
};

// One word of an #SBATCH line. Slurm itself reads these lines: it knows both quotes and, inside
// them too, the backslash; # begins a comment.
std::string SlurmQuoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

// Slurm replaces patterns such as %A in the names of log files; %% stands for one %.
std::string WithoutPatterns(const std::string& path) {
  std::string escaped;
  for (const char c : path) {
    escaped += c;
    if (c == '%') escaped += c;
  }
  return escaped;
}

// As one word of a POSIX shell.
std::string ShellQuoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

fs::path ThisProgram() { return fs::read_symlink("/proc/self/exe"); }

// One command line for every task: the array's index is the shard.
std::string TaskCommand(const SubmitArguments& arguments, int shards) {
  std::string command = fmt::format("exec {} run {}", ShellQuoted(ThisProgram().string()),
                                    ShellQuoted(arguments.experiment.string()));
  if (!arguments.output.empty())
    command += fmt::format(" -o {}", ShellQuoted(arguments.output.string()));
  if (arguments.jobs > 1) command += fmt::format(" -j {}", arguments.jobs);
  return command + fmt::format(" --shard \"$SLURM_ARRAY_TASK_ID/{}\"", shards);
}

std::string SubmitScript(const SubmitArguments& arguments, const PlannedExperiment& plan,
                         int shards) {
  std::vector<std::string> options = {
      "--job-name=vitruvia", fmt::format("--array=1-{}", shards),
      fmt::format("--cpus-per-task={}", arguments.jobs),
      fmt::format("--chdir={}", SlurmQuoted(fs::current_path().string())),
      fmt::format("--output={}", SlurmQuoted(WithoutPatterns(fs::absolute(plan.folder).string()) +
                                             "/slurm-%A_%a.log"))};
  options.insert(options.end(), arguments.sbatch_options.begin(), arguments.sbatch_options.end());
  std::string script = "#!/bin/sh\n";
  for (const std::string& option : options) script += fmt::format("#SBATCH {}\n", option);
  return script + TaskCommand(arguments, shards) + "\n";
}

// A backslash in a log's path makes Slurm ignore the patterns; a line end would end an #SBATCH
// line.
void RequirePathForSlurm(const fs::path& path) {
  if (path.string().find_first_of("\n\\") == std::string::npos) return;
  throw ConfigError(fmt::format(
      "submit: {}: expected a path without backslashes and line ends, which Slurm cannot use",
      path.string()));
}

// Options are copied as they are: Slurm reads them without a shell.
void RequireOneLine(const std::vector<std::string>& options) {
  for (const std::string& option : options) {
    if (option.starts_with('-') && option.find('\n') == std::string::npos) continue;
    throw ConfigError(fmt::format(
        "submit: --sbatch {}: expected an option of sbatch, such as --time=1:00:00", option));
  }
}

int CallSbatch(const fs::path& script) {
  ChildProcesses sbatch;
  try {
    sbatch.Start(0, {"sbatch", {script.string()}, {}, {}});
  } catch (const RunError& error) {
    throw RunError(
        fmt::format("submit: {} (is Slurm installed?); the script is {}, and --print prints it",
                    error.what(), script.string()));
  }
  std::vector<ChildProcesses::End> ended;
  while ((ended = sbatch.TakeEnded()).empty()) std::this_thread::sleep_for(kAskSbatchAfter);
  return ended[0].code;
}

void Submit(const SubmitArguments& arguments) {
  RequireOneLine(arguments.sbatch_options);
  RequirePathForSlurm(fs::current_path());
  const PlannedExperiment plan = PlanForOutput(arguments.experiment, arguments.output);
  RequirePathForSlurm(plan.folder);
  const int shards = std::min(arguments.shards, static_cast<int>(plan.experiment.runs.size()));
  const std::string script = SubmitScript(arguments, plan, shards);
  if (arguments.print) {
    fmt::print("{}", script);
    return;
  }
  WritePlan(plan.experiment, plan.file, plan.folder);
  const fs::path file = plan.folder / "submit.sbatch";
  WriteWholeFile(file, script);
  if (CallSbatch(file) != 0)
    throw RunError(
        fmt::format("submit: sbatch refused {} (its reason stands above)", file.string()));
  fmt::print("{} runs in {} tasks; vitruvia status {} tells their state\n",
             plan.experiment.runs.size(), shards, plan.folder.string());
}

}  // namespace

void AddSubmitCommand(CLI::App& app) {
  auto a = std::make_shared<SubmitArguments>();
  CLI::App* submit = app.add_subcommand(
      "submit", "Run an experiment on a Slurm cluster, as a job array of shards");
  submit->add_option("EXPERIMENT", a->experiment, "experiment file")->required();
  submit->add_option("-o,--output", a->output, "the experiment's folder; without it out/NAME");
  submit
      ->add_option("--shards", a->shards, "number of tasks in the array, at most one for each run")
      ->check(CLI::Range(1, kMostShards))
      ->capture_default_str();
  submit
      ->add_option("-j,--jobs", a->jobs,
                   "number of runs at a time in each task, and of its processors")
      ->check(CLI::Range(1, kMostJobsOfTask))
      ->capture_default_str();
  submit->add_option("--sbatch", a->sbatch_options,
                     "an option for sbatch, such as --sbatch=--time=1:00:00; can be repeated");
  submit->add_flag("--print", a->print, "only print the script");
  submit->footer(kSubmitFooter);
  submit->callback([a] { Submit(*a); });
}

}  // namespace vitruvia
