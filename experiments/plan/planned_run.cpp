#include "experiments/plan/planned_run.h"

#include "core/files.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kRunFile = "run.json";

}  // namespace

void PlannedRun::Describe(Fields& f) {
  f.Text("experiment", experiment, {.meaning = "name of the experiment"});
  f.Text("kind", kind, {.meaning = "kind of the experiment"});
  f.Text("run_id", run_id, {.meaning = "name of the run and of its folder"});
  f.Text("key", key, {.meaning = "hash of all that the result depends on"});
  f.FreeJson("resolved", resolved, {.meaning = "settings that the result depends on"});
  f.Text("variant", variant, {.meaning = "name of the variant"});
  f.Text("scene", scene, {.meaning = "name of the scene, the sequence or the person"});
  f.Text("method", method, {.meaning = "name of the method"});
  f.Integer("seed", seed, {.meaning = "seed of the scene's random numbers"});
  f.Integer("repeat", repeat, {.meaning = "number of the repetition; 0 if there is one only"});
  f.Integer("person", person, {.meaning = "number of the person in the population"});
  f.Integer("frames", frames, {.meaning = "number of frames that are tracked"});
  f.Flag("timed", timed, {.meaning = "whether the run has its machine to itself"});
  f.File("sequences", work.sequences, {.meaning = "folder of synthesised sequences"});
  f.File("learned", work.learned, {.meaning = "folder of learnt models and fitted subjects"});
  f.List("summaries", summaries,
         {.meaning = "summaries that the experiment defines", .optional = true});
}

JsonOrigin ResolvedOrigin(const char* key) { return {"resolved settings", key}; }

void WritePlannedRun(const fs::path& run_folder, const PlannedRun& run) {
  PlannedRun stored = run;
  stored.work = {fs::absolute(run.work.sequences), fs::absolute(run.work.learned)};
  MakeFolder(run_folder);
  WriteStored(run_folder / kRunFile, stored);
}

PlannedRun ReadPlannedRun(const fs::path& run_folder) {
  return ReadStored<PlannedRun>(run_folder / kRunFile);
}

}  // namespace vitruvia
