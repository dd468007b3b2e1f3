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
#include "math/statistics.h"
#include "reports/pictures/surface_pictures.h"
#include "subjects/seen_subject.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr double kMostUnusual = 3.0;  // standard deviations of the space's people

struct SubjectArguments {
  fs::path space, sequence, settings, output;
  PersonOptions person;
};

void MakeSizedSubject(const SubjectArguments& a) {
  const KnownAttributes known = a.person.Known();
  if (!known.height_m) {
    throw ConfigError(
        "subject: expected --height, the person's height in metres, or --sequence, where the "
        "person is seen");
  }
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

void Print(const SeenSubject& seen) {
  for (const SeenFrame& frame : seen.frames) {
    const std::vector<double>& points_m = frame.distance.points_to_model_m;
    fmt::print(
        "frame {}: from {}: observed points to the body: mean {:.1f} mm, p95 {:.1f} mm; visible "
        "body to the points: mean {:.1f} mm; silhouettes overlap by {:.2f}\n",
        frame.frame, frame.registration.start, 1e3 * Mean(points_m), 1e3 * Quantile(points_m, 0.95),
        1e3 * Mean(frame.distance.model_to_points_m), frame.distance.silhouette_overlap);
  }
  fmt::print("{:.2f} m, {:.1f} kg\n", seen.subject.attributes.height_m,
             seen.subject.attributes.weight_kg);
}

void MakeSeenSubject(const SubjectArguments& a) {
  const auto settings = a.settings.empty() ? SeenSubjectSettings()
                                           : ReadSettingsFile<SeenSubjectSettings>(a.settings);
  const SequenceReader sequence(a.sequence);
  const ShapeSpace space = ReadShapeSpace(a.space);
  Registrar registrar(space, a.person.Known(), settings.registration);
  StagedFolder folder(a.output, "weights.bin");
  const SeenSubject seen = SubjectFromFrames(sequence, registrar, settings);
  WriteBodyModel(folder.path(), seen.subject);
  WriteWholeFile(folder.path() / "registration.json",
                 SeenSubjectRecord(seen, settings).dump(1) + "\n");
  MeshView view(kPictureSize, kPictureSize);
  RunPictures pictures;
  DrawSurfaceStrips(SeenSubjectStrips(seen), view, pictures);
  WritePictureSheet(DrawingWriter(), folder.path() / "registration", pictures);
  folder.Commit();
  Print(seen);
  fmt::print("{}\n", a.output.string());
}

}  // namespace

void AddSubjectCommand(CLI::App& app) {
  auto a = std::make_shared<SubjectArguments>();
  CLI::App* command = app.add_subcommand(
      "subject",
      "Make the subject of a person without a scan, from height, weight and sex, or from frames");
  command->add_option("--space", a->space, "folder of the shape space")->required();
  AddPersonOptions(*command, a->person);
  command->add_option("--sequence", a->sequence,
                      "sequence of the person: the shape is fitted to its frames");
  command->add_option("--settings", a->settings,
                      "JSON file with the settings of the fit to frames; without it the defaults");
  command->add_option("-o,--output", a->output, "folder of the subject")->required();
  command->footer(
      "The body is the most probable one of the space with these attributes. Where the space has "
      "nobody of that height, its nearest body is scaled: learn a space with children for children "
      "(configs/learning/makehuman_all_ages.json). With --sequence the body is put onto frames of "
      "the sequence, which may show any pose, one shape for all of them; registration.png shows "
      "how well.");
  command->callback([a] { a->sequence.empty() ? MakeSizedSubject(*a) : MakeSeenSubject(*a); });
}

}  // namespace vitruvia
