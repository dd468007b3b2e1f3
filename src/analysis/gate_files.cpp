#include "analysis/gate_files.h"

#include <algorithm>

#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr int kGateIndent = 1;

nlohmann::json RunsToJson(const std::vector<GatedRun>& runs) {
  nlohmann::json list = nlohmann::json::array();
  for (const GatedRun& run : runs) list.push_back(ToJson(run));
  return list;
}

Renewal ParseRenewal(const JsonNode& node) {
  return {node.At("date").Text(), node.At("commit").Text(), node.At("reason").Text()};
}

HistoryEntry ParseEntry(const JsonNode& node) {
  return {node.At("date").Text(), node.At("commit").Text(), node.At("exit_code").Integer(),
          node.At("runs").List(ParseGatedRun)};
}

void WriteJson(const fs::path& file, const nlohmann::json& json) {
  if (!file.parent_path().empty()) MakeFolder(file.parent_path());
  WriteWholeFile(file, json.dump(kGateIndent) + "\n");
}

}  // namespace

const GatedRun* GateBaseline::Find(const std::string& run_name) const {
  const auto found = std::find_if(runs.begin(), runs.end(),
                                  [&](const GatedRun& run) { return run.name() == run_name; });
  return found == runs.end() ? nullptr : &*found;
}

GateBaseline ReadBaseline(const fs::path& file) {
  if (!fs::exists(file)) {
    throw ConfigError(
        fmt::format("{}: there is no baseline; --update --reason TEXT takes one", file.string()));
  }
  const nlohmann::json json = ReadStoredJson(file);
  const JsonNode node(json, file.string());
  return {node.At("date").Text(), node.At("commit").Text(), node.At("cpu").Text(),
          node.At("renewals").List(ParseRenewal), node.At("runs").List(ParseGatedRun)};
}

void WriteBaseline(const fs::path& file, const GateBaseline& baseline) {
  nlohmann::json renewals = nlohmann::json::array();
  for (const Renewal& r : baseline.renewals)
    renewals.push_back({{"date", r.date}, {"commit", r.commit}, {"reason", r.reason}});
  WriteJson(file, {{"date", baseline.date},
                   {"commit", baseline.commit},
                   {"cpu", baseline.cpu},
                   {"renewals", renewals},
                   {"runs", RunsToJson(baseline.runs)}});
}

std::vector<HistoryEntry> ReadHistory(const fs::path& file) {
  if (!fs::exists(file)) return {};
  const nlohmann::json json = ReadStoredJson(file);
  return JsonNode(json, file.string()).List(ParseEntry);
}

void WriteHistory(const fs::path& file, const std::vector<HistoryEntry>& history) {
  nlohmann::json list = nlohmann::json::array();
  for (const HistoryEntry& entry : history) {
    list.push_back({{"date", entry.date},
                    {"commit", entry.commit},
                    {"exit_code", entry.exit_code},
                    {"runs", RunsToJson(entry.runs)}});
  }
  WriteJson(file, list);
}

}  // namespace vitruvia
