#include "experiments/cli/learn_shape_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "core/files.h"
#include "geometry/mesh_io.h"
#include "subjects/fitted_subject.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kHeldOutFile = "held_out.json";

void LearnDatabase(const fs::path& config, const fs::path& output) {
  const BodyDatabase database = MakeDatabase(ReadLearningSettings(config).database);
  WriteBodyDatabase(output, database);
  fmt::print("{}: {} subjects of {} vertices, {} of them in {} poses\n", output.string(),
             database.subjects.size(), database.reference.rest.vertices.size(),
             database.examples.size(),
             database.examples.empty() ? 0 : database.examples.front().poses.size());
}

// 1, 2, 5, 10, 20, 50, … up to all components.
std::vector<int> ComponentCounts(int components) {
  std::vector<int> counts;
  for (int decade = 1; decade <= components; decade *= 10) {
    for (const int step : {1, 2, 5}) {
      if (step * decade < components) counts.push_back(step * decade);
    }
  }
  counts.push_back(components);
  return counts;
}

Json PrintedHeldOutErrors(const ShapeSpace& space, const BodyDatabase& database,
                          const std::vector<int>& held_out) {
  Json rows = Json::array();
  fmt::print("held-out subjects: {}\n{:>10} {:>9} {:>9} {:>9}\n", held_out.size(), "components",
             "mean mm", "p95 mm", "max mm");
  for (const HeldOutError& error :
       HeldOutErrors(space, database, held_out, ComponentCounts(space.components()))) {
    fmt::print("{:>10} {:>9.3f} {:>9.3f} {:>9.2f}\n", error.components, 1e3 * error.mean_m,
               1e3 * error.p95_m, 1e3 * error.max_m);
    rows.push_back({{"components", error.components},
                    {"mean_m", error.mean_m},
                    {"p95_m", error.p95_m},
                    {"max_m", error.max_m}});
  }
  return rows;
}

void LearnShape(const fs::path& config, const fs::path& database_folder, const fs::path& output) {
  const LearningSettings settings = ReadLearningSettings(config);
  BodyDatabase database;
  if (database_folder.empty()) {
    database = MakeDatabase(settings.database);
  } else {
    database = ReadBodyDatabase(database_folder);
    database.examples.push_back(ReadPoseExamples(database_folder, settings.weights_subject));
  }
  if (settings.held_out >= static_cast<int>(database.subjects.size())) {
    throw ConfigError(
        fmt::format("{}: held_out: expected fewer than the database's {} subjects, "
                    "got {}",
                    config.string(), database.subjects.size(), settings.held_out));
  }
  const LearnedModel model = LearnModel(database, settings);
  WriteShapeSpace(output, model.space);
  const Split split = SplitSubjects(database, settings.held_out);
  if (!split.held_out.empty()) {
    WriteWholeFile(output / kHeldOutFile,
                   PrintedHeldOutErrors(model.space, database, split.held_out).dump(2) + "\n");
  }
  fmt::print("{}\n", output.string());
}

struct FitArguments {
  fs::path space, scan, config, output;
  double height_m = 0.0, weight_kg = 0.0;
  std::string sex;
};

BodyAttributes ToAttributes(const FitArguments& a) {
  if (a.sex != "female" && a.sex != "male")
    throw ConfigError(fmt::format("fit: --sex: expected female or male, got \"{}\"", a.sex));
  if (!(a.height_m > 0.0) || !(a.weight_kg > 0.0)) {
    throw ConfigError(fmt::format("fit: expected a height and a weight above 0, got {} m and {} kg",
                                  a.height_m, a.weight_kg));
  }
  return {a.height_m, a.weight_kg, a.sex == "male" ? Sex::kMale : Sex::kFemale};
}

// Without a file the defaults, with no more components than the space has.
IntrinsicShapeSettings FitSettings(const fs::path& config, const ShapeSpace& space) {
  if (!config.empty()) return ReadSettingsFile<IntrinsicShapeSettings>(config);
  IntrinsicShapeSettings settings;
  if (settings.components > space.components()) {
    settings.components = space.components();
    fmt::print("components: {}, all that the shape space has\n", settings.components);
  }
  return settings;
}

LearnedModel ReadModel(const fs::path& space) {
  LearnedModel model;
  model.space = ReadShapeSpace(space);
  model.tracking = MakeTrackingTemplate(model.space.reference.rest);
  model.tracking_space = OnTrackingMesh(model.space, model.tracking);
  return model;
}

void Fit(const FitArguments& a) {
  const BodyAttributes attributes = ToAttributes(a);
  const LearnedModel model = ReadModel(a.space);
  const IntrinsicShapeSettings settings = FitSettings(a.config, model.space);
  const TriangleMesh scan = ReadMesh(a.scan);
  const FittedSubject subject = FitSubject(model, scan, attributes, settings);
  WriteFittedSubject(a.output, subject, scan,
                     {{"made_by", "vitruvia fit"},
                      {"space", a.space.string()},
                      {"scan", a.scan.string()},
                      {"settings", WriteSettings(settings)}});
  fmt::print("{} iterations; scan to body {:.2f} mm, body to scan {:.2f} mm\n{}\n",
             subject.fit.iterations, 1e3 * subject.fit.scan_to_body_mean_m,
             1e3 * subject.fit.body_to_scan_mean_m, a.output.string());
}

}  // namespace

void AddLearnDatabaseCommand(CLI::App& learn) {
  struct Arguments {
    fs::path config, output;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      learn.add_subcommand("database", "Make the body database that a learning file describes");
  command->add_option("CONFIG", a->config, "learning file")->required();
  command->add_option("-o,--output", a->output, "folder of the database")->required();
  command->callback([a] { LearnDatabase(a->config, a->output); });
}

void AddLearnShapeCommand(CLI::App& learn) {
  struct Arguments {
    fs::path config, database, output;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command = learn.add_subcommand(
      "shape",
      "Learn the shape space and the skinning weights; print the errors of held-out subjects");
  command->add_option("CONFIG", a->config, "learning file")->required();
  command->add_option("--database", a->database,
                      "folder of a database; without it, the database is generated");
  command->add_option("-o,--output", a->output, "folder of the shape space")->required();
  command->callback([a] { LearnShape(a->config, a->database, a->output); });
}

void AddFitCommand(CLI::App& app) {
  auto a = std::make_shared<FitArguments>();
  CLI::App* command = app.add_subcommand(
      "fit", "Fit a person's intrinsic shape to a scan, as a subject for trackers");
  command->add_option("SCAN", a->scan, "mesh of the scan in the subject frame")->required();
  command->add_option("--space", a->space, "folder of the shape space")->required();
  command->add_option("--height", a->height_m, "the person's height, m")->required();
  command->add_option("--weight", a->weight_kg, "the person's weight, kg")->required();
  command->add_option("--sex", a->sex, "female or male")->required();
  command->add_option(
      "--settings", a->config,
      "JSON file of the fit's settings; without it the defaults, with no more components than "
      "the space has");
  command->add_option("-o,--output", a->output, "folder of the subject")->required();
  command->callback([a] { Fit(*a); });
}

}  // namespace vitruvia
