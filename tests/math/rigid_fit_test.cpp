#include "math/rigid_fit.h"

#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "tests/math/random_rigid.h"

namespace vitruvia {
namespace {

std::vector<PointPair> NoisyPairs(const Rigidd& b_from_a, double noise, RandomStream& random) {
  std::vector<PointPair> pairs;
  for (int i = 0; i < 20; ++i) {
    const Vector3<double> a(random.Normal(), random.Normal(), random.Normal());
    pairs.push_back({a, b_from_a * a + noise * RandomDirection(random)});
  }
  return pairs;
}

Rigidd Fitted(const std::vector<PointPair>& pairs) {
  return FitRigid(pairs.size(), [&](std::size_t i) { return pairs[i]; });
}

TEST(FitRigid, FindsThePlantedMotion) {
  RandomStream random(1, "rigid fit");
  for (int trial = 0; trial < 20; ++trial) {
    const Rigidd planted{ExpSo3<double>(random.Uniform(0.0, 3.1) * RandomDirection(random)),
                         5.0 * RandomDirection(random)};
    const Rigidd found = Fitted(NoisyPairs(planted, 0.0, random));
    EXPECT_LT((found.rotation - planted.rotation).norm(), 1e-12);
    EXPECT_LT((found.translation - planted.translation).norm(), 1e-12);
  }
}

TEST(FitRigid, AgreesWithUmeyamaOnNoisyAndMirroredPairs) {
  RandomStream random(2, "rigid fit");
  for (int trial = 0; trial < 20; ++trial) {
    const Rigidd planted{ExpSo3<double>(random.Uniform(0.0, 3.1) * RandomDirection(random)),
                         RandomDirection(random)};
    std::vector<PointPair> pairs = NoisyPairs(planted, 0.1, random);
    // A mirror image: the best orthogonal matrix is no rotation.
    if (trial % 2 == 1) {
      for (PointPair& pair : pairs) pair.in_a.x() *= -1.0;
    }
    Eigen::Matrix3Xd a(3, pairs.size()), b(3, pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      a.col(static_cast<Eigen::Index>(i)) = pairs[i].in_a;
      b.col(static_cast<Eigen::Index>(i)) = pairs[i].in_b;
    }
    const Eigen::Matrix4d expected = Eigen::umeyama(a, b, false);
    const Rigidd found = Fitted(pairs);
    EXPECT_NEAR(found.rotation.determinant(), 1.0, 1e-12);
    EXPECT_LT((found.rotation - expected.topLeftCorner<3, 3>()).norm(), 1e-9);
    EXPECT_LT((found.translation - expected.topRightCorner<3, 1>()).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace vitruvia
