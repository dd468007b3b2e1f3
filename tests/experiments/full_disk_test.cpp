// Folders that cannot be written and disks that are full: the program says which file, ends with
// the documented code, leaves nothing half-written, and goes on when there is room.
#include "experiments/full_disk.h"

#include <cstdlib>

#include <gmock/gmock.h>

#include "core/files.h"
#include "core/random.h"
#include "sequence/sequence.h"
#include "support/eval_file_writer.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kNoRoom = "cannot be written: File too large";
// The scene's vertices take some 19 kB for each of its 12 frames, its mesh 61 kB.
constexpr rlim_t kForEightFrames = 150'000;

// An EVAL recording of one frame.
void WriteWall(const fs::path& file) {
  DepthImage uneven(320, 240);  // its picture cannot be packed small
  RandomStream random(1, "wall");
  for (float& depth : uneven.pixels()) depth = static_cast<float>(random.Uniform(2.0, 4.0));
  std::vector<EvalFrameBytes> frames(1);
  SetEvalPoints(uneven, PinholeCamera{}, frames[0]);
  WriteEvalFile(file, frames);
}

class FullDisk : public testing::Test {
 protected:
  // What is left under a temporary name.
  std::vector<std::string> Unfinished() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(files_.path())) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with(".part") || name.ends_with(".old")) names.push_back(entry.path().string());
    }
    return names;
  }

  void ExpectNoRoom(rlim_t bytes, const std::vector<std::string>& arguments,
                    const std::string& file) const {
    const CallResult call = CallWithFullDisk(bytes, arguments);
    EXPECT_EQ(call.code, static_cast<int>(ExitCode::kFailedRun)) << call.error;
    EXPECT_THAT(call.error, HasSubstr(file + ": " + kNoRoom)) << arguments[0];
    EXPECT_THAT(Unfinished(), testing::IsEmpty());
  }

  SmallExperiment files_;
};

TEST_F(FullDisk, ASequenceIsWrittenWholeOrNotAtAll) {
  const std::string out = files_.File("sequence");
  const std::vector<std::string> synth = {"synth", files_.File("scene.json"), "-o", out};
  ExpectNoRoom(4000, synth, "mesh.ply");
  EXPECT_FALSE(fs::exists(out));
  ExpectNoRoom(kForEightFrames, synth, "vertices.bin");
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(CallVitruvia(synth).code, 0);
  const std::string whole = SequenceReader(out).hash();
  ExpectNoRoom(kForEightFrames, synth, "vertices.bin");
  EXPECT_EQ(SequenceReader(out).hash(), whole);  // the old one stays
}

TEST_F(FullDisk, SoAreEstimatesExportsAndImports) {
  ASSERT_EQ(CallVitruvia({"run", files_.File("experiment.json"), "-o", files_.File("out")}).code,
            0);
  const std::string run = ReadJsonFile(files_ / "out/summary.json").at("rows")[0].at("run_id");
  const Json record = ReadJsonFile(files_ / "out" / run / "record.json");
  const fs::path sequence = files_ / "out" / record.at("sequence_folder").get<std::string>();
  ExpectNoRoom(kForEightFrames,
               {"track", files_.File("method.json"), "--sequence", sequence.string(), "-o",
                files_.File("estimate")},
               "vertices.bin");
  EXPECT_FALSE(fs::exists(files_ / "estimate"));
  const CallResult exported = CallWithFullDisk(20'000, {"export", files_.File("out")});
  EXPECT_EQ(exported.code, static_cast<int>(ExitCode::kFailedRun)) << exported.error;
  EXPECT_THAT(exported.error, HasSubstr("_000000.vtp: cannot be written"));
  EXPECT_FALSE(fs::exists(files_ / "out" / run / "meshes"));
  WriteWall(files_ / "a.bin");
  ExpectNoRoom(4000, {"import", "eval", files_.File("a.bin"), "-o", files_.File("imported")},
               "000000.png");
  EXPECT_FALSE(fs::exists(files_ / "imported"));
}

TEST_F(FullDisk, AnExperimentGoesOnWhenThereIsRoomAgain) {
  Json config = SmallExperiment::Config();
  config["variants"] = {{{"name", "a"}},
                        {{"name", "b"}, {"method", {{"settings", {{"axis_weight", 0}}}}}}};
  files_.Write("experiment.json", config);
  const std::vector<std::string> run = {"run", files_.File("experiment.json"), "-o",
                                        files_.File("out")};
  // From the sequence to the report: each time something else is too large.
  for (const rlim_t bytes : {4000, 20'000, 70'000, 150'000, 240'000}) {
    const CallResult call = CallWithFullDisk(bytes, run);
    EXPECT_EQ(call.code, static_cast<int>(ExitCode::kFailedRun)) << bytes << ": " << call.error;
    EXPECT_THAT(call.error, HasSubstr(kNoRoom)) << bytes;
    EXPECT_THAT(Unfinished(), testing::IsEmpty()) << bytes;
  }
  const CallResult with_room = CallVitruvia(run);
  ASSERT_EQ(with_room.code, 0) << with_room.error;
  ASSERT_EQ(CallVitruvia({"run", files_.File("experiment.json"), "-o", files_.File("fresh")}).code,
            0);
  EXPECT_EQ(ResultOf(files_ / "out"), ResultOf(files_ / "fresh"));
}

TEST_F(FullDisk, FoldersThatCannotBeWrittenAreNamed) {
  WriteWholeFile(files_ / "file", "");
  ASSERT_EQ(CallVitruvia({"synth", files_.File("scene.json"), "-o", files_.File("seq")}).code, 0);
  WriteWall(files_ / "a.bin");
  for (const std::string& folder : {files_.File("file/below"), std::string("/proc/vitruvia")}) {
    const std::vector<std::vector<std::string>> calls = {
        {"run", files_.File("experiment.json")},
        {"synth", files_.File("scene.json")},
        {"track", files_.File("method.json"), "--sequence", files_.File("seq")},
        {"import", "eval", files_.File("a.bin")}};
    for (std::vector<std::string> call : calls) {
      call.insert(call.end(), {"-o", folder});
      ExpectRefusal(call, ExitCode::kFailedRun, {folder});
    }
  }
  EXPECT_EQ(ReadWholeFile(files_ / "file"), "");
}

TEST_F(FullDisk, StandardOutputThatTakesNothingIsAnError) {
  for (const char* command : {"explain", "explain realtime_scape.inertia_weight"}) {  // long, short
    const std::string line =
        fmt::format("{} {} > /dev/full 2> {}", VITRUVIA_PROGRAM, command, files_.File("error"));
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), static_cast<int>(ExitCode::kFailedRun));
    EXPECT_THAT(ReadWholeFile(files_ / "error"), HasSubstr("No space left on device")) << command;
  }
}

TEST_F(FullDisk, MessagesThatCannotBeWrittenStopNothing) {
  const std::string line =
      fmt::format("{} synth {} -o {} > {} 2> /dev/full", VITRUVIA_PROGRAM,
                  files_.File("scene.json"), files_.File("seq"), files_.File("said"));
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 0);
  VerifySequence(files_ / "seq");
}

}  // namespace
}  // namespace vitruvia
