// What a report takes over from the one before.
#include "reports/pictures/drawn_before.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "reports/pages/report.h"
#include "reports/synthetic_experiment.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::IsNull;
using testing::NotNull;

class DrawnBeforeTest : public testing::Test {
 protected:
  void SetUp() override { page_ = ReadWholeFile(WriteReport(folder_)); }
  DrawnBefore Before() const { return {ReadExperiment(folder_), figures_}; }
  std::vector<std::string> DrawnAnew() const {
    std::vector<std::string> ids;
    MakePictures(ReadExperiment(folder_), Before(),
                 [&](const RunPictures& run) { ids.push_back(run.run_id); });
    return ids;
  }

  const TemporaryFolder root_;
  const fs::path folder_ = WriteSyntheticExperiment(root_.path());
  const fs::path figures_ = folder_ / "figures";
  std::string page_;
};

TEST_F(DrawnBeforeTest, HoldsWhatTheReportShows) {
  EXPECT_THAT(DrawnAnew(), IsEmpty());
  const RunPictures drawn = MakePictures(ReadExperiment(folder_), {}).front();
  const DrawnBefore before = Before();
  const RunPictures* kept = before.Pictures(kWavingRun);
  ASSERT_THAT(kept, NotNull());
  EXPECT_EQ(kept->titles, drawn.titles);
  EXPECT_EQ(kept->error_scale_m, drawn.error_scale_m);
  EXPECT_EQ(kept->nearest_m, drawn.nearest_m);
  ASSERT_EQ(kept->strips.size(), drawn.strips.size());
  for (std::size_t i = 0; i < drawn.strips.size(); ++i) {
    EXPECT_EQ(kept->strips[i].note, drawn.strips[i].note);
    for (std::size_t k = 0; k < drawn.titles.size(); ++k)
      EXPECT_EQ(kept->strips[i].pictures[k].png, drawn.strips[i].pictures[k].png);
  }
  const RunCauses found = FindCauses(ReadExperiment(folder_), {}).front();
  const RunCauses* causes = before.Causes(kWavingRun);
  ASSERT_THAT(causes, NotNull());
  EXPECT_EQ(causes->diagnosis.shares, found.diagnosis.shares);
  ASSERT_EQ(causes->diagnosis.events.size(), found.diagnosis.events.size());
  EXPECT_EQ(causes->diagnosis.events[0].reason, found.diagnosis.events[0].reason);
  EXPECT_EQ(causes->diagnosis.lost_frames, found.diagnosis.lost_frames);
}

TEST_F(DrawnBeforeTest, ARunThatChangedIsDrawnAnew) {
  RunRecord run = ReadRunRecord(folder_, kExactRun);
  run.warnings.push_back("written again");
  WriteRunRecord(folder_, run);
  EXPECT_THAT(Before().Causes(kExactRun), IsNull());
  EXPECT_THAT(DrawnAnew(), ElementsAre(kExactRun));
}

TEST_F(DrawnBeforeTest, ChangedPictureFramesLeaveNothing) {
  ExperimentRecord experiment = ReadExperiment(folder_).record;
  experiment.picture_frames = {1};
  WriteExperimentRecord(folder_, experiment);
  EXPECT_EQ(DrawnAnew().size(), 3u);
}

TEST_F(DrawnBeforeTest, OtherColoursOfErrorsAreDrawnAnew) {
  ExperimentRecord experiment = ReadExperiment(folder_).record;
  experiment.picture_frames = {3};  // when the arms are farthest off
  WriteExperimentRecord(folder_, experiment);
  WriteReport(folder_);
  experiment.run_ids = {kExactRun};  // the scale of errors is now its own
  WriteExperimentRecord(folder_, experiment);
  EXPECT_THAT(Before().Pictures(kExactRun), NotNull());
  EXPECT_THAT(DrawnAnew(), ElementsAre(kExactRun));
}

TEST_F(DrawnBeforeTest, AMissingSheetIsDrawnAnew) {
  fs::remove(SheetStem(figures_, kWavingRun).concat(".svg"));
  EXPECT_THAT(DrawnAnew(), ElementsAre(kWavingRun));
  WriteReport(folder_);
  EXPECT_TRUE(fs::exists(SheetStem(figures_, kWavingRun).concat(".svg")));
}

TEST_F(DrawnBeforeTest, ADamagedFileDoesNoHarm) {
  WriteWholeFile(figures_ / "drawn.cbor", "damaged");
  EXPECT_EQ(DrawnAnew().size(), 3u);
  EXPECT_EQ(ReadWholeFile(WriteReport(folder_)), page_);
}

}  // namespace
}  // namespace vitruvia
