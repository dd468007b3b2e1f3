#include "cutout/cutout.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cutout/packed_labels.h"
#include "room_views.h"

namespace vitruvia {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kFps = 30.0;

// Nothing stands still, so that every box is foreground.
Room EmptyRoom() {
  Room room;
  room.camera = RoomCamera();
  room.background = DepthImage(room.camera.width, room.camera.height);
  return room;
}

FrontBox Person(double x, double depth, double half_width = 0.2) {
  return {x - half_width, x + half_width, -0.8, 0.8, depth};
}

DepthImage ViewOf(const std::vector<FrontBox>& boxes) {
  RoomView view{.wall_m = 0.0};
  view.boxes = boxes;
  return view.Rendered();
}

Pieces PiecesIn(const DepthImage& depth) { return PiecesOf(depth, EmptyRoom(), CutoutSettings()); }

TEST(FindPieces, SeparatesWhatDiffersInDepthAndMeasuresIt) {
  const Pieces pieces = PiecesIn(ViewOf({Person(-0.2, 2.0), Person(0.3, 2.6)}));
  ASSERT_EQ(pieces.pieces.size(), 2u);
  const Piece& nearer = pieces.pieces[0].mean_depth_m < 2.3 ? pieces.pieces[0] : pieces.pieces[1];
  EXPECT_NEAR(nearer.area_m2, 0.4 * 1.6, 0.03);
  EXPECT_NEAR(nearer.height_m(), 1.6, 0.03);
  EXPECT_DOUBLE_EQ(nearer.mean_depth_m, 2.0);
  EXPECT_TRUE(nearer.person_sized);
}

TEST(FindPieces, GoesOnBehindAnArmButNotWhereTheWallShows) {
  const FrontBox arm{-0.03, 0.03, -1.2, 1.2, 1.5};
  EXPECT_EQ(PiecesIn(ViewOf({Person(0.0, 2.0), arm})).pieces.size(), 2u);  // the arm, one body
  // Two bodies of one depth with a gap between them: nothing is measured in it, so they may be one.
  const std::vector<FrontBox> two{Person(-0.3, 2.0), Person(0.3, 2.0)};
  const DepthImage apart = ViewOf(two);
  const CutoutSettings defaults;
  EXPECT_EQ(FindPieces(apart, ForegroundOf(apart, EmptyRoom(), defaults), EmptyRoom(), defaults)
                .pieces.size(),
            1u);
  RoomView before_wall{.wall_m = 4.0};
  before_wall.boxes = two;
  CutoutSettings settings;
  settings.far_m = 3.0;
  EXPECT_EQ(PiecesOf(before_wall.Rendered(), EmptyRoom(), settings).pieces.size(), 2u);
}

// Two people side by side who touch along arms and legs; their heads stick out.
TEST(DivideTouchingPeople, CutsBetweenHeads) {
  const auto head = [](double x) { return FrontBox{x - 0.08, x + 0.08, -1.05, -0.7, 3.0}; };
  const FrontBox bodies{-0.4, 0.4, -0.7, 0.8, 3.0};
  const DepthImage depth = ViewOf({bodies, head(-0.22), head(0.22)});
  const Pieces pieces = PiecesIn(depth);
  ASSERT_EQ(pieces.pieces.size(), 2u);
  const PinholeCamera camera = RoomCamera();
  const int left = pieces.labels(static_cast<int>(camera.cx) - 10, 60);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (pieces.labels(u, v) != 0) {
        ASSERT_EQ(pieces.labels(u, v) == left, u < camera.cx) << u << " " << v;
      }
    }
  }
}

TEST(DivideTouchingPeople, LeavesARaisedHandWithItsBody) {
  const FrontBox head{-0.08, 0.08, -1.05, -0.7, 3.0}, body{-0.2, 0.2, -0.7, 0.8, 3.0};
  const FrontBox thin_arm{0.17, 0.2, -1.15, -0.7, 3.0};
  EXPECT_EQ(PiecesIn(ViewOf({body, head, thin_arm})).pieces.size(), 1u);
  const FrontBox shoulder{0.2, 0.6, -0.7, -0.6, 3.0}, thick_arm{0.45, 0.6, -1.1, -0.6, 3.0};
  EXPECT_EQ(PiecesIn(ViewOf({body, head, shoulder, thick_arm})).pieces.size(), 1u);
}

TEST(FindPieces, DropsSpecksAndKnowsWhatIsNoPerson) {
  const Pieces pieces =
      PiecesIn(ViewOf({{-0.01, 0.01, -0.01, 0.01, 2.0}, {0.3, 0.6, -0.1, 0.1, 2.0}}));
  ASSERT_EQ(pieces.pieces.size(), 1u);
  EXPECT_FALSE(pieces.pieces[0].person_sized);
}

class Following : public testing::Test {
 protected:
  Image<std::uint8_t> See(const std::vector<FrontBox>& boxes) {
    const DepthImage depth = ViewOf(boxes);
    return follower_.Follow(depth, PiecesIn(depth));
  }

