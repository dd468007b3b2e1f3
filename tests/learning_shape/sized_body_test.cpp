#include "learning/shape/sized_body.h"

#include <gtest/gtest.h>

#include "small_database.h"

namespace vitruvia {
namespace {

constexpr double kMostUnusual = 3.0;

const ShapeSpace& WholeSpace() {
  static const ShapeSpace space = [] {
    std::vector<int> all(SmallDatabase().subjects.size());
    for (std::size_t s = 0; s < all.size(); ++s) all[s] = static_cast<int>(s);
    return LearnShapeSpace(SmallDatabase(), all, {.components = 8});
  }();
  return space;
}

BodyModel BodyOf(const KnownAttributes& known) {
  return SizedBody(WholeSpace(), ShapeOfSize(WholeSpace(), known, 8, kMostUnusual), known.sex);
}

TEST(SizedBody, HasTheHeightThatIsKnownFromSmallChildToTallMan) {
  for (const double height_m : {0.8, 1.0, 1.5, 1.75, 2.1}) {
    const BodyModel body = BodyOf({height_m, {}, {}});
    EXPECT_NEAR(BoundingBox(body.rest.vertices).sizes().y(), height_m, 1e-4);
    EXPECT_NEAR(body.attributes.height_m, height_m, 1e-4);
    EXPECT_NO_THROW(CheckBodyModel(body, "body"));
  }
}

TEST(SizedBody, HasTheWeightThatIsKnown) {
  const BodyModel body = BodyOf({1.78, 84.0, Sex::kMale});
  EXPECT_NEAR(body.attributes.height_m, 1.78, 1e-3);
  EXPECT_NEAR(body.attributes.weight_kg, 84.0, 0.2);
}

TEST(SizedBody, IsTheMeanWhereNothingIsKnown) {
  const SizedShape shape = ShapeOfSize(WholeSpace(), {}, 8, kMostUnusual);
  EXPECT_EQ(shape.theta.norm(), 0.0);
  EXPECT_EQ(shape.scale, 1.0);
}

TEST(SizedBody, StaysWithinTheSpaceAndIsScaledBeyond) {
  const SizedShape child = ShapeOfSize(WholeSpace(), {1.0, {}, {}}, 8, kMostUnusual);
  EXPECT_LE(child.theta.norm(), kMostUnusual + 1e-9);
  EXPECT_LT(child.scale, 0.8);
  const SizedShape usual = ShapeOfSize(WholeSpace(), {1.72, {}, {}}, 8, kMostUnusual);
  EXPECT_NEAR(usual.scale, 1.0, 0.02);
}

TEST(SizedBody, SkeletonGrowsWithTheBody) {
  const BodyModel small = BodyOf({1.0, {}, {}}), tall = BodyOf({1.9, {}, {}});
  const auto thigh_m = [](const BodyModel& body) {
    return (body.skeleton.joints[static_cast<int>(BoneId::kLeftShin)] -
            body.skeleton.joints[static_cast<int>(BoneId::kLeftThigh)])
        .norm();
  };
  EXPECT_NEAR(thigh_m(tall) / thigh_m(small), 1.9, 0.15);
}

}  // namespace
}  // namespace vitruvia
