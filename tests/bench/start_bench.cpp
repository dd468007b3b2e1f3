// Starts in any pose: how often a tracker finds the person, how well and how fast. The figures are
// of the half that nothing was tuned on.
#include <algorithm>

#include <fmt/format.h>

#include "bench/bench.h"
#include "methods/registry.h"
#include "support/start_trials.h"

namespace vitruvia::bench {
namespace {

constexpr int kStartFrames = 10;
constexpr double kFoundWithin_m = 0.05;

std::unique_ptr<Tracker> SearchingTracker() {
  return MakeTracker(ReadMethodConfig(
      {{"method", "realtime_scape"}, {"settings", {{"start", "search"}}}}, {"start_bench", ""}));
}

double ShareOf(const std::vector<StartResult>& results, bool (*holds)(const StartResult&)) {
  return 100.0 * static_cast<double>(std::count_if(results.begin(), results.end(), holds)) /
         static_cast<double>(results.size());
}

}  // namespace

std::vector<Row> Starts() {
  const std::vector<StartPerson> people = StartPeople();
  const std::vector<StartPosture> postures = StartPostures();
  std::vector<StartResult> results;
  std::vector<double> first_mm, last_mm, ms;
  for (const StartTrial& trial : AllStartTrials()) {
    if (trial.is_tuned_on) continue;
    const StartPerson& person = people[static_cast<std::size_t>(trial.person)];
    const StartPosture& posture = postures[static_cast<std::size_t>(trial.posture)];
    const std::unique_ptr<Tracker> tracker = SearchingTracker();
    const StartResult r = RunStartTrial(trial, person, posture, *tracker, kStartFrames);
    results.push_back(r);
    first_mm.push_back(1e3 * r.first_error_m);
    last_mm.push_back(1e3 * r.last_error_m);
    ms.push_back(r.first_ms);
    if (r.found && !r.swapped && r.first_error_m <= kFoundWithin_m) continue;
    fmt::print("{}, {}, heading {:.0f}: {:.0f} mm, {:.0f} mm after {} frames{}{}; {}\n",
               person.name, posture.name, trial.heading_deg, first_mm.back(), last_mm.back(),
               kStartFrames, r.found ? "" : ", not found",
               r.swapped ? ", left and right swapped" : "", r.message);
  }
  return {{"starts_found", ShareOf(results, [](const StartResult& r) { return r.found; }), "%"},
          {"starts_within_5_cm",
           ShareOf(results, [](const StartResult& r) { return r.first_error_m <= kFoundWithin_m; }),
           "%"},
          {"starts_swapped", ShareOf(results, [](const StartResult& r) { return r.swapped; }), "%"},
          {"starts_found_but_swapped",
           ShareOf(results, [](const StartResult& r) { return r.found && r.swapped; }), "%"},
          {"start_first_error_median", Median(first_mm), "mm"},
          {"start_last_error_median", Median(last_mm), "mm"},
          {"start_last_within_2_cm",
           ShareOf(results, [](const StartResult& r) { return r.last_error_m <= 0.02; }), "%"},
          {"start_first_frame_median", Median(ms), "ms"},
          {"start_first_frame_longest", *std::max_element(ms.begin(), ms.end()), "ms"}};
}

}  // namespace vitruvia::bench
