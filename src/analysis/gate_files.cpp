#include "analysis/gate_files.h"

#include <algorithm>

#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// Up to version 1, runs held times as multiples of the calibration kernel's time, which are not
// comparable across machines.
void RemoveCalibratedTimes(Json& file) {
  if (!file.is_object() || !file.contains("runs") || !file["runs"].is_array()) return;
  for (Json& run : file["runs"]) {
    if (!run.is_object()) continue;
    for (const char* key : {"speed", "speed_noise", "calibration_ms"}) run.erase(key);
  }
}

// history.json.
struct HistoryFile {
  static constexpr StoredFormat kFormat{"vitruvia-history", 2, 0, "remove the file"};

  std::vector<HistoryEntry> entries;

  void Describe(Fields& f) {
    f.List("entries", entries, {.meaning = "what the gate measured, oldest first"});
  }
  // Version 0 was the list itself; until version 1 the machine was not kept.
  static void Upgrade(Json& file, int /*version*/) {
    if (file.is_array()) file = Json{{"entries", file}};
    if (!file.is_object() || !file.contains("entries") || !file["entries"].is_array()) return;
    for (Json& entry : file["entries"]) {
      RemoveCalibratedTimes(entry);
      if (entry.is_object()) entry.emplace("cpu", "unknown");
    }
  }
};

void MakeParentFolder(const fs::path& file) {
  if (!file.parent_path().empty()) MakeFolder(file.parent_path());
}

}  // namespace

void Renewal::Describe(Fields& f) {
  f.Text("date", date, {.meaning = "when the baseline was renewed"});
  f.Text("commit", commit, {.meaning = "commit of the program that was measured"});
  f.Text("reason", reason, {.meaning = "why the baseline was renewed"});
}

void GateBaseline::Describe(Fields& f) {
  f.Text("date", date, {.meaning = "date of the last renewal"});
  f.Text("commit", commit, {.meaning = "commit of the program at the last renewal"});
  f.Text("cpu", cpu, {.meaning = "CPU of the last renewal"});
  f.List("renewals", renewals, {.meaning = "all renewals, oldest first"});
  f.List("runs", runs, {.meaning = "numbers that later runs are compared with"});
}

void HistoryEntry::Describe(Fields& f) {
  f.Text("date", date, {.meaning = "when the gate measured"});
  f.Text("commit", commit, {.meaning = "commit of the program that was measured"});
  f.Text("cpu", cpu, {.meaning = "CPU on which the gate measured"});
  f.Integer("exit_code", exit_code, {.meaning = "exit code of the gate"});
  f.List("runs", runs, {.meaning = "numbers that were measured"});
}

void GateBaseline::Upgrade(Json& file, int /*version*/) { RemoveCalibratedTimes(file); }

GateBaseline ReadBaseline(const fs::path& file) {
  if (!fs::exists(file)) {
    throw ConfigError(
        fmt::format("{}: there is no baseline; --update --reason TEXT takes one", file.string()));
  }
  return ReadStored<GateBaseline>(file);
}

void WriteBaseline(const fs::path& file, const GateBaseline& baseline) {
  MakeParentFolder(file);
  WriteStored(file, baseline);
}

std::vector<HistoryEntry> ReadHistory(const fs::path& file) {
  if (!fs::exists(file)) return {};
  return ReadStored<HistoryFile>(file).entries;
}

void WriteHistory(const fs::path& file, const std::vector<HistoryEntry>& history) {
  MakeParentFolder(file);
  HistoryFile stored{history};
  for (HistoryEntry& entry : stored.entries) {
    for (GatedRun& run : entry.runs) run.settings.clear();
  }
  WriteStored(file, stored);
}

}  // namespace vitruvia
