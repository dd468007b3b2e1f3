#include "synth/population/make_database.h"

#include <optional>

#include "config/json_settings.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/progress.h"
#include "synth/bodies/mannequin.h"
#include "synth/bodies/refiner.h"

namespace vitruvia {
namespace {

Json HowExamplesWereMade(const DatabaseSettings& settings) {
  return {fmt::format("dual-quaternion skinning by the rig's weights, diffused over {} steps",
                      settings.poses.weight_diffusion),
          fmt::format("flesh at elbows and knees bulges by {:g} m at a right angle",
                      settings.poses.bulge_m),
          fmt::format("noise of {:g} m on every coordinate", settings.poses.noise_m)};
}

}  // namespace

DatabaseSettings::DatabaseSettings() { mesh.subdivisions = kMannequinSteps; }

void DatabaseSettings::Describe(Fields& f) {
  f.Section("population", population, {.meaning = "the people"});
  f.Section("mesh", mesh, {.meaning = "the learning mesh"});
  f.Integer(
      "subjects_with_poses", subjects_with_poses,
      {.meaning =
           "number of subjects, from the first, that have pose examples, which take much memory",
       .min = 0,
       .max = 100000});
  f.Section("poses", poses, {.meaning = "the pose examples"});
}

std::string DatabaseSettings::Problem() const {
  if (subjects_with_poses <= population.subjects) return "";
  return fmt::format("subjects_with_poses: expected at most the {} subjects, got {}",
                     population.subjects, subjects_with_poses);
}

PoseExamples MakePoseExamples(const DatabaseSettings& settings, const std::string& name,
                              const ControlBody& body) {
  RandomStream random(static_cast<std::uint64_t>(settings.population.seed), "poses of " + name);
  RefinementSettings refinement = settings.mesh;
  refinement.weight_diffusion = settings.poses.weight_diffusion;
  const BodyModel deforming = Refine(body, refinement);
  PoseExamples examples{name, {}};
  for (const JointPose& pose : DrawPoses(settings.poses, body.skeleton, random)) {
    examples.poses.push_back(Deform(settings.poses, deforming, pose, random));
  }
  return examples;
}

std::string SubjectName(int number) { return fmt::format("s{:03}", number); }

BodyDatabase MakeDatabase(const DatabaseSettings& settings) {
  Population population(settings.population);
  BodyDatabase database;
  std::optional<Refiner> refiner;  // all bodies of a source have one topology
  Progress progress("database", settings.population.subjects);
  for (int number = 0; number < settings.population.subjects; ++number) {
    ThrowIfInterrupted();
    const ControlBody body = population.Subject(number);
    if (!refiner) refiner.emplace(body.cage, settings.mesh);
    const std::string name = SubjectName(number);
    if (number < settings.subjects_with_poses) {
      database.examples.push_back(MakePoseExamples(settings, name, body));
    }
    database.subjects.push_back({name, body.attributes, body.skeleton, refiner->Vertices(body)});
    progress.Advance();
  }
  const auto average = static_cast<int>(MostAverage(database.subjects));
  database.reference = Refine(population.Subject(average), settings.mesh);
  database.reference.name = database.subjects[static_cast<std::size_t>(average)].name;
  database.provenance = {{"made_by", "vitruvia learn database"},
                         {"settings", WriteSettings(settings)},
                         {"examples", HowExamplesWereMade(settings)},
                         {"build", Provenance()}};
  return database;
}

}  // namespace vitruvia
