#include "experiments/cli/learn_weights_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "core/files.h"
#include "experiments/studies/weight_comparison.h"
#include "experiments/studies/weight_examples.h"
#include "learning/skinning/rigid_pieces.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct LearnWeightsArguments {
  WeightExampleFiles files;
  fs::path settings, output;
};

void Print(const skinning::Decomposition& result) {
  fmt::print("{:>11} {:>12} {:>10}\n", "alternation", "RMSE mm", "ms");
  fmt::print("{:>11} {:>12.6f}\n", "start", 1e3 * result.start_rmse_m);
  for (std::size_t i = 0; i < result.alternations.size(); ++i) {
    const skinning::Alternation& alternation = result.alternations[i];
    fmt::print("{:>11} {:>12.6f} {:>10.1f}\n", i + 1, 1e3 * alternation.rmse_m,
               alternation.time_ms);
  }
  fmt::print("ended: {}; RMSE {:.6f} mm\n", skinning::Name(result.ending), 1e3 * result.rmse_m);
}

void LearnWeights(const LearnWeightsArguments& a) {
  const auto settings =
      a.settings.empty() ? skinning::Settings() : ReadSettingsFile<skinning::Settings>(a.settings);
  WeightExamples read = ReadWeightExamples(a.files);
  skinning::Examples examples{read.rest.vertices, read.poses};
  const std::string problem = skinning::ExamplesProblem(examples);
  if (!problem.empty()) throw DataError(fmt::format("{}: {}", a.files.meshes.string(), problem));
  if (read.labels.empty()) {
    read.labels = skinning::FindRigidPieces(examples, read.bone_count, settings.threads);
  }
  fmt::print("{} vertices, {} poses, {} bones\n", read.rest.vertices.size(), read.poses.size(),
             read.bone_count);
  const skinning::Decomposition result = skinning::Decompose(
      examples, read.labels,
      skinning::CandidateBones(read.labels, read.rest.triangles, read.bone_count, settings),
      settings);
  Print(result);
  WriteLearntWeights(a.output, read, settings, result);
  fmt::print("{}\n", a.output.string());
}

struct ComparisonArguments {
  fs::path config, output;
  int subjects = 4;
};

void CompareOnSubjects(const ComparisonArguments& a) {
  LearningSettings settings = ReadLearningSettings(a.config);
  settings.database.population.subjects = a.subjects;
  settings.database.subjects_with_poses = a.subjects;
  const WeightComparison comparison =
      CompareWeights(MakeDatabase(settings.database), settings.weights);
  Print(comparison);
  const Json record = {{"settings", WriteSettings(settings)}, {"comparison", ToJson(comparison)}};
  WriteWholeFile(a.output, record.dump(1) + "\n");
  fmt::print("{}\n", a.output.string());
}

}  // namespace

void AddLearnComparisonCommand(CLI::App& learn) {
  auto a = std::make_shared<ComparisonArguments>();
  CLI::App* command = learn.add_subcommand(
      "compare",
      "Learn skinning weights from several people and test each person's weights on the others");
  command->add_option("CONFIG", a->config, "learning file")->required();
  command->add_option("--subjects", a->subjects, "number of people, the first of the population")
      ->check(CLI::Range(2, 100))
      ->capture_default_str();
  command->add_option("-o,--output", a->output, "JSON file of the comparison")->required();
  command->callback([a] { CompareOnSubjects(*a); });
}

void AddLearnWeightsCommand(CLI::App& learn) {
  auto a = std::make_shared<LearnWeightsArguments>();
  CLI::App* command = learn.add_subcommand(
      "weights", "Learn skinning weights from meshes of one surface in several poses");
  command
      ->add_option("MESHES", a->files.meshes,
                   "folder of PLY, OBJ and OFF files of one topology, a pose each")
      ->required();
  command->add_option("--rest", a->files.rest, "mesh of the rest pose; without it the rig's own");
  command->add_option("--rig", a->files.rig, "body folder whose weights give the initial bones");
  command->add_option("--labels", a->files.labels,
                      "text file with the bone of each vertex, counted from 0");
  command
      ->add_option("--bones", a->files.bones,
                   "without --rig and --labels: number of rigid pieces to look for")
      ->check(CLI::Range(1, 256));
  command->add_option("--settings", a->settings, "JSON file of the decomposition's settings");
  command->add_option("-o,--output", a->output, "folder of the learnt weights")->required();
  command->footer(
      "Exit codes: 0 learnt; 2 wrong arguments or settings; 3 a missing, damaged or mismatched "
      "mesh, rig or labels file; 4 the folder cannot be written.");
  command->callback([a] { LearnWeights(*a); });
}

}  // namespace vitruvia