  int At(const Image<std::uint8_t>& people, double x, double depth) const {
    const auto uv = RoomCamera().Project(Vector3d(x, 0.0, depth));
    return people(static_cast<int>(uv.x()), static_cast<int>(uv.y()));
  }

  PeopleFollower follower_{EmptyRoom(), CutoutSettings(), kFps};
};

TEST_F(Following, PeopleKeepTheirNumbersWhenTheyPassEachOther) {
  int left = 0, right = 0;
  for (int i = 0; i <= 40; ++i) {
    const double x = -0.8 + 0.04 * i;
    const Image<std::uint8_t> people = See({Person(x, 2.0), Person(-x, 3.0)});
    if (i == 0) {
      left = At(people, x, 2.0);
      right = At(people, -x, 3.0);
    }
    ASSERT_EQ(At(people, x, 2.0), left) << i;
    if (i == 40) {
      EXPECT_EQ(At(people, -x, 3.0), right);
    }
  }
  EXPECT_NE(left, right);
  EXPECT_EQ(follower_.people().size(), 2u);
}

TEST_F(Following, PeopleWhoTouchAreDividedWhereTheyWere) {
  See({Person(-0.5, 2.0), Person(0.5, 2.0)});
  // Farther apart than a gap may be; now they touch.
  const Image<std::uint8_t> before = See({Person(-0.4, 2.0), Person(0.4, 2.0)});
  const int left = At(before, -0.4, 2.0), right = At(before, 0.4, 2.0);
  ASSERT_NE(left, right);
  const Image<std::uint8_t> touching = See({Person(-0.2, 2.0), Person(0.2, 2.0)});
  EXPECT_EQ(At(touching, -0.3, 2.0), left);
  EXPECT_EQ(At(touching, 0.3, 2.0), right);
  EXPECT_THAT(follower_.people()[0].touching, ElementsAre(2));
}

TEST_F(Following, SomebodyWhoLeavesAndComesBackIsChosenAsOne) {
  for (int i = 0; i < 5; ++i) See({Person(0.0, 2.0)});
  for (int i = 0; i < 40; ++i) See({});
  for (int i = 0; i < 5; ++i) See({Person(0.5, 2.5)});
  ASSERT_EQ(follower_.people().size(), 2u);
  const auto chosen = ChoosePerson(follower_.people(), PersonSettings(), 0);
  ASSERT_TRUE(chosen.has_value());
  EXPECT_THAT(chosen->numbers, testing::UnorderedElementsAre(1, 2));
  const CutoutReport report =
      ReportCutout(follower_.people(), *chosen, std::vector<double>(50, 0.1), FollowingSettings());
  EXPECT_EQ(report.frames_without_person, 40);
  EXPECT_EQ(report.area_jumps, 0);
}

TEST_F(Following, JumpInAreaIsTold) {
  for (int i = 0; i < 20; ++i) See({Person(0.0, 2.0, i == 9 ? 0.4 : 0.2)});
  const auto chosen = ChoosePerson(follower_.people(), PersonSettings(), 0);
  const CutoutReport report =
      ReportCutout(follower_.people(), *chosen, std::vector<double>(20, 0.1), FollowingSettings());
  EXPECT_EQ(report.area_jumps, 1);
  ASSERT_EQ(report.unsure.size(), 1u);
  EXPECT_EQ(report.unsure[0].frame, 9);
}

TEST_F(Following, LargestNearestAndPixelChooseDifferentPeople) {
  const Image<std::uint8_t> people =
      See({Person(-1.0, 3.0, 0.3), Person(0.0, 2.0, 0.15), Person(0.9, 2.5, 0.2)});
  ASSERT_EQ(follower_.people().size(), 3u);
  const auto first = [&](PersonChoice choose, int at_pixel) {
    PersonSettings settings;
    settings.choose = choose;
    return ChoosePerson(follower_.people(), settings, at_pixel)->numbers.front();
  };
  EXPECT_EQ(first(PersonChoice::kLargest, 0), At(people, -1.0, 3.0));
  EXPECT_EQ(first(PersonChoice::kNearest, 0), At(people, 0.0, 2.0));
  const int wanted = At(people, 0.9, 2.5);
  EXPECT_EQ(first(PersonChoice::kPixel, wanted), wanted);
  PersonSettings nobody;
  nobody.choose = PersonChoice::kPixel;
  EXPECT_FALSE(ChoosePerson(follower_.people(), nobody, 0).has_value());
  EXPECT_FALSE(ChoosePerson({}, PersonSettings(), 0).has_value());
}

TEST(PackedLabelImages, KeepEveryNumber) {
  Image<std::uint8_t> labels(7, 5);
  for (std::size_t i = 0; i < labels.pixels().size(); ++i)
    labels.pixels()[i] = static_cast<std::uint8_t>(7 * i);
  EXPECT_EQ(Unpacked(Pack(labels)).pixels(), labels.pixels());
}

}  // namespace
}  // namespace vitruvia
