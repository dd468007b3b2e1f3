#include "experiments/cli/subject_command.h"

#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>

#include "config/json_settings.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/files.h"
#include "experiments/cli/known_person.h"
#include "learning/shape/tracking_template.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr double kMostUnusual = 3.0;  // standard deviations of the space's people

struct SubjectArguments {
  fs::path space, output;
  PersonOptions person;
};

void MakeSubject(const SubjectArguments& a) {
  const KnownAttributes known = a.person.Known();
  if (!known.height_m)
    throw ConfigError("subject: expected --height, the person's height in metres");
  const ShapeSpace space = ReadShapeSpace(a.space);
  const SizedShape shape = ShapeOfSize(space, known, space.components(), kMostUnusual);
  BodyModel body = SizedBody(space, shape, known.sex);
  body = OnTrackingMesh(body, MakeTrackingTemplate(body.rest));
  body.name = "sized";
  StagedFolder folder(a.output, "weights.bin");
  WriteBodyModel(folder.path(), body);
  const Json record = {{"made_by", "vitruvia subject"},
                       {"space", a.space.string()},
                       {"theta", std::vector<double>(shape.theta.begin(), shape.theta.end())},
                       {"scale", shape.scale},
                       {"build", Provenance()}};
  WriteWholeFile(folder.path() / "provenance.json", record.dump(2) + "\n");
  folder.Commit();
  fmt::print(
      "{:.2f} m, {:.1f} kg; {:.1f} standard deviations from the space's mean, scaled by "
      "{:.3f}\n{}\n",
      body.attributes.height_m, body.attributes.weight_kg, shape.theta.norm(), shape.scale,
      a.output.string());
}

}  // namespace

void AddSubjectCommand(CLI::App& app) {
  auto a = std::make_shared<SubjectArguments>();
  CLI::App* command = app.add_subcommand(
      "subject", "Make a subject of a person who was not scanned, of height, weight and sex");
  command->add_option("--space", a->space, "folder of the shape space")->required();
  AddPersonOptions(*command, a->person);
  command->add_option("-o,--output", a->output, "folder of the subject")->required();
  command->footer(
      "The body is the most probable one of the space with these attributes. Where the space has "
      "nobody of that height, its nearest body is scaled: learn a space with children for children "
      "(configs/learning/makehuman_all_ages.json).");
  command->callback([a] { MakeSubject(*a); });
}

}  // namespace vitruvia
