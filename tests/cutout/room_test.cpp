#include "cutout/room.h"

#include <gtest/gtest.h>

#include "room_views.h"

namespace vitruvia {
namespace {

int CountOf(const MaskImage& mask) {
  return static_cast<int>(std::count(mask.pixels().begin(), mask.pixels().end(), 255));
}

TEST(LearnRoom, FindsAKnownFloorUnderNoise) {
  RandomStream random(3, "test");
  RoomView view{.wall_m = 4.5, .camera_height_m = 1.2, .pitch = 0.25};
  view.boxes = {{-0.3, 0.3, -0.5, 1.1, 2.8}};
  std::vector<DepthImage> frames;
  for (int i = 0; i < 10; ++i) frames.push_back(Noisy(view.Rendered(), 0.0015, random));
  CutoutSettings settings;
  settings.background.source = BackgroundSource::kNone;
  const Room room = LearnRoom(frames, {}, RoomCamera(), settings);
  ASSERT_TRUE(room.floor.has_value());
  EXPECT_GT(room.floor->up.cast<double>().dot(view.Up()), std::cos(0.3 * M_PI / 180.0));
  EXPECT_NEAR(room.floor->height_m, 1.2, 0.005);
}

TEST(LearnRoom, TakesNoTableForTheFloor) {
  // A level plane half way down, seen before a wall that goes on below it.
  RoomView table{.wall_m = 0.0, .camera_height_m = 0.5, .pitch = 0.3};
  DepthImage depth = table.Rendered();
  const PinholeCamera camera = RoomCamera();
  RoomView floor{.wall_m = 4.0, .camera_height_m = 1.3, .pitch = 0.3};
  const DepthImage below = floor.Rendered();
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const float z = depth(u, v);
      if (!(z > 1.2f && z < 1.8f && u > 30 && u < 130)) depth(u, v) = below(u, v);
    }
  }
  CutoutSettings settings;
  settings.background.source = BackgroundSource::kNone;
  const Room room = LearnRoom({depth}, {}, camera, settings);
  ASSERT_TRUE(room.floor.has_value());
  EXPECT_NEAR(room.floor->height_m, 1.3, 0.01);
}

TEST(LearnRoom, HasNoFloorWhereThereIsNone) {
  const RoomView wall{.wall_m = 3.0};
  CutoutSettings settings;
  EXPECT_FALSE(LearnRoom({wall.Rendered()}, {}, RoomCamera(), settings).floor.has_value());
}

// A strip along the lower rim of a wall has the points of a tilted plane.
TEST(LearnRoom, TakesNoStripOfAWallForTheFloor) {
  RandomStream random(7, "test");
  constexpr double kNoise = 0.0014;
  for (const double wall_m : {1.5, 3.0, 4.5}) {
    const DepthImage wall = RoomView{.wall_m = wall_m}.Rendered();
    std::vector<DepthImage> frames;
    for (int i = 0; i < 4; ++i) frames.push_back(Noisy(wall, kNoise, random));
    for (const double tilt_deg : {20.0, 45.0, 60.0}) {
      CutoutSettings settings;
      settings.floor.tilt_deg = tilt_deg;
      const Room room = LearnRoom(frames, {}, RoomCamera(), settings);
      EXPECT_FALSE(room.floor.has_value())
          << wall_m << " m, " << tilt_deg << " degrees: " << room.floor->TiltDegrees();
    }
  }
}

TEST(LearnRoom, MeasuresTheNoiseOfTheSensor) {
  RandomStream random(5, "test");
  const RoomView view{.wall_m = 3.0, .camera_height_m = 1.0, .pitch = 0.2};
  std::vector<DepthImage> frames;
  for (int i = 0; i < 6; ++i) frames.push_back(Noisy(view.Rendered(), 0.002, random));
  EXPECT_NEAR(LearnRoom(frames, {}, RoomCamera(), CutoutSettings()).noise_at_1m_m, 0.002, 0.0001);
}

// A sensor that measures in steps of 5 cm, with noise of 2 cm.
TEST(LearnRoom, LearnsTheBackgroundToAFractionOfTheSensorsStep) {
  RandomStream random(5, "test");
  const RoomView view{.wall_m = 3.16};
  std::vector<DepthImage> empty;
  for (int i = 0; i < 40; ++i) {
    empty.push_back(Noisy(view.Rendered(), 0.002, random));
    for (float& z : empty.back().pixels()) z = 0.05f * std::round(z / 0.05f);
  }
  CutoutSettings settings;
  settings.background.source = BackgroundSource::kEmptyFrames;
  const Room room = LearnRoom(empty, empty, RoomCamera(), settings);
  double sum = 0.0;
  for (const float z : room.background.pixels()) sum += std::abs(z - 3.16);
  EXPECT_LT(sum / static_cast<double>(room.background.pixels().size()), 0.005);
}

