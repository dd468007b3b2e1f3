// Depth recordings imported: a person cut out of synthetic rooms, held against the true mask; the
// file formats; and what is refused.
#include "importers/depth_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "experiments/command_line.h"
#include "geometry/depth_png.h"
#include "geometry/image_file.h"
#include "sequence/sequence.h"
#include "support/mask_truth.h"
#include "support/written_image.h"
#include "synth/scene/scene.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr double kLeastOverlap = 0.97;
constexpr double kFeetWithin_px = 2.0;
// A camera of a quarter of the scenes' pixels.
const Json kQuarter = {{"width", 320}, {"height", 240}, {"fx", 285.0},
                       {"fy", 285.0},  {"cx", 159.5},   {"cy", 119.5}};
const Json kOfTheScene;

class DepthImport : public testing::Test {
 protected:
  // A scene of configs/ with so many frames, made as `scene`.
  void MakeScene(const std::string& name, int frames, double fps, const std::string& sensor,
                 const Json& camera = kQuarter) {
    auto scene = ReadSettingsFile<SceneSettings>(kConfigs / "scenes" / name);
    Json json = WriteSettings(scene);
    if (!camera.is_null()) json["view"]["camera"] = camera;
    json["frames"] = frames;
    json["fps"] = fps;
    json["sensor"] = {{"model", sensor}};
    json["room"]["empty_frames"] = 8;
    files_.Write("scene.json", json);
    const CallResult call =
        CallVitruvia({"synth", files_.File("scene.json"), "-o", files_.File("scene")});
    ASSERT_EQ(call.code, 0) << call.error;
    config_ = {{"images", "scene/depth"},
               {"camera", json["view"]["camera"]},
               {"unit_m", scene.sensor.depth_unit_m},
               {"fps", fps},
               {"empty_frames", {{"images", "scene/empty_room"}}},
               {"cutout", {{"background", {{"source", "empty_frames"}}}}}};
  }

  CallResult Import(const std::string& output, int threads = 2) const {
    files_.Write("import.json", config_);
    return CallVitruvia({"import", "depth", files_.File("import.json"), "-o", files_.File(output),
                         "--threads", std::to_string(threads)});
  }

  void ExpectTrueMasks(int first_frame) const {
    const CallResult call = Import("imported");
    ASSERT_EQ(call.code, 0) << call.error;
    const SequenceReader scene(files_ / "scene"), imported(files_ / "imported");
    ASSERT_EQ(imported.info().frames, scene.info().frames);
    for (int i = first_frame; i < scene.info().frames; ++i) {
      const MaskImage mask = imported.ReadMask(i);
      EXPECT_GE(MaskOverlap(mask, scene.ReadMask(i), scene.ReadDepthWithRoom(i)), kLeastOverlap)
          << "frame " << i;
      EXPECT_LE(FeetLost_px(scene, i, mask), kFeetWithin_px) << "frame " << i;
    }
  }

  // Refused with these words, and nothing is left behind.
  void ExpectRefused(ExitCode code, const std::vector<std::string>& words) const {
    files_.Write("import.json", config_);
    ExpectRefusal({"import", "depth", files_.File("import.json"), "-o", files_.File("never")}, code,
                  words);
    for (const auto& entry : fs::directory_iterator(files_.path()))
      EXPECT_EQ(entry.path().filename().string().find("never"), std::string::npos) << entry.path();
  }

  // Frames of a box that a person could be, moving in front of a wall, as numbers of `unit_m`.
  void MakeBoxes(int frames) {
    fs::create_directory(files_ / "boxes");
    for (int i = 0; i < frames; ++i)
      WriteImageFile(files_ / fmt::format("boxes/{:03}.png", i), Box(i), CV_16UC1);
    config_ = {
        {"images", "boxes"},
        {"camera",
         {{"width", 80}, {"height", 60}, {"fx", 71}, {"fy", 71}, {"cx", 39.5}, {"cy", 29.5}}}};
  }

