#include "math/dual_quaternion.h"

#include <numbers>

#include <gtest/gtest.h>

#include "core/random.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "tests/math/random_rigid.h"

namespace vitruvia {
namespace {

using Vec = Vector3<double>;
using Dual = DualQuaternion<double>;

void ExpectEqual(const Rigidd& a, const Rigidd& b, double tolerance) {
  EXPECT_LT((a.rotation - b.rotation).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LT((a.translation - b.translation).cwiseAbs().maxCoeff(), tolerance);
}

Dual Negated(Dual q) {
  q.real.coeffs() *= -1.0;
  q.dual.coeffs() *= -1.0;
  return q;
}

TEST(DualQuaternion, GoesRoundFromRigidAndBack) {
  RandomStream random(1, "round trip");
  ExpectEqual(Dual::FromRigid(Rigidd{}).ToRigid(), Rigidd{}, 1e-15);
  for (int i = 0; i < 100; ++i) {
    const Rigidd transform = RandomRigid(random);
    ExpectEqual(Dual::FromRigid(transform).ToRigid(), transform, 1e-14);
  }
}

TEST(DualQuaternion, FromRigidIsUnit) {
  RandomStream random(2, "unit");
  for (int i = 0; i < 20; ++i) {
    const Dual q = Dual::FromRigid(RandomRigid(random));
    EXPECT_NEAR(q.real.norm(), 1.0, 1e-15);
    EXPECT_NEAR(q.real.dot(q.dual), 0.0, 1e-15);
  }
}

TEST(DualQuaternion, ScaleAndSignDoNotMatter) {
  RandomStream random(3, "scale");
  const Rigidd transform = RandomRigid(random);
  Dual q = Dual::FromRigid(transform);
  ExpectEqual(Negated(q).ToRigid(), transform, 1e-14);
  q.real.coeffs() *= 0.3;
  q.dual.coeffs() *= 0.3;
  ExpectEqual(q.ToRigid(), transform, 1e-14);
}

TEST(DualQuaternion, BlendOfEqualsIsTheSame) {
  RandomStream random(4, "equals");
  const Rigidd transform = RandomRigid(random);
  const Dual q = Dual::FromRigid(transform);
  Dual blend = Dual::Zero();
  for (const double weight : {0.5, 0.3, 0.2}) blend.AddWeighted(weight, q, q.real);
  ExpectEqual(blend.ToRigid(), transform, 1e-14);
}

TEST(DualQuaternion, BlendTakesQAndMinusQForTheSame) {
  RandomStream random(5, "hemisphere");
  for (int i = 0; i < 50; ++i) {
    const Dual a = Dual::FromRigid(RandomRigid(random)), b = Dual::FromRigid(RandomRigid(random));
    Dual blend = Dual::Zero(), flipped = Dual::Zero();
    blend.AddWeighted(0.6, a, a.real);
    blend.AddWeighted(0.4, b, a.real);
    flipped.AddWeighted(0.6, a, a.real);
    flipped.AddWeighted(0.4, Negated(b), a.real);
    ExpectEqual(blend.ToRigid(), flipped.ToRigid(), 1e-13);
  }
}

// Half-way between two transforms lies the screw motion's half: with A = B⁻¹ they meet at identity.
TEST(DualQuaternion, EqualBlendIsTheMiddleOfTheScrewMotion) {
  RandomStream random(6, "middle");
  for (int i = 0; i < 20; ++i) {
    const Rigidd half = RandomRigid(random), start = RandomRigid(random);
    const Rigidd end = start * half * half;
    if (LogSo3<double>(half.rotation).norm() > 1.5) continue;  // the short way is another one
    const Dual a = Dual::FromRigid(start), b = Dual::FromRigid(end);
    Dual blend = Dual::Zero();
    blend.AddWeighted(0.5, a, a.real);
    blend.AddWeighted(0.5, b, a.real);
    ExpectEqual(blend.ToRigid(), start * half, 1e-12);
  }
}

}  // namespace
}  // namespace vitruvia