TEST(LearnRoom, ResultDoesNotDependOnAnythingButItsInput) {
  const RoomView view{.wall_m = 4.0, .camera_height_m = 1.2, .pitch = 0.2};
  const auto height = [&] {
    return LearnRoom({view.Rendered()}, {}, RoomCamera(), CutoutSettings()).floor->height_m;
  };
  EXPECT_EQ(height(), height());
}

// A box that moves from side to side: what stands still is the room, and the box is all that is
// left, pixel by pixel.
TEST(ForegroundOf, LeavesWhatMovesBeforeTheRecordingsOwnBackground) {
  std::vector<DepthImage> frames;
  RoomView view{.wall_m = 4.0, .camera_height_m = 1.2, .pitch = 0.2};
  for (int i = 0; i < 24; ++i) {
    const double x = -1.4 + 0.12 * i;
    view.boxes = {{x - 0.1, x + 0.1, -0.5, 0.6, 2.5}};
    frames.push_back(view.Rendered());
  }
  const CutoutSettings settings;
  const Room room = LearnRoom(frames, {}, RoomCamera(), settings);
  for (const int i : {0, 7, 23}) {
    const DepthImage& depth = frames[static_cast<std::size_t>(i)];
    const MaskImage foreground = ForegroundOf(depth, room, settings);
    for (std::size_t k = 0; k < depth.pixels().size(); ++k)
      ASSERT_EQ(foreground.pixels()[k] != 0, depth.pixels()[k] == 2.5f) << "frame " << i;
  }
}

// The sole of a box that stands on the floor: the floor goes, the box stays down to its last rows.
TEST(ForegroundOf, RemovesTheFloorWithoutTheFeet) {
  const PinholeCamera camera{320, 240, 285.0, 285.0, 159.5, 119.5};
  RandomStream random(9, "test");
  RoomView view{.wall_m = 5.0, .camera_height_m = 1.1, .pitch = 0.15};
  view.boxes = {{-0.15, 0.15, -0.6, 0.66, 3.0}};  // its lower edge is on the floor at 3 m
  const DepthImage clean = view.Rendered(camera);
  const std::vector<DepthImage> frames{Noisy(clean, 0.0005, random)};
  CutoutSettings settings;
  settings.background.source = BackgroundSource::kNone;
  settings.noise_at_1m_m = 0.0005;
  const Room room = LearnRoom(frames, {}, camera, settings);
  ASSERT_TRUE(room.floor.has_value());
  const MaskImage foreground = ForegroundOf(frames.front(), room, settings);
  int lowest_true = 0, lowest_kept = 0, floor_kept = 0;
  for (int v = 0; v < camera.height; ++v) {
    if (clean(160, v) == 3.0f) lowest_true = v;
    if (clean(160, v) == 3.0f && foreground(160, v) != 0) lowest_kept = v;
    for (int u = 0; u < camera.width; ++u)
      floor_kept += foreground(u, v) != 0 && clean(u, v) != 3.0f && clean(u, v) < 4.5f ? 1 : 0;
  }
  EXPECT_GE(lowest_kept, lowest_true - 2);
  EXPECT_LT(floor_kept, 10);
}

TEST(ForegroundOf, KeepsToTheRangeOfDepth) {
  CutoutSettings settings;
  settings.near_m = 1.0;
  settings.far_m = 3.5;
  settings.background.source = BackgroundSource::kNone;
  Room room;
  room.camera = RoomCamera();
  room.background = DepthImage(room.camera.width, room.camera.height);
  RoomView view{.wall_m = 4.0};
  view.boxes = {{-1.0, 0.0, -1.0, 1.0, 2.0}, {0.3, 0.4, -0.1, 0.1, 0.9}};
  const DepthImage depth = view.Rendered();
  const auto two_metres = std::count(depth.pixels().begin(), depth.pixels().end(), 2.0f);
  EXPECT_EQ(CountOf(ForegroundOf(depth, room, settings)), two_metres);
}

}  // namespace
}  // namespace vitruvia