  // An image of a level floor 1.2 m under that camera, which looks down by 0.3 radians.
  static void WriteFloor(const fs::path& folder) {
    fs::create_directory(folder);
    Image<float> image(80, 60);
    for (int v = 0; v < 60; ++v) {
      const double down = (v - 29.5) / 71.0 * std::cos(0.3) + std::sin(0.3);
      for (int u = 0; u < 80; ++u)
        image(u, v) = down > 0.1 ? static_cast<float>(std::round(1200.0 / down)) : 0.0f;
    }
    WriteImageFile(folder / "000.png", image, CV_16UC1);
  }

  // Millimetres.
  static Image<float> Box(int frame) {
    Image<float> image(80, 60, 4000.0f);
    for (int v = 5; v < 55; ++v) {
      for (int u = 4 * frame; u < 4 * frame + 14; ++u) image(u, v) = v < 30 ? 2000.0f : 2020.0f;
    }
    return image;
  }

  SmallExperiment files_;
  Json config_;
};

TEST_F(DepthImport, WalkingPersonIsCutOutAsTheTruthSays) {
  MakeScene("room_walk.json", 10, 5.0, "ideal");
  ExpectTrueMasks(0);
}

TEST_F(DepthImport, SittingPersonIsCutOutAsTheTruthSays) {
  MakeScene("room_sit.json", 6, 3.0, "ideal");
  ExpectTrueMasks(1);  // in the first frame the chair is inside the standing person
}

// The noise of these sensors displaces edges and hides soles in the floor; at the size at which a
// pixel is one of the sensor's.
TEST_F(DepthImport, WalkingPersonIsCutOutUnderTheNoiseOfAKinectV1) {
  MakeScene("room_walk.json", 3, 1.6, "kinect_v1", kOfTheScene);
  ExpectTrueMasks(0);
}

TEST_F(DepthImport, SittingPersonIsCutOutUnderTheNoiseOfAKinectOne) {
  MakeScene("room_sit.json", 3, 1.6, "kinect_one", kOfTheScene);
  ExpectTrueMasks(1);
}

TEST_F(DepthImport, ResultIsTheSameForAnyNumberOfThreadsAndCanBeTracked) {
  MakeScene("room_walk.json", 6, 5.0, "kinect_v1");
  config_["subject"] = "scene/subject";
  ASSERT_EQ(Import("one", 1).code, 0);
  ASSERT_EQ(Import("three", 3).code, 0);
  EXPECT_EQ(SequenceReader(files_ / "one").hash(), SequenceReader(files_ / "three").hash());
  const CallResult verified = CallVitruvia({"synth", "--verify", files_.File("one")});
  EXPECT_EQ(verified.code, 0) << verified.error;
  const CallResult tracked =
      CallVitruvia({"track", (kConfigs / "methods/realtime_scape.json").string(), "--sequence",
                    files_.File("one"), "-o", files_.File("estimate")});
  ASSERT_EQ(tracked.code, 0) << tracked.error;
  const Json summary = Json::parse(tracked.out);
  EXPECT_LT(summary.at("fit_points_mean_m").get<double>(), 0.03);
  EXPECT_GT(summary.at("silhouette_overlap").get<double>(), 0.7);
  EXPECT_LT(summary.at("limb_length_change").get<double>(), 0.05);
}

