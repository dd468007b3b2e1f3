// vitruvia_fuzz COUNT [SEED [FORMAT/NUMBER]]: reads that many mutants, spread over all formats, or
// that one, and prints what came of them. Exits with 1 if anything is a defect. A mutant that
// crashes or takes too long is named on standard output before the program ends.
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

#include <fmt/format.h>

#include "formats.h"

// The sanitizers' own name.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void __sanitizer_set_death_callback(void (*)()) __attribute__((weak));

namespace vitruvia {
namespace {

constexpr unsigned kLongest_s = 60;  // for one mutant
constexpr int kDefectsShown = 20;    // of one format

char current_mutant[200];

void NameCurrentMutant() {
  constexpr char kHead[] = "ended while reading mutant ";
  (void)!write(STDOUT_FILENO, kHead, sizeof kHead - 1);
  (void)!write(STDOUT_FILENO, current_mutant, std::strlen(current_mutant));
  (void)!write(STDOUT_FILENO, "\n", 1);
}

void EndBySignal(int signal) {
  NameCurrentMutant();
  _exit(128 + signal);
}

void Begin(const std::string& mutant) {
  std::strncpy(current_mutant, mutant.c_str(), sizeof current_mutant - 1);
  alarm(kLongest_s);
}

void WatchForCrashes() {
  std::signal(SIGALRM, EndBySignal);
  std::signal(SIGABRT, EndBySignal);
  if (__sanitizer_set_death_callback != nullptr) {
    __sanitizer_set_death_callback(NameCurrentMutant);
  } else {
    std::signal(SIGSEGV, EndBySignal);
    std::signal(SIGFPE, EndBySignal);
  }
}

constexpr MutantOutcome kOutcomes[] = {MutantOutcome::kRefused, MutantOutcome::kSame,
                                       MutantOutcome::kTold, MutantOutcome::kStatement,
                                       MutantOutcome::kDefect};

std::string Row(const std::string& name, OutcomeCounts counts) {
  std::string row = fmt::format("{:<20}", name);
  for (const MutantOutcome outcome : kOutcomes) row += fmt::format("{:>10}", counts[outcome]);
  return row;
}

int Fuzz(int count, std::uint64_t seed, const std::string& only) {
  const std::vector<MutatedFormat> formats = MutatedFormats();
  OutcomeCounts sum;
  fmt::print("{:<20}", "format");
  for (const MutantOutcome outcome : kOutcomes) fmt::print("{:>10}", Name(outcome));
  fmt::print("\n");
  const std::size_t slash = only.rfind('/');
  for (std::size_t i = 0; i < formats.size(); ++i) {
    if (!only.empty() && formats[i].name != only.substr(0, slash)) continue;
    const int share = (count + static_cast<int>(i)) / static_cast<int>(formats.size());
    const TrialReport report =
        only.empty() ? TryMutants(formats[i], 0, share, seed, Begin)
                     : TryMutants(formats[i], std::stoi(only.substr(slash + 1)), 1, seed, Begin);
    fmt::print("{}\n", Row(report.format, report.counts));
    for (std::size_t d = 0; d < report.defects.size() && d < kDefectsShown; ++d)
      fmt::print("  {}\n", report.defects[d]);
    std::fflush(stdout);
    for (const auto& [outcome, number] : report.counts) sum[outcome] += number;
  }
  fmt::print("{}\n", Row("all", sum));
  return sum[MutantOutcome::kDefect] == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace vitruvia

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    fmt::print(stderr, "usage: vitruvia_fuzz COUNT [SEED [FORMAT/NUMBER]]\n");
    return 2;
  }
  vitruvia::WatchForCrashes();
  return vitruvia::Fuzz(std::stoi(argv[1]), argc > 2 ? std::stoull(argv[2]) : 1,
                        argc > 3 ? argv[3] : "");
}
