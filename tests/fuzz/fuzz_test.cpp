// A few hundred mutants over all formats; `make fuzz` reads ten thousand.
#include <ostream>

#include <gtest/gtest.h>

#include "formats.h"

namespace vitruvia {

// For the names of tests.
inline void PrintTo(const MutatedFormat& format, std::ostream* out) { *out << format.name; }

namespace {

constexpr int kMutants = 40;  // of each format
constexpr std::uint64_t kSeed = 20;

class Mutants : public testing::TestWithParam<MutatedFormat> {};

TEST_P(Mutants, AreRefusedOrReadAsTheyAre) {
  const TrialReport report = TryMutants(GetParam(), 0, kMutants, kSeed, [](const std::string&) {});
  for (const std::string& defect : report.defects) ADD_FAILURE() << defect;
  EXPECT_TRUE(report.counts.contains(MutantOutcome::kRefused)) << "nothing is refused";
}

INSTANTIATE_TEST_SUITE_P(Formats, Mutants, testing::ValuesIn(MutatedFormats()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace vitruvia
