// Whether a reader does right by damaged files: it refuses them, or gives what the whole file
// gives, or tells what it found. What no reader can know is a statement: a file that is whole and
// says something else.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "support/mutation.h"

namespace vitruvia {

// What a reader made of a folder of files.
struct Reading {
  std::string meaning;                // equal for equal content
  std::vector<std::string> warnings;  // that a user would see
};

struct MutatedFormat {
  std::string name;
  std::function<void(const std::filesystem::path& folder)> write;  // whole files
  std::vector<std::string> files;  // of these the ones that are mutated, relative to the folder
  std::function<Mutant(const std::string& file, const std::string& content, RandomStream& random)>
      mutate;
  // Reads as a user's command would; may write to folder / "out" only, whole or not at all.
  std::function<Reading(const std::filesystem::path& folder)> read;
};

enum class MutantOutcome {
  kRefused,    // by an error of ours that names the file or its folder
  kSame,       // read as the whole file
  kTold,       // read as something else, with a warning
  kStatement,  // read as something else, which it says
  kDefect,     // anything else
};
const char* Name(MutantOutcome outcome);

using OutcomeCounts = std::map<MutantOutcome, int>;

struct TrialReport {
  std::string format;
  OutcomeCounts counts;
  std::vector<std::string> defects;  // file, mutation and what came, for each
};

// Reads `count` mutants of the format in a folder of its own. Mutant n of a format and a seed is
// always the same; `first` is the number of the first one. `begin` is called with the name of each
// mutant before it is read.
TrialReport TryMutants(const MutatedFormat& format, int first, int count, std::uint64_t seed,
                       const std::function<void(const std::string& mutant)>& begin);

}  // namespace vitruvia
