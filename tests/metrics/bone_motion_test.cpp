#include "metrics/bone_motion.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/random.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

using Frames = std::vector<BoneRotations>;

// One bone that turns about `axis` by angle(i) in frame i.
template <class Angle>
Frames Turning(const Vector3d& axis, int frames, Angle angle) {
  Frames result;
  for (int i = 0; i < frames; ++i) result.push_back({ExpSo3<double>(angle(i) * axis)});
  return result;
}

TEST(RigidParts, GiveEachPartsOwnRotation) {
  RandomStream random(1, "parts");
  std::vector<Vector3f> rest(40), posed(40);
  std::vector<int> bones(40);
  const Matrix3<double> turns[] = {ExpSo3<double>({0.3, -1.2, 0.5}),
                                   ExpSo3<double>({-2.0, 0.1, 0.9})};
  for (int i = 0; i < 40; ++i) {
    rest[i] = {static_cast<float>(random.Normal()), static_cast<float>(random.Normal()),
               static_cast<float>(random.Normal())};
    bones[i] = i % 3 - 1;  // a third belongs to no bone, and lies anywhere
    const Vector3f shift(1.0f, 2.0f, static_cast<float>(i % 3));
    posed[i] = bones[i] < 0 ? Vector3f(9.0f, 9.0f, 9.0f)
                            : Vector3f(turns[bones[i]].cast<float>() * rest[i] + shift);
  }
  const BoneRotations rotations = RigidParts(rest, bones, 3).Rotations(posed);
  EXPECT_TRUE(rotations[0].isApprox(turns[0], 1e-5));
  EXPECT_TRUE(rotations[1].isApprox(turns[1], 1e-5));
  EXPECT_EQ(rotations[2], (Matrix3<double>::Identity())) << "a bone without vertices";
}

TEST(AngularAcceleration, IsThatOfASteadilyAcceleratedTurn) {
  // angle = ½ a t²: any three frames give a.
  const Frames frames =
      Turning(Vector3d::UnitY(), 6, [](int i) { return 0.5 * 4.0 * i * i / 900.0; });
  for (std::size_t i = 2; i < 6; ++i) {
    EXPECT_TRUE(AngularAcceleration(frames, i, 0, 30.0).isApprox(Vector3d(0, 4.0, 0), 1e-9));
  }
}

TEST(AngularJitter, IsZeroForTheTruthAndMeasuresWhatShakes) {
  const auto steady = [](int i) { return 0.1 * i; };
  const Frames truth = Turning(Vector3d::UnitX(), 20, steady);
  EXPECT_EQ(AngularJitter(truth, truth, 30.0), 0.0);
  // ±d in turn: second differences of ±4 d.
  const Frames shaking =
      Turning(Vector3d::UnitX(), 20, [&](int i) { return steady(i) + (i % 2 ? 0.01 : -0.01); });
  EXPECT_NEAR(AngularJitter(shaking, truth, 30.0), 0.04 * 900.0, 1e-6);
  // A constant offset does not shake.
  const Frames offset = Turning(Vector3d::UnitX(), 20, [&](int i) { return steady(i) + 0.2; });
  EXPECT_NEAR(AngularJitter(offset, truth, 30.0), 0.0, 1e-8);
}

TEST(Twist, IsTheTurnAboutTheAxisAlone) {
  const Vector3d axis = Vector3d(1.0, 2.0, -1.0).normalized();
  for (const double angle : {-3.0, -0.4, 0.0, 1.0, 3.0}) {
    EXPECT_NEAR(TwistAbout(ExpSo3<double>(angle * axis), axis), angle, 1e-9);
  }
  const Vector3d across = axis.cross(Vector3d::UnitX()).normalized();
  EXPECT_NEAR(TwistAbout(ExpSo3<double>(0.8 * across), axis), 0.0, 1e-12) << "a swing";
  EXPECT_NEAR(TwistAbout(ExpSo3<double>(0.8 * across) * ExpSo3<double>(0.3 * axis), axis), 0.3,
              1e-9);
}

TEST(Twist, ErrorIsTheRootMeanSquareOverBonesThatHaveAnAxis) {
  const Frames truth = Turning(Vector3d::UnitZ(), 4, [](int i) { return 0.3 * i; });
  Frames twisted = truth;
  for (auto& frame : twisted) frame[0] = frame[0] * ExpSo3<double>({0.2, 0.0, 0.0});
  EXPECT_NEAR(TwistError(twisted, truth, {Vector3d::UnitX()}), 0.2, 1e-9);
  EXPECT_NEAR(TwistError(twisted, truth, {Vector3d::UnitY()}), 0.0, 1e-9);
  EXPECT_EQ(TwistError(twisted, truth, {Vector3d::Zero()}), 0.0);
}

}  // namespace
}  // namespace vitruvia
