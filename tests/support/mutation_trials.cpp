#include "support/mutation_trials.h"

#include <algorithm>
#include <fcntl.h>
#include <set>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.h"
#include "core/files.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kOutput = "out";

// Readers print warnings, thousands of times.
class QuietStandardError {
 public:
  QuietStandardError() : kept_(dup(STDERR_FILENO)) {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }
  ~QuietStandardError() {
    dup2(kept_, STDERR_FILENO);
    close(kept_);
  }
  QuietStandardError(const QuietStandardError&) = delete;
  QuietStandardError& operator=(const QuietStandardError&) = delete;

 private:
  int kept_;
};

std::set<std::string> ContentsOf(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.insert(entry.path().lexically_relative(folder).string());
  return names;
}

struct Trial {
  MutantOutcome outcome = MutantOutcome::kDefect;
  std::string problem;  // of a defect
};

Trial JudgeRefusal(const Error& error, const fs::path& folder) {
  const std::string text = error.what();
  const bool is_documented =
      error.code() == ExitCode::kBadConfiguration || error.code() == ExitCode::kBadData;
  if (!is_documented)
    return {MutantOutcome::kDefect, fmt::format("exit code {}: {}", int(error.code()), text)};
  if (text.find(folder.string()) == std::string::npos)
    return {MutantOutcome::kDefect, "the message names no file: " + text};
  return {MutantOutcome::kRefused, ""};
}

Trial JudgeReading(const Reading& read, const Reading& whole, Change change) {
  if (read.meaning == whole.meaning) return {MutantOutcome::kSame, ""};
  const bool is_told =
      std::any_of(read.warnings.begin(), read.warnings.end(), [&](const std::string& warning) {
        return std::find(whole.warnings.begin(), whole.warnings.end(), warning) ==
               whole.warnings.end();
      });
  if (is_told) return {MutantOutcome::kTold, ""};
  if (change == Change::kStatement) return {MutantOutcome::kStatement, ""};
  return {MutantOutcome::kDefect, "read without a word, as something else"};
}

Trial Try(const MutatedFormat& format, const fs::path& folder, const Reading& whole,
          Change change) {
  try {
    const QuietStandardError quiet;
    return JudgeReading(format.read(folder), whole, change);
  } catch (const Error& error) {
    return JudgeRefusal(error, folder);
  } catch (const std::exception& error) {
    return {MutantOutcome::kDefect, fmt::format("no error of ours: {}", error.what())};
  }
}

}  // namespace

const char* Name(MutantOutcome outcome) {
  switch (outcome) {
    case MutantOutcome::kRefused:
      return "refused";
    case MutantOutcome::kSame:
      return "same";
    case MutantOutcome::kTold:
      return "told";
    case MutantOutcome::kStatement:
      return "statement";
    case MutantOutcome::kDefect:
      break;
  }
  return "defect";
}

TrialReport TryMutants(const MutatedFormat& format, int first, int count, std::uint64_t seed,
                       const std::function<void(const std::string& mutant)>& begin) {
  const TemporaryFolder temporary;
  const fs::path folder = temporary / "files";
  fs::create_directory(folder);
  format.write(folder);
  const auto read_whole = [&] {
    const QuietStandardError quiet;
    return format.read(folder);
  };
  const Reading whole = read_whole();
  fs::remove_all(folder / kOutput);
  const std::set<std::string> contents = ContentsOf(folder);

  TrialReport report{format.name, {}, {}};
  for (int number = first; number < first + count; ++number) {
    const std::string name = fmt::format("{}/{}", format.name, number);
    begin(name);
    RandomStream random(seed, name);
    const std::string& file = format.files[random.Index(format.files.size())];
    const std::string content = ReadWholeFile(folder / file);
    const Mutant mutant = format.mutate(file, content, random);
    WriteWholeFile(folder / file, mutant.content);
    Trial trial = Try(format, folder, whole, mutant.change);
    if (trial.outcome != MutantOutcome::kRefused) fs::remove_all(folder / kOutput);
    if (ContentsOf(folder) != contents) trial = {MutantOutcome::kDefect, "files are left behind"};
    ++report.counts[trial.outcome];
    if (trial.outcome == MutantOutcome::kDefect)
      report.defects.push_back(
          fmt::format("{}: {}: {}: {}", name, file, mutant.what, trial.problem));
    fs::remove_all(folder / kOutput);
    WriteWholeFile(folder / file, content);
  }
  return report;
}

}  // namespace vitruvia
