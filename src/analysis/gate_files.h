// The regression gate's files: the baseline that runs are compared with, and the history of what
// was measured.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/gated_run.h"

namespace vitruvia {

struct Renewal {
  std::string date, commit, reason;

  void Describe(Fields& fields);
};

struct GateBaseline {
  static constexpr StoredFormat kFormat{"vitruvia-baseline", 2, 0,
                                        "take a baseline anew: --update --reason TEXT"};

  std::string date, commit, cpu;  // of the last renewal
  std::vector<Renewal> renewals;  // all renewals, oldest first
  std::vector<GatedRun> runs;

  void Describe(Fields& fields);
  static void Upgrade(Json& file, int version);
};

// ConfigError with instructions to take a baseline if the file is missing; DataError if it is
// damaged.
GateBaseline ReadBaseline(const std::filesystem::path& file);
void WriteBaseline(const std::filesystem::path& file, const GateBaseline& baseline);

// Result of one run of the gate.
struct HistoryEntry {
  std::string date, commit, cpu;
  int exit_code = 0;
  std::vector<GatedRun> runs;

  void Describe(Fields& fields);
};

// Oldest first; empty if there is no file. DataError if it is damaged.
std::vector<HistoryEntry> ReadHistory(const std::filesystem::path& file);
void WriteHistory(const std::filesystem::path& file, const std::vector<HistoryEntry>& history);

}  // namespace vitruvia
