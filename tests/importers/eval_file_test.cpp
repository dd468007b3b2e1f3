// Stanford EVAL's layout: known values at known bytes, and refusals of what is damaged.
#include "importers/eval_file.h"

#include <cstddef>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "support/eval_file_writer.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Two frames with a few known points.
std::vector<EvalFrameBytes> TwoFrames() {
  std::vector<EvalFrameBytes> frames(2);
  for (int i = 0; i < 2; ++i) {
    frames[i].magic = 77;
    frames[i].number = 41 + i;
    frames[i].points[0][0] = {-0.5f, 1.0f, -2.0f};
    frames[i].points[239][319] = {0.25f, -0.125f, -3.5f + static_cast<float>(i)};
    AddEvalMarker("LShoulder", {0.1, 0.2, 2.5}, frames[i]);
    AddEvalMarker("Head", {0.0, 0.0, 0.0}, frames[i]);  // not seen
    AddEvalJoint(9, {0.125, 0.25, 2.5}, frames[i]);
    AddEvalJoint(3, {0.0, 0.0, 0.0}, frames[i]);  // not seen
  }
  return frames;
}

class EvalFiles : public testing::Test {
 protected:
  // Why a file of these frames is refused.
  std::string Refusal(const std::vector<EvalFrameBytes>& frames) const {
    WriteEvalFile(file_, frames);
    return Refusal();
  }