// The same frames in every kind of file, turned and mirrored, give the same sequence.
TEST_F(DepthImport, FormatsUnitsAndOrientationsAgree) {
  MakeBoxes(12);
  ASSERT_EQ(Import("plain").code, 0);
  const std::string expected = SequenceReader(files_ / "plain").hash();
  const auto same = [&](const std::string& ending, double unit_m, int numbers,
                        const std::function<Image<float>(const Image<float>&)>& change) {
    fs::remove_all(files_ / "other");
    fs::create_directory(files_ / "other");
    for (int i = 0; i < 12; ++i) {
      Image<float> image = Box(i);
      for (float& z : image.pixels()) z = static_cast<float>(z * 0.001 / unit_m);
      WriteImageFile(files_ / fmt::format("other/{:03}{}", i, ending), change(image), numbers);
    }
    config_["images"] = "other";
    config_["unit_m"] = unit_m;
    const CallResult call = Import("changed");
    ASSERT_EQ(call.code, 0) << call.error;
    EXPECT_EQ(SequenceReader(files_ / "changed").hash(), expected) << ending;
  };
  const auto as_is = [](const Image<float>& image) { return image; };
  same(".pgm", 0.001, CV_16UC1, as_is);
  same(".tiff", 1.0, CV_32FC1, as_is);
  same(".exr", 1.0, CV_32FC1, as_is);
  same(".png", 0.02, CV_8UC1, as_is);
  // The camera lay on its side: what it calls right is down.
  config_["camera"] = {{"width", 60}, {"height", 80}, {"fx", 71},
                       {"fy", 71},    {"cx", 29.5},   {"cy", 39.5}};
  config_["orientation"] = {{"turn", "clockwise_90"}};
  same(".png", 0.001, CV_16UC1, [](const Image<float>& image) {
    Image<float> turned(60, 80);
    for (int v = 0; v < 80; ++v) {
      for (int u = 0; u < 60; ++u) turned(u, v) = image(79 - v, u);
    }
    return turned;
  });
}

TEST_F(DepthImport, MissingFramesStandAsEmptyOnesAndAreTold) {
  MakeBoxes(12);
  fs::remove(files_ / "boxes/005.png");
  const CallResult call = Import("imported");
  ASSERT_EQ(call.code, 0) << call.error;
  EXPECT_THAT(call.out,
              AllOf(HasSubstr("1 frames are missing"), HasSubstr("1 between 004.png and 006.png"),
                    HasSubstr("unsure of frame 5: the person is not seen")));
  EXPECT_EQ(SequenceReader(files_ / "imported").info().frames, 12);
  config_["missing_frames"] = "skip";
  ASSERT_EQ(Import("skipped").code, 0);
  EXPECT_EQ(SequenceReader(files_ / "skipped").info().frames, 11);
}

TEST_F(DepthImport, BadInputIsNamedAndNothingIsWritten) {
  MakeBoxes(12);
  const Json good = config_;
  config_["unit_m"] = 1.0;
  ExpectRefused(ExitCode::kBadData, {"median depth is", "is `unit_m` 0.001 meant?"});
  config_ = good;
  config_["camera"] = {{"width", 160}, {"height", 120}, {"fx", 142},
                       {"fy", 142},    {"cx", 79.5},    {"cy", 59.5}};
  ExpectRefused(ExitCode::kBadData,
                {"000.png", "80×60 pixels, expected 160×120", "fx 71, fy 71, cx 39.5, cy 29.5"});
  config_ = good;
  config_["camera"].erase("cx");
  ExpectRefused(ExitCode::kBadConfiguration, {"camera.cx"});
  config_ = good;
  config_["cutout"] = {{"far_m", 1.5}};
  ExpectRefused(ExitCode::kBadData, {"no person is found in any of 12 frames", "stand still"});
  WriteFloor(files_ / "floor");
  config_["empty_frames"] = {{"images", "floor"}};
  config_["cutout"] = {{"far_m", 3.0},
                       {"background", {{"source", "empty_frames"}}},
                       {"person", {{"size", {{"least_height_m", 2.0}}}}}};
  ExpectRefused(ExitCode::kBadData,
                {"no person is found", "cutout.floor", "1.20 m under the camera, tilted"});
  config_ = good;
  config_["camera"]["fx"] = config_["camera"]["fy"] = 25;
  ExpectRefused(ExitCode::kBadData, {"no person is found", "focal lengths", "fx 25, fy 25"});
  config_ = good;
  config_["cutout"] = {{"person", {{"choose", "pixel"}, {"u", 79}, {"v", 3}}}};
  ExpectRefused(ExitCode::kBadData, {"nobody is at column 79, row 3 of frame 0"});
  config_["cutout"] = {{"background", {{"source", "empty_frames"}}}};
  ExpectRefused(ExitCode::kBadConfiguration, {"names neither images nor a count"});
  fs::create_directory(files_ / "nothing");
  WriteImageFile(files_ / "nothing/000.png", Image<float>(80, 60), CV_16UC1);
  config_["empty_frames"] = {{"images", "nothing"}};
  ExpectRefused(ExitCode::kBadData,
                {"nothing: empty_frames", "none of 1 frames looked at holds a measurement"});
  WriteImageFile(files_ / "nothing/000.png", Image<float>(80, 60, 65535.0f), CV_16UC1);
  ExpectRefused(ExitCode::kBadData, {"nothing: empty_frames", "every pixel of 1 frames",
                                     "65.54 m, beyond cutout.far_m (6 m)", "65535", "`invalid`"});
  config_ = good;
  config_["invalid"] = {2000, 2020, 4000};
  ExpectRefused(ExitCode::kBadData, {"holds a measurement", "empty frames"});
  config_ = good;
  WriteImageFile(files_ / "boxes/007.png", Image<float>(80, 60, 200.0f), CV_8UC1);
  ExpectRefused(ExitCode::kBadData,
                {"007.png", "8-bit whole numbers, expected 16-bit whole numbers"});
  WriteWholeFile(files_ / "boxes/007.png", "damaged");
  ExpectRefused(ExitCode::kBadData, {"007.png", "cannot be decoded"});
}

