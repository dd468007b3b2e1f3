#include "cutout/outline.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cutout/cutout.h"
#include "geometry/mask_png.h"
#include "room_views.h"

namespace vitruvia {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr int kWidth = 320, kHeight = 240;
constexpr float kWall_m = 4.0f, kPerson_m = 3.0f;

const PinholeCamera& Camera() {
  static const PinholeCamera camera{kWidth, kHeight, 285.0, 285.0, 159.5, 119.5};
  return camera;
}

RoomView Empty() { return {.wall_m = kWall_m, .camera_height_m = 1.1, .pitch = 0.15}; }

// The room with nobody in it, known exactly.
Room KnownRoom(double noise_at_1m_m) {
  Room room;
  room.camera = Camera();
  room.background = Empty().Rendered(Camera());
  room.noise_at_1m_m = noise_at_1m_m;
  return room;
}

// What the pixels within a pixel or so of each one show, as a sensor that displaces edges has it.
DepthImage WithDisplacedEdges(const DepthImage& depth, double by_px, RandomStream& random) {
  DepthImage displaced = depth;
  for (int v = 3; v < depth.height() - 3; ++v) {
    for (int u = 3; u < depth.width() - 3; ++u) {
      const int du = static_cast<int>(std::lround(random.Normal(0.0, by_px)));
      const int dv = static_cast<int>(std::lround(random.Normal(0.0, by_px)));
      displaced(u, v) = depth(u + std::clamp(du, -3, 3), v + std::clamp(dv, -3, 3));
    }
  }
  return displaced;
}

// One person: every piece.
Image<std::uint8_t> OnePerson(const Pieces& pieces) {
  Image<std::uint8_t> people(pieces.labels.width(), pieces.labels.height());
  for (std::size_t i = 0; i < people.pixels().size(); ++i)
    people.pixels()[i] = pieces.labels.pixels()[i] != 0 ? 1 : 0;
  return people;
}

// Shared pixels / pixels of either.
double Overlap(const Image<std::uint8_t>& people, const Image<std::uint8_t>& truth) {
  int shared = 0, either = 0;
  for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
    const bool a = people.pixels()[i] != 0, b = truth.pixels()[i] != 0;
    shared += a && b ? 1 : 0;
    either += a || b ? 1 : 0;
  }
  return static_cast<double>(shared) / either;
}

Image<std::uint8_t> TruthOf(const DepthImage& clean) {
  Image<std::uint8_t> truth(clean.width(), clean.height());
  for (std::size_t i = 0; i < truth.pixels().size(); ++i)
    truth.pixels()[i] = clean.pixels()[i] == kPerson_m ? 1 : 0;
  return truth;
}

struct CutOut {
  Pieces pieces;
  Image<std::uint8_t> measured;  // each pixel by its own depth
  OutlinedPeople smoothed;
};

CutOut CutOutOf(const DepthImage& depth, const Room& room, const CutoutSettings& settings = {}) {
  CutOut cut{PiecesOf(depth, room, settings), {}, {}};
  cut.measured = OnePerson(cut.pieces);
  cut.smoothed = SmoothOutlines(depth, cut.pieces, room, settings, cut.measured);
  return cut;
}

// A body with an arm, whose edges are displaced by 0.8 pixels.
TEST(SmoothOutlines, UndoesTheDisplacementOfEdges) {
  RandomStream random(3, "test");
  RoomView view = Empty();
  view.boxes = {{-0.2, 0.2, -0.6, 0.4, kPerson_m}, {0.2, 0.7, -0.5, -0.38, kPerson_m}};
  const DepthImage clean = view.Rendered(Camera());
  const CutOut cut = CutOutOf(WithDisplacedEdges(clean, 0.8, random), KnownRoom(0.0));
  const double before = Overlap(cut.measured, TruthOf(clean));
  const double after = Overlap(cut.smoothed.people, TruthOf(clean));
  EXPECT_LT(before, 0.955);
  EXPECT_GT(after, 0.975);
}

TEST(SmoothOutlines, KeepsTheOutlineThatIsMeasuredWithoutError) {
  RoomView view = Empty();
  view.boxes = {{-0.2, 0.2, -0.6, 0.4, kPerson_m}, {0.2, 0.7, -0.5, -0.38, kPerson_m}};
  const DepthImage clean = view.Rendered(Camera());
  const CutOut cut = CutOutOf(clean, KnownRoom(0.0));
  EXPECT_EQ(Overlap(cut.measured, TruthOf(clean)), 1.0);
  EXPECT_GT(Overlap(cut.smoothed.people, TruthOf(clean)), 0.995);  // corners are rounded
}

