#include "core/random.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

// Golden numbers computed by other code (arbitrary-precision integers) from the definitions of
// FNV-1a over name and little-endian seed, and of SplitMix64.
struct Golden {
  std::uint64_t seed;
  const char* name;
  std::uint64_t bits[3];
};
constexpr Golden kGolden[] = {
    {0, "", {0x5ba314b8cfda3b6b, 0x2a8e5b0b95ac5bde, 0xe002962d320b2264}},
    {1, "noise", {0x31441a7bcbb36639, 0xc50a1ee5434f58b9, 0x44ae0342cbf3ab41}},
    {1, "noises", {0x29da380038f5d6c3, 0x70ac303a09538e9b, 0xa1cab14322743c88}},
    {2, "noise", {0x921418a0570d7f55, 0x5487e6d0405fd1a4, 0xa5e21cc0e9efc4a6}},
    {18446744073709551615u, "motion", {0x6e0df6f949840012, 0xcd5baf9072623bbc, 0xd0e67d76ad98fdbe}},
};

TEST(RandomStream, GivesTheGoldenNumbers) {
  for (const Golden& golden : kGolden) {
    RandomStream stream(golden.seed, golden.name);
    for (const std::uint64_t bits : golden.bits) {
      EXPECT_EQ(stream.NextBits(), bits) << golden.seed << " " << golden.name;
    }
  }
  RandomStream uniform(1, "noise");
  EXPECT_EQ(uniform.Uniform(), 0.19244542620044802);
  EXPECT_EQ(uniform.Uniform(10.0, 20.0), 10.0 + 10.0 * 0.7696856794094037);
  RandomStream normal(1, "noise");  // Box and Muller of the same numbers
  EXPECT_NEAR(normal.Normal(), 0.08066496614399582, 1e-15);
  EXPECT_NEAR(normal.Normal(), -0.6488316023974104, 1e-15);
  EXPECT_NEAR(normal.Normal(5.0, 2.0), 5.0 - 2.0 * 0.7298124516682685, 1e-14);
}

TEST(RandomStream, IsTheSameForTheSameSeedAndName) {
  RandomStream a(7, "clothes"), b(7, "clothes");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.Normal(), b.Normal());
}

constexpr int kSamples = 200000;

// Mean of a column and correlation of two, over kSamples.
double Mean(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}
double Moment(const std::vector<double>& x, double about, int power) {
  std::vector<double> powers;
  for (const double value : x) powers.push_back(std::pow(value - about, power));
  return Mean(powers);
}

// The bounds below are five standard errors of each estimate.
TEST(RandomStream, UniformHasTheMomentsOfAUniform) {
  RandomStream stream(11, "uniform");
  std::vector<double> x;
  for (int i = 0; i < kSamples; ++i) x.push_back(stream.Uniform(-1.0, 3.0));
  for (const double value : x) {
    ASSERT_GE(value, -1.0);
    ASSERT_LT(value, 3.0);
  }
  const double root = std::sqrt(static_cast<double>(kSamples));
  EXPECT_NEAR(Mean(x), 1.0, 5.0 * std::sqrt(16.0 / 12.0) / root);
  // Var((x-1)^2) = 2^4/5 - (16/12)^2 for a half width of 2.
  EXPECT_NEAR(Moment(x, 1.0, 2), 16.0 / 12.0,
              5.0 * std::sqrt(16.0 / 5.0 - 16.0 / 12.0 * 16.0 / 12.0) / root);
}

TEST(RandomStream, NormalHasTheMomentsOfANormal) {
  RandomStream stream(12, "normal");
  std::vector<double> x;
  for (int i = 0; i < kSamples; ++i) x.push_back(stream.Normal(2.0, 3.0));
  const double root = std::sqrt(static_cast<double>(kSamples));
  EXPECT_NEAR(Mean(x), 2.0, 5.0 * 3.0 / root);
  EXPECT_NEAR(Moment(x, 2.0, 2), 9.0, 5.0 * 9.0 * std::sqrt(2.0) / root);
  EXPECT_NEAR(Moment(x, 2.0, 3) / 27.0, 0.0, 5.0 * std::sqrt(15.0) / root);
  EXPECT_NEAR(Moment(x, 2.0, 4) / 81.0, 3.0, 5.0 * std::sqrt(96.0) / root);
}

double Correlation(RandomStream a, RandomStream b) {
  double sum = 0.0;
  for (int i = 0; i < kSamples; ++i) sum += a.Normal() * b.Normal();
  return sum / kSamples;
}

TEST(RandomStream, IsIndependentByNameAndBySeed) {
  const double bound = 5.0 / std::sqrt(static_cast<double>(kSamples));
  EXPECT_NEAR(Correlation({1, "depth"}, {1, "depti"}), 0.0, bound);
  EXPECT_NEAR(Correlation({1, "depth"}, {2, "depth"}), 0.0, bound);
  EXPECT_NEAR(Correlation({1, "depth"}, {1, "depth"}), 1.0, bound * std::sqrt(2.0));
}

TEST(RandomStream, DrawingFromOneStreamDoesNotShiftAnother) {
  RandomStream a(1, "a"), b(1, "b");
  for (int i = 0; i < 10; ++i) a.NextBits();
  EXPECT_EQ(b.NextBits(), RandomStream(1, "b").NextBits());
}

TEST(RandomStream, UniformStaysBelowItsEndWhereSumsRound) {
  // One step of double precision wide: half of all sums would round up to the end.
  const double low = 1.0, high = std::nextafter(1.0, 2.0);
  RandomStream stream(3, "narrow");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(stream.Uniform(low, high), low);
  EXPECT_EQ(stream.Uniform(4.0, 4.0), 4.0);
}

TEST(RandomStream, IndexReachesEveryValueEquallyOften) {
  RandomStream stream(5, "index");
  constexpr int kCount = 7;
  int seen[kCount] = {};
  for (int i = 0; i < kSamples; ++i) {
    const std::uint64_t index = stream.Index(kCount);
    ASSERT_LT(index, static_cast<std::uint64_t>(kCount));
    ++seen[index];
  }
  const double expected = static_cast<double>(kSamples) / kCount;
  double chi_squared = 0.0;
  for (const int count : seen) {
    chi_squared += (count - expected) * (count - expected) / expected;
  }
  EXPECT_LT(chi_squared, 22.5);  // 6 degrees of freedom: exceeded once in a thousand
  EXPECT_EQ(stream.Index(1), 0u);
  EXPECT_THROW(stream.Index(0), std::invalid_argument);
}

}  // namespace
}  // namespace vitruvia