TEST_F(DepthImport, OnePixelOfAFrameIsAMeasurement) {
  MakeBoxes(1);
  Image<float> image(80, 60);
  image(41, 30) = 2000.0f;
  WriteImageFile(files_ / "boxes/000.png", image, CV_16UC1);
  ExpectRefused(ExitCode::kBadData, {"no person is found in any of 1 frames"});
}

TEST_F(DepthImport, FrameOfAnotherUnitIsNamed) {
  MakeBoxes(12);
  Image<float> image = Box(6);
  for (float& z : image.pixels()) z *= 10.0f;
  WriteImageFile(files_ / "boxes/006.png", image, CV_16UC1);
  const CallResult call = Import("imported");
  ASSERT_EQ(call.code, 0) << call.error;
  EXPECT_THAT(call.out, HasSubstr("unsure of frame 6: the person is not seen; its median depth is "
                                  "40 m, 4 m in the recording: has it another unit?"));
}

// One real frame of a Kinect: each of five people who stand side by side can be chosen.
TEST_F(DepthImport, FivePeopleOfARealFrameAreToldApart) {
  const char* data = std::getenv("VITRUVIA_DATA");
  if (data == nullptr) GTEST_SKIP() << "VITRUVIA_DATA is not set";
  const fs::path cloud = fs::path(data) / "real_depth/five_people.pcd";
  if (!fs::exists(cloud)) GTEST_SKIP() << cloud << " is not there";
  const std::vector<std::array<int, 2>> pixels{
      {90, 280}, {193, 273}, {333, 220}, {427, 220}, {533, 280}};
  std::vector<MaskImage> masks;
  for (const auto& [u, v] : pixels) {
    config_ = {
        {"images", cloud.string()},
        {"camera",
         {{"width", 640}, {"height", 480}, {"fx", 525}, {"fy", 525}, {"cx", 319.5}, {"cy", 239.5}}},
        {"unit_m", 1.0},
        {"cutout",
         {{"background", {{"source", "none"}}},
          {"far_m", 4.0},
          {"person", {{"choose", "pixel"}, {"u", u}, {"v", v}}}}}};
    const CallResult call = Import("person");
    ASSERT_EQ(call.code, 0) << call.error;
    masks.push_back(SequenceReader(files_ / "person").ReadMask(0));
    fs::remove_all(files_ / "person");
  }
  for (std::size_t i = 0; i < masks.size(); ++i) {
    for (std::size_t j = 0; j < masks.size(); ++j) {
      const auto& [u, v] = pixels[j];
      EXPECT_EQ(masks[i](u, v) != 0, i == j) << "person " << i << " at that of " << j;
    }
    const auto kept = std::count(masks[i].pixels().begin(), masks[i].pixels().end(), 255);
    EXPECT_GT(kept, 15000) << i;
    EXPECT_LT(kept, 45000) << i;
  }
}

}  // namespace
}  // namespace vitruvia
