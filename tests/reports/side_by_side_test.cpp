#include "reports/pictures/side_by_side.h"

#include <gmock/gmock.h>

#include "reports/drawing/color_maps.h"
#include "reports/pictures/drawn_before.h"
#include "reports/synthetic_experiment.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

using testing::ElementsAre;

// A run off at the left forearm and an exact one, on one sequence.
class SideBySide : public testing::Test {
 protected:
  SideBySide() {
    experiment_.record.side_by_side = true;
    experiment_.runs.resize(2);
    experiment_.runs[1].record->variant = "exact";
  }

  const TemporaryFolder root_;
  ReportedExperiment experiment_ = ReadExperiment(WriteSyntheticExperiment(root_.path()));
};

TEST_F(SideBySide, ShowsDepthTruthAndEveryRunAtThePictureFrames) {
  const std::vector<RunPictures> sheets = MakeSideBySide(experiment_, {});
  ASSERT_EQ(sheets.size(), 1u);
  const RunPictures& sheet = sheets.front();
  EXPECT_EQ(sheet.run_id, "side-by-side-wave");
  EXPECT_EQ(sheet.problem, "");
  EXPECT_THAT(sheet.titles, ElementsAre("frame 0, 0.00 s", "frame 6, 0.20 s"));
  std::vector<std::string> labels;
  for (const PictureStrip& strip : sheet.strips) {
    labels.push_back(strip.label);
    EXPECT_EQ(strip.pictures.size(), 2u);
  }
  EXPECT_THAT(labels, ElementsAre("depth", "truth", "base", "exact"));
  EXPECT_EQ(sheet.error_scale_m, 0.0);
  EXPECT_LT(sheet.nearest_m, sheet.farthest_m);
}

TEST_F(SideBySide, AnExactRunLooksLikeTheTruthAndAnotherDoesNot) {
  const RunPictures sheet = MakeSideBySide(experiment_, {}).front();
  const auto& truth = sheet.strips[1].pictures;
  const auto& waving = sheet.strips[2].pictures;
  const auto& exact = sheet.strips[3].pictures;
  for (const std::size_t frame : {0u, 1u}) {
    EXPECT_EQ(exact[frame].image.pixels(), truth[frame].image.pixels());
  }
  EXPECT_EQ(waving[0].image.pixels(), truth[0].image.pixels());  // it begins where it should
  EXPECT_NE(waving[1].image.pixels(), truth[1].image.pixels());
  EXPECT_EQ(sheet.strips[3].note, "mean L2 error 0.00 mm");
}

// The figure faces the camera, so that nothing of its back is seen.
TEST_F(SideBySide, AFigureThatFacesTheCameraShowsItsFront) {
  const RunPictures sheet = MakeSideBySide(experiment_, {}).front();
  int front = 0, back = 0;
  for (const ColorPixel& p : sheet.strips[1].pictures[0].image.pixels()) {
    front += p[2] > p[0] + 20 ? 1 : 0;
    back += p[0] > p[2] + 60 ? 1 : 0;
  }
  EXPECT_GT(front, kPictureSize * kPictureSize / 20);
  EXPECT_LT(back, front / 10);
}

TEST_F(SideBySide, IsForThoseWhoAskAndForRunsThatHaveCompany) {
  experiment_.record.side_by_side = false;
  EXPECT_TRUE(MakeSideBySide(experiment_, {}).empty());
  experiment_.record.side_by_side = true;
  experiment_.runs[1].record->summary["repeat"] = 2;  // the same again
  EXPECT_TRUE(MakeSideBySide(experiment_, {}).empty());
}

TEST_F(SideBySide, SaysWhatIsMissing) {
  experiment_.record.picture_frames = {999};
  EXPECT_EQ(MakeSideBySide(experiment_, {}).front().problem,
            "the sequence has none of the experiment's picture frames");
}

}  // namespace
}  // namespace vitruvia
