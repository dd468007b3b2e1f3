#include "math/rigid.h"

#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"
#include "math/rotation.h"
#include "tests/math/random_rigid.h"

namespace vitruvia {
namespace {

using Vec = Vector3<double>;
using Mat = Matrix3<double>;

constexpr double kPi = std::numbers::pi;
constexpr double kExact = 1e-14;  // some tens of roundings of numbers near 1

// At zero, next to it, on both sides of where ExpSo3 changes its formula, anywhere, and near π.
std::vector<Vec> RotationVectors() {
  RandomStream random(1, "rotations");
  std::vector<Vec> vectors{Vec::Zero()};
  for (const double angle : {1e-300, 1e-16, 1e-8, 0.999e-4, 1.001e-4, 1e-2, kPi - 1e-6}) {
    for (int i = 0; i < 5; ++i) vectors.push_back(angle * RandomDirection(random));
  }
  for (int i = 0; i < 50; ++i) {
    vectors.push_back(random.Uniform(0.0, 3.1) * RandomDirection(random));
  }
  return vectors;
}

TEST(ExpSo3, IsAProperRotation) {
  for (const Vec& r : RotationVectors()) {
    const Mat rotation = ExpSo3<double>(r);
    EXPECT_TRUE((rotation.transpose() * rotation).isIdentity(kExact)) << r.transpose();
    EXPECT_NEAR(rotation.determinant(), 1.0, kExact) << r.transpose();
  }
}

TEST(ExpSo3, AgreesWithAngleAndAxis) {
  for (const Vec& r : RotationVectors()) {
    if (r.isZero(0.0)) continue;
    const Mat expected = Eigen::AngleAxisd(r.norm(), r.stableNormalized()).toRotationMatrix();
    EXPECT_LT((ExpSo3<double>(r) - expected).cwiseAbs().maxCoeff(), kExact) << r.transpose();
  }
}

TEST(ExpSo3, TurnsByTheRightHandRule) {
  const Mat quarter = ExpSo3<double>(Vec(0.0, 0.0, kPi / 2));
  EXPECT_TRUE((quarter * Vec::UnitX()).isApprox(Vec::UnitY(), kExact));
}

TEST(ExpSo3, OfTheNegativeIsTheInverse) {
  for (const Vec& r : RotationVectors()) {
    EXPECT_TRUE((ExpSo3<double>(r) * ExpSo3<double>(Vec(-r))).isIdentity(kExact)) << r.transpose();
  }
}

TEST(ExpSo3, AddsAnglesAboutOneAxis) {
  for (const Vec& r : RotationVectors()) {
    const Mat sum = ExpSo3<double>(Vec(0.3 * r)) * ExpSo3<double>(Vec(0.7 * r));
    EXPECT_LT((sum - ExpSo3<double>(r)).cwiseAbs().maxCoeff(), kExact) << r.transpose();
  }
}

TEST(ExpSo3, HasSkewAsItsDerivativeAtZero) {
  RandomStream random(2, "derivative");
  for (const double angle : {1e-6, 1e-4, 1e-2}) {
    const Vec r = angle * RandomDirection(random);
    const Mat linear = Mat::Identity() + Skew<double>(r);
    // The remainder is (1 − cos) of the angle times a matrix of norm ≤ √2, and angle³/6.
    EXPECT_LT((ExpSo3<double>(r) - linear).norm(), 0.75 * angle * angle + 1e-15);
  }
}

TEST(LogSo3, UndoesExp) {
  for (const Vec& r : RotationVectors()) {
    // Near π the axis is as well known as ever, but the angle only through cos: see the quaternion.
    EXPECT_LT((LogSo3<double>(ExpSo3<double>(r)) - r).norm(), 1e-12) << r.transpose();
  }
}

TEST(LogSo3, KeepsTheRelativePrecisionOfTinyRotations) {
  RandomStream random(3, "tiny");
  const Vec r = 1e-8 * RandomDirection(random);
  EXPECT_LT((LogSo3<double>(ExpSo3<double>(r)) - r).norm(), 1e-7 * r.norm());
}

TEST(LogSo3, OfAHalfTurnHasAngleAndAxisUpToSign) {
  RandomStream random(4, "half turns");
  for (int i = 0; i < 20; ++i) {
    const Vec axis = RandomDirection(random);
    const Vec log = LogSo3<double>(2.0 * axis * axis.transpose() - Mat::Identity());
    EXPECT_NEAR(log.norm(), kPi, 1e-7);
    EXPECT_NEAR(std::abs(log.dot(axis)), kPi, 1e-7);
  }
}

TEST(Skew, IsTheCrossProduct) {
  const Vec a(1.0, -2.0, 3.0), b(0.5, 4.0, -1.0);
  EXPECT_EQ(Skew<double>(a) * b, a.cross(b));
  EXPECT_EQ(Skew<double>(a).transpose(), -Skew<double>(a));
}

TEST(NearestRotation, LeavesRotationsAlone) {
  for (const Vec& r : RotationVectors()) {
    const Mat rotation = ExpSo3<double>(r);
    EXPECT_LT((NearestRotation<double>(rotation) - rotation).norm(), kExact) << r.transpose();
  }
}

TEST(NearestRotation, UndoesASymmetricStretch) {
  RandomStream random(5, "stretch");
  for (int i = 0; i < 20; ++i) {
    const Mat rotation = RandomRigid(random).rotation, axes = RandomRigid(random).rotation;
    const Vec stretch(random.Uniform(0.2, 3.0), random.Uniform(0.2, 3.0), random.Uniform(0.2, 3.0));
    const Mat stretched = rotation * axes * stretch.asDiagonal() * axes.transpose();
    EXPECT_LT((NearestRotation<double>(stretched) - rotation).norm(), 1e-13);
  }
}

TEST(NearestRotation, IsNearerThanAnyOtherRotation) {
  RandomStream random(6, "nearest");
  for (int i = 0; i < 20; ++i) {
    Mat m;
    for (double& entry : m.reshaped()) entry = random.Normal();  // half of them reflect
    const Mat nearest = NearestRotation<double>(m);
    EXPECT_TRUE((nearest.transpose() * nearest).isIdentity(kExact));
    EXPECT_NEAR(nearest.determinant(), 1.0, kExact);
    for (int k = 0; k < 50; ++k) {
      const double angle = k % 2 ? 0.01 : random.Uniform(0.0, kPi);
      const Mat other = ExpSo3<double>(angle * RandomDirection(random)) * nearest;
      EXPECT_LE((m - nearest).norm(), (m - other).norm() + kExact);
    }
  }
}

TEST(RotationBetween, TurnsOneDirectionIntoTheOtherTheShortWay) {
  RandomStream random(7, "between");
  for (int i = 0; i < 20; ++i) {
    const Vec from = RandomDirection(random), to = RandomDirection(random);
    const Mat rotation = RotationBetween<double>(2.0 * from, 0.5 * to);
    EXPECT_LT((rotation * from - to).norm(), 1e-12);
    EXPECT_NEAR(LogSo3<double>(rotation).norm(), std::acos(from.dot(to)), 1e-9);
  }
  const Vec x = Vec::UnitX();
  EXPECT_LT((RotationBetween<double>(x, -x) * x + x).norm(), 1e-7);
}

TEST(Rigid, ComposesAndInverts) {
  RandomStream random(8, "rigid");
  for (int i = 0; i < 20; ++i) {
    const Rigidd c_from_b = RandomRigid(random), b_from_a = RandomRigid(random);
    const Vec point_in_a = RandomDirection(random);
    const Vec point_in_c = (c_from_b * b_from_a) * point_in_a;
    EXPECT_LT((point_in_c - c_from_b * (b_from_a * point_in_a)).norm(), kExact);
    EXPECT_LT((Inverse(b_from_a) * (b_from_a * point_in_a) - point_in_a).norm(), kExact);
    const Rigidd identity = c_from_b * Inverse(c_from_b);
    EXPECT_TRUE(identity.rotation.isIdentity(kExact));
    EXPECT_LT(identity.translation.norm(), kExact);
  }
}

TEST(Rigid, RotationAboutKeepsItsCenter) {
  const Vec center(1.0, 2.0, 3.0);
  const Rigidd turn = RotationAbout<double>(ExpSo3<double>(Vec(0.0, kPi / 2, 0.0)), center);
  EXPECT_LT((turn * center - center).norm(), kExact);
  EXPECT_LT((turn * Vec(center + Vec::UnitZ()) - Vec(center + Vec::UnitX())).norm(), kExact);
}

}  // namespace
}  // namespace vitruvia