// A forearm of one or two pixels has less than half of the votes round it.
TEST(SmoothOutlines, KeepsALimbThatIsThinnerThanTheReach) {
  RoomView view = Empty();
  view.boxes = {{-0.2, 0.2, -0.6, 0.4, kPerson_m}};
  DepthImage depth = view.Rendered(Camera());
  const int right = 179;
  ASSERT_TRUE(depth(right - 1, 100) == kPerson_m && depth(right, 100) != kPerson_m);
  const auto add = [&](int u, int v) { depth(u, v) = kPerson_m; };
  for (int u = right; u < right + 15; ++u) {
    add(u, 80), add(u, 100), add(u, 101);           // one pixel, and two
    depth(u, 120) = u % 5 == 4 ? 0.0f : kPerson_m;  // with gaps
    add(u, 130 + (u - right) / 2);                  // slanting
  }
  const CutOut cut = CutOutOf(depth, KnownRoom(0.001));
  for (int v = 75; v < 145; ++v) {
    for (int u = right + 3; u < right + 15; ++u) {
      const bool is_limb = depth(u, v) == kPerson_m && cut.measured(u, v) != 0;
      EXPECT_TRUE(!is_limb || cut.smoothed.people(u, v) == 1) << u << " " << v;
    }
  }
}

TEST(SmoothOutlines, DropsTheRoughnessOfAnEdge) {
  RoomView view = Empty();
  view.boxes = {{-0.2, 0.2, -0.6, 0.4, kPerson_m}};
  DepthImage depth = view.Rendered(Camera());
  const int right = 179;
  for (const int length : {1, 2, 3}) {
    for (int u = right; u < right + length; ++u) depth(u, 80 + 10 * length) = kPerson_m;
  }
  const CutOut cut = CutOutOf(depth, KnownRoom(0.001));
  for (const int length : {1, 2, 3}) {
    EXPECT_EQ(cut.measured(right + length - 1, 80 + 10 * length), 1) << length;
    EXPECT_EQ(cut.smoothed.people(right + length - 1, 80 + 10 * length), 0) << length;
  }
}

// Near the floor a foot differs from it by less than the noise of one pixel, but several pixels
// together tell them apart.
TEST(SmoothOutlines, FollowsAFootDownToTheFloor) {
  RandomStream random(5, "test");
  RoomView view = Empty();
  view.boxes = {{-0.15, 0.15, -0.6, 0.65, kPerson_m}};  // its lower edge is on the floor
  const DepthImage clean = view.Rendered(Camera());
  constexpr double kNoise = 0.003;
  const DepthImage depth = Noisy(clean, kNoise, random);
  const CutOut cut = CutOutOf(depth, KnownRoom(kNoise));
  const auto lost = [&](const Image<std::uint8_t>& people) {
    int count = 0;
    for (int v = 170; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u)
        count += clean(u, v) == kPerson_m && people(u, v) == 0 ? 1 : 0;
    }
    return count;
  };
  const int columns = static_cast<int>(0.3 * 285.0 / kPerson_m);
  EXPECT_GT(lost(cut.measured), 2 * columns);
  EXPECT_LT(lost(cut.smoothed.people), columns);
}

TEST(SmoothOutlines, NamesPixelsThatHoldAnotherDepthThanThePersons) {
  RoomView view = Empty();
  view.boxes = {{-0.2, 0.2, -0.6, 0.4, kPerson_m}};
  DepthImage depth = view.Rendered(Camera());
  const int u = 160, v = 120;
  depth(u, v) = kWall_m;         // an edge, displaced onto it
  depth(u, v + 10) = 3.5f;       // a mixture
  depth(u, v + 20) = 0.0f;       // nothing is measured
  depth(u, v + 30) = kPerson_m;  // the person
  const CutOut cut = CutOutOf(depth, KnownRoom(0.001));
  for (const int down : {0, 10, 20, 30}) EXPECT_EQ(cut.smoothed.people(u, v + down), 1) << down;
  EXPECT_THAT(cut.smoothed.foreign_depth, ElementsAre(v * kWidth + u, (v + 10) * kWidth + u));
  const MaskImage mask = MaskOf(cut.smoothed, ChosenPerson{{1}});
  EXPECT_EQ(mask(u, v), kForeignDepthMask);
  EXPECT_EQ(mask(u, v + 10), kForeignDepthMask);
  EXPECT_EQ(mask(u, v + 20), kSubjectMask);
  EXPECT_EQ(mask(u, v + 30), kSubjectMask);
  EXPECT_EQ(mask(5, 5), 0);
  EXPECT_EQ(MaskOf(cut.smoothed, ChosenPerson{{2}})(u, v), 0);
}

