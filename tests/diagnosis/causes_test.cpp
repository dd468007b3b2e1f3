// Small scenes in which one thing goes wrong (configs/causes.json), tracked: the diagnosis names
// it.
#include <algorithm>

#include <gtest/gtest.h>

#include "diagnosis/diagnosis.h"
#include "experiments/run/tracking_run.h"
#include "experiments/studies/planned_experiment.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;

const fs::path kExperiment = fs::path(VITRUVIA_SOURCE_DIR) / "configs" / "causes.json";

// "limb on body" is the variant limb_on_body.
std::string VariantOf(Cause cause) {
  std::string name(Name(cause));
  std::ranges::replace(name, ' ', '_');
  return name;
}

class Causes : public testing::TestWithParam<Cause> {};

TEST_P(Causes, OfItsSceneRanksFirst) {
  const TemporaryFolder folder;
  const std::vector<PlannedRun> runs = PlanForOutput(kExperiment, folder / "out").experiment.runs;
  const auto planned = std::ranges::find(runs, VariantOf(GetParam()), &PlannedRun::variant);
  ASSERT_NE(planned, runs.end()) << "no variant " << VariantOf(GetParam());
  const fs::path run_folder = folder.path() / "out" / planned->run_id;
  fs::create_directories(run_folder);
  const RunRecord record = CarryOutTracking(*planned, run_folder);

  const SequenceReader sequence(folder.path() / "out" / record.sequence_folder);
  const EstimateReader estimate(run_folder / "estimate");
  const Diagnosis diagnosis = Diagnose(sequence, estimate);

  EXPECT_EQ(Name(diagnosis.Main()), Name(GetParam()));
  double sum = 0.0;
  for (const double share : diagnosis.shares) sum += share;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_FALSE(diagnosis.events.empty());
}

INSTANTIATE_TEST_SUITE_P(OneAtATime, Causes,
                         testing::Values(Cause::kSmall, Cause::kFacing, Cause::kStart,
                                         Cause::kOutOfView, Cause::kHidden, Cause::kNoData,
                                         Cause::kFewPairs, Cause::kFast, Cause::kNoise,
                                         Cause::kLimbOnBody),
                         [](const auto& of) { return VariantOf(of.param); });

}  // namespace
}  // namespace vitruvia
