#include "importers/depth_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Recording : public testing::Test {
 protected:
  void Make(const std::vector<std::string>& names) const {
    for (const std::string& name : names) WriteWholeFile(folder_ / name, "x");
  }

  static std::vector<std::string> Names(const DepthRecording& recording) {
    std::vector<std::string> names;
    for (const fs::path& file : recording.frames) names.push_back(file.filename().string());
    return names;
  }

  std::string Refusal(const fs::path& images) const {
    try {
      FindRecordedFrames(images);
    } catch (const DataError& error) {
      return error.what();
    }
    return "not refused";
  }

  TemporaryFolder folder_;
};

TEST_F(Recording, FilesComeInTheOrderOfTheirNumbers) {
  Make({"frame10.png", "frame9.png", "frame11.png", "notes.txt"});
  const DepthRecording recording = FindRecordedFrames(folder_.path());
  EXPECT_THAT(Names(recording), ElementsAre("frame9.png", "frame10.png", "frame11.png"));
  EXPECT_EQ(recording.missing, 0);
}

TEST_F(Recording, NumbersSteppedOverAreMissingFrames) {
  Make({"d_0000.png", "d_0002.png", "d_0004.png", "d_0010.png", "d_0012.png"});
  const DepthRecording recording = FindRecordedFrames(folder_.path());
  EXPECT_THAT(Names(recording), ElementsAre("d_0000.png", "d_0002.png", "d_0004.png", "", "",
                                            "d_0010.png", "d_0012.png"));
  EXPECT_EQ(recording.missing, 2);
  EXPECT_THAT(recording.gaps, ElementsAre("2 between d_0004.png and d_0010.png"));
}

TEST_F(Recording, NamesWithoutACommonBeginningTellNoGaps) {
  Make({"left_1.png", "right_7.png"});
  EXPECT_EQ(FindRecordedFrames(folder_.path()).missing, 0);
}

TEST_F(Recording, ListGivesTimesAndGaps) {
  Make({"a.png", "b.png", "c.png", "e.png", "f.png"});
  WriteWholeFile(folder_ / "depth.txt",
                 "# timestamp filename\n10.00 a.png\n10.05 b.png\n10.10 c.png\n10.20 e.png\n"
                 "10.25 f.png\n");
  const DepthRecording recording = FindRecordedFrames(folder_ / "depth.txt");
  EXPECT_THAT(Names(recording), ElementsAre("a.png", "b.png", "c.png", "", "e.png", "f.png"));
  EXPECT_NEAR(recording.fps, 20.0, 1e-6);
}

TEST_F(Recording, BadListsAndFoldersAreRefused) {
  EXPECT_THAT(Refusal(folder_.path()), HasSubstr("found none"));
  EXPECT_THAT(Refusal(folder_ / "nowhere"), HasSubstr("there is nothing"));
  Make({"a.png", "b.png", "c.pcd"});
  EXPECT_THAT(Refusal(folder_.path()), HasSubstr("expected one kind"));
  const auto list = [&](const std::string& text) {
    WriteWholeFile(folder_ / "depth.txt", text);
    return Refusal(folder_ / "depth.txt");
  };
  EXPECT_THAT(list("1.0 a.png\n1.0 b.png\n"), HasSubstr("depth.txt:2: time stamp"));
  EXPECT_THAT(list("1.0 z.png\n"), HasSubstr("there is none"));
  EXPECT_THAT(list("one a.png\n"), HasSubstr("expected \"seconds path\""));
  EXPECT_THAT(list("# nothing\n"), HasSubstr("found none"));
}

}  // namespace
}  // namespace vitruvia