  std::string Refusal() const {
    try {
      const EvalFile file(file_);
      for (int i = 0; i < file.frames(); ++i) file.ReadFrame(i);
    } catch (const DataError& error) {
      return error.what();
    }
    return "not refused";
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "seq_a_0.bin";
};

TEST_F(EvalFiles, KnownValuesComeBackInOurAxes) {
  WriteEvalFile(file_, TwoFrames());
  const EvalFile file(file_);
  ASSERT_EQ(file.frames(), 2);
  for (int i = 0; i < 2; ++i) {
    const EvalFrame frame = file.ReadFrame(i);
    EXPECT_EQ(frame.number, 41 + i);
    ASSERT_EQ(frame.points.size(), 320u * 240u);
    EXPECT_EQ(frame.points.front(), Vector3f(-0.5f, -1.0f, 2.0f));
    EXPECT_EQ(frame.points.back(), Vector3f(0.25f, 0.125f, 3.5f - static_cast<float>(i)));
    EXPECT_EQ(frame.points[1], Vector3f(0.0f, 0.0f, 0.0f));
    ASSERT_EQ(frame.markers.size(), 1u);
    EXPECT_EQ(frame.markers.at("LShoulder").cast<float>(), Vector3f(0.1f, 0.2f, 2.5f));
    ASSERT_EQ(frame.joints.size(), 1u);
    EXPECT_EQ(frame.joints.at(9), Vector3d(0.125, 0.25, 2.5));
  }
}

TEST_F(EvalFiles, TheLayoutHasItsPartsAtTheDocumentedBytes) {
  EXPECT_EQ(offsetof(EvalFrameBytes, points), 8u);
  EXPECT_EQ(offsetof(EvalFrameBytes, marker_count), 921608u);
  EXPECT_EQ(offsetof(EvalFrameBytes, joint_count), 930188u);
  std::string bytes(kEvalFrameBytes, '\0');
  bytes[930188] = 1;  // one joint
  bytes[930192] = 5;  // its id
  const float y = 2.0f;
  bytes.replace(930192 + 8, sizeof(y), reinterpret_cast<const char*>(&y), sizeof(y));
  WriteWholeFile(file_, bytes);
  EXPECT_EQ(EvalFile(file_).ReadFrame(0).joints.at(5), Vector3d(0.0, -2.0, 0.0));
}

TEST_F(EvalFiles, OnlyTheFirstSoManyEntriesAreValid) {
  std::vector<EvalFrameBytes> frames = TwoFrames();
  for (EvalFrameBytes& frame : frames) {
    frame.joints[20] = {8, {kNan, kNan, kNan}};  // what lies behind the last is of no account
    frame.markers[20].place = {kNan, kNan, kNan};
  }
  EXPECT_EQ(Refusal(frames), "not refused");
}

TEST_F(EvalFiles, SizesThatAreNoWholeFramesAreRefused) {
  EXPECT_THAT(Refusal(), HasSubstr("seq_a_0.bin: cannot be opened"));
  WriteWholeFile(file_, "");
  EXPECT_THAT(Refusal(),
              HasSubstr("seq_a_0.bin: expected a whole number of frames of 930704 bytes, "
                        "got 0 bytes: 0 frames and 0 bytes"));
  const std::string whole(3 * kEvalFrameBytes, '\0');
  WriteWholeFile(file_, whole.substr(100));
  EXPECT_THAT(Refusal(), HasSubstr("got 2792012 bytes: 2 frames and 930604 bytes"));
  WriteWholeFile(file_, whole + "x");
  EXPECT_THAT(Refusal(), HasSubstr("3 frames and 1 bytes"));
}

TEST_F(EvalFiles, DamagedFramesAreRefusedWithTheirPlace) {
  const auto refusal = [this](void (*damage)(EvalFrameBytes & frame)) {
    std::vector<EvalFrameBytes> frames = TwoFrames();
    damage(frames[1]);
    std::string text = Refusal(frames);
    EXPECT_THAT(text, StartsWith(file_.string() + ": frame 1, byte ")) << text;
    return text;
  };
  EXPECT_THAT(refusal([](EvalFrameBytes& f) { f.magic = 78; }),
              HasSubstr("byte 930704: expected 0x0000004d as at the beginning of the first frame, "
                        "got 0x0000004e"));
  EXPECT_THAT(refusal([](EvalFrameBytes& f) {
                f.points[2][5] = {0.5f, kNan, -1.0f};
              }),
              HasSubstr("byte 938452: column 5, row 2: expected a point with z below 0, so before "
                        "the camera, or (0, 0, 0), got (0.5, nan, -1)"));
  EXPECT_THAT(refusal([](EvalFrameBytes& f) {
                f.points[2][5] = {0.5f, 0.0f, 1.5f};
              }),
              HasSubstr("got (0.5, 0, 1.5)"));
  EXPECT_THAT(refusal([](EvalFrameBytes& f) {
                f.points[2][5] = {0.5f, 0.0f, 0.0f};
              }),
              HasSubstr("got (0.5, 0, 0)"));
  EXPECT_THAT(refusal([](EvalFrameBytes& f) { f.marker_count = 33; }),
              HasSubstr("byte 1852312: expected 0 … 32 markers, got 33"));
  EXPECT_THAT(refusal([](EvalFrameBytes& f) { f.joint_count = -1; }),
              HasSubstr("byte 1860892: expected 0 … 32 joints, got -1"));
  EXPECT_THAT(refusal([](EvalFrameBytes& f) { f.joints[0].place[2] = kNan; }),
              HasSubstr("joint 9: expected three finite numbers, got (0.125, -0.25, nan)"));
  EXPECT_THAT(refusal([](EvalFrameBytes& f) {
                f.markers[0].place[0] = std::numeric_limits<float>::infinity();
              }),
              HasSubstr("marker \"LShoulder\": expected three finite numbers, got (inf, "));
  EXPECT_THAT(refusal([](EvalFrameBytes& f) { f.joints[1].id = 9; }),
              HasSubstr("expected each joint once, got id 9 twice"));
  EXPECT_THAT(refusal([](EvalFrameBytes& f) { f.markers[1].name = f.markers[0].name; }),
              HasSubstr("expected each marker once, got \"LShoulder\" twice"));
  EXPECT_THAT(refusal([](EvalFrameBytes& f) { f.markers[1].name.fill('\0'); }),
              HasSubstr("expected the name of a marker in ASCII letters"));
}

}  // namespace
}  // namespace vitruvia