TEST(SmoothOutlines, LeavesTheBoundaryBetweenTwoPeopleAndOtherPieces) {
  RoomView view = Empty();
  view.boxes = {{-0.4, 0.4, -0.6, 0.4, kPerson_m}, {0.5, 0.8, -0.6, 0.4, 2.0}};
  const DepthImage depth = view.Rendered(Camera());
  const Room room = KnownRoom(0.001);
  const CutoutSettings settings;
  const Pieces pieces = PiecesOf(depth, room, settings);
  Image<std::uint8_t> people(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      // A jagged boundary between the two, and a third piece that is nobody's.
      if (depth(u, v) == kPerson_m) people(u, v) = u + v % 3 < 160 ? 1 : 2;
    }
  }
  const OutlinedPeople smoothed = SmoothOutlines(depth, pieces, room, settings, people);
  for (int v = 70; v < 150; ++v) {
    for (int u = 150; u < 170; ++u) ASSERT_EQ(smoothed.people(u, v), people(u, v)) << u << " " << v;
    for (int u = 0; u < kWidth; ++u) {
      ASSERT_TRUE(depth(u, v) != 2.0f || smoothed.people(u, v) == 0) << u << " " << v;
    }
  }
  EXPECT_THAT(smoothed.foreign_depth, IsEmpty());
}

TEST(SmoothOutlines, LeavesEverythingWithoutReach) {
  RandomStream random(3, "test");
  RoomView view = Empty();
  view.boxes = {{-0.2, 0.2, -0.6, 0.4, kPerson_m}};
  CutoutSettings settings;
  settings.outline.reach_px = 0;
  const DepthImage depth = WithDisplacedEdges(view.Rendered(Camera()), 0.8, random);
  const CutOut cut = CutOutOf(depth, KnownRoom(0.0), settings);
  EXPECT_EQ(cut.smoothed.people.pixels(), cut.measured.pixels());
}

// A person who is cut by the image's rim, in every corner.
TEST(SmoothOutlines, ReachesTheRimOfTheImage) {
  RoomView view{.wall_m = kWall_m};
  view.boxes = {{-9.0, 9.0, -9.0, 9.0, kPerson_m}};
  const DepthImage depth = view.Rendered(Camera());
  Room room = KnownRoom(0.0);
  room.background = RoomView{.wall_m = kWall_m}.Rendered(Camera());
  CutoutSettings settings;
  settings.person.size = {0.0, 99.0, 99.0, 0.0};
  const CutOut cut = CutOutOf(depth, room, settings);
  EXPECT_EQ(cut.smoothed.people.pixels(), Image<std::uint8_t>(kWidth, kHeight, 1).pixels());
}

TEST(RoomDepthAt, IsTheFloorWhereNoBackgroundIsKnown) {
  Room room;
  room.camera = Camera();
  room.background = DepthImage(kWidth, kHeight);
  room.background(10, 200) = 2.0f;
  room.noise_at_1m_m = 0.002;
  const CutoutSettings settings;
  EXPECT_TRUE(std::isinf(RoomDepthAt(room, settings, 160, 200).depth_m));
  FloorPlane floor;
  floor.up = Empty().Up().cast<float>();
  floor.height_m = 1.1f;
  room.floor = floor;
  const RoomDepth below = RoomDepthAt(room, settings, 160, 200);
  EXPECT_NEAR(below.depth_m, Empty().Rendered(Camera())(160, 200), 1e-3);
  EXPECT_NEAR(below.margin_m, 3.0 * 0.002 * below.depth_m * below.depth_m, 1e-4);
  EXPECT_TRUE(std::isinf(RoomDepthAt(room, settings, 160, 20).depth_m));  // above the horizon
  EXPECT_EQ(RoomDepthAt(room, settings, 10, 200).depth_m, 2.0f);
  EXPECT_TRUE(RoomDepthAt(room, settings, 10, 200).IsInFront(1.97f));
  EXPECT_FALSE(RoomDepthAt(room, settings, 10, 200).IsInFront(1.98f));
}

}  // namespace
}  // namespace vitruvia
