#include "experiments/cli/schema_command.h"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/files.h"
#include "experiments/cli/config_kinds.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct SchemaArguments {
  std::string kind;
  fs::path output;
};

void WriteSchemas(const fs::path& folder, const std::string& only) {
  MakeFolder(folder);
  for (const ConfigKind& kind : ConfigKinds()) {
    if (!only.empty() && kind.name != only) continue;
    const fs::path file = folder / (kind.name + ".schema.json");
    WriteWholeFile(file, SchemaOf(kind).dump(2) + "\n");
    fmt::print("{}\n", file.string());
  }
}

void PrintSchemas(const SchemaArguments& a) {
  if (!a.kind.empty()) FindConfigKind(a.kind);  // or it is an error
  if (!a.output.empty()) return WriteSchemas(a.output, a.kind);
  if (!a.kind.empty()) {
    fmt::print("{}\n", SchemaOf(FindConfigKind(a.kind)).dump(2));
    return;
  }
  for (const ConfigKind& kind : ConfigKinds()) fmt::print("{:<18} {}\n", kind.name, kind.meaning);
}

}  // namespace

void AddSchemaCommand(CLI::App& app) {
  const auto a = std::make_shared<SchemaArguments>();
  CLI::App* schema = app.add_subcommand(
      "schema", "Print the JSON Schema of a kind of config file; without KIND list the kinds");
  schema->add_option("KIND", a->kind, "scene, method, experiment, …");
  schema->add_option("-o,--output", a->output,
                     "write KIND.schema.json, or those of all kinds, here");
  schema->callback([a] { PrintSchemas(*a); });
}

}  // namespace vitruvia
