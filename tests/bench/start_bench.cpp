// Starts in any pose: how often a tracker finds the person, how well and how fast. The search's
// constants were tuned on one half of the starts; rows named `untuned` are of the other one.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/bench.h"
#include "math/statistics.h"
#include "methods/registry.h"
#include "support/start_trials.h"

namespace vitruvia::bench {
namespace {

constexpr int kStartFrames = 10;
constexpr double kFoundWithin_m = 0.05, kSettledWithin_m = 0.02;

struct TriedStart {
  StartTrial trial;
  StartResult result;
};
using TriedStarts = std::vector<TriedStart>;

std::unique_ptr<Tracker> SearchingTracker() {
  return MakeTracker(ReadMethodConfig(
      {{"method", "realtime_scape"}, {"settings", {{"start", "search"}}}}, {"start_bench", ""}));
}

bool IsFound(const TriedStart& o) { return o.result.found; }
bool IsClose(const TriedStart& o) { return o.result.first_error_m <= kFoundWithin_m; }
bool IsSettled(const TriedStart& o) { return o.result.last_error_m <= kSettledWithin_m; }
bool IsSwapped(const TriedStart& o) { return o.result.swapped; }
bool IsFoundButSwapped(const TriedStart& o) { return o.result.found && o.result.swapped; }
bool FacesCamera(const TriedStart& o) { return o.trial.heading_deg == 0.0; }
bool IsUntuned(const TriedStart& o) { return !o.trial.is_tuned_on; }

template <class Holds>
TriedStarts Those(const TriedStarts& tried, Holds holds) {
  TriedStarts those;
  std::copy_if(tried.begin(), tried.end(), std::back_inserter(those), holds);
  return those;
}

double ShareOf(const TriedStarts& tried, bool (*holds)(const TriedStart&)) {
  return 100.0 * static_cast<double>(std::count_if(tried.begin(), tried.end(), holds)) /
         static_cast<double>(tried.size());
}

std::vector<double> ValuesOf(const TriedStarts& tried, double StartResult::*value, double scale) {
  std::vector<double> values;
  for (const TriedStart& o : tried) values.push_back(scale * (o.result.*value));
  return values;
}

TriedStarts TriedInTurn(const std::vector<StartPerson>& people,
                        const std::vector<StartPosture>& postures) {
  TriedStarts tried;
  for (const StartTrial& trial : AllStartTrials()) {
    const StartPerson& person = people[static_cast<std::size_t>(trial.person)];
    const StartPosture& posture = postures[static_cast<std::size_t>(trial.posture)];
    const std::unique_ptr<Tracker> tracker = SearchingTracker();
    const StartResult r = RunStartTrial(trial, person, posture, *tracker, kStartFrames);
    tried.push_back({trial, r});
    if (IsClose(tried.back()) && IsSettled(tried.back()) && r.found && !r.swapped) continue;
    fmt::print("{}, {}, heading {:.0f}{}: {:.0f} mm, {:.0f} mm after {} frames{}{}; {}\n",
               person.name, posture.name, trial.heading_deg, trial.is_tuned_on ? " (tuned on)" : "",
               1e3 * r.first_error_m, 1e3 * r.last_error_m, kStartFrames,
               r.found ? "" : ", not found", r.swapped ? ", left and right swapped" : "",
               r.message);
  }
  return tried;
}

void PrintPart(const std::string& name, const TriedStarts& part) {
  fmt::print(
      "  {:<36} found {:3.0f} %, within 5 cm {:3.0f} %, then within 2 cm {:3.0f} %, swapped "
      "{:3.0f} "
      "%\n",
      name, ShareOf(part, IsFound), ShareOf(part, IsClose), ShareOf(part, IsSettled),
      ShareOf(part, IsSwapped));
}

void PrintParts(const TriedStarts& tried, const std::vector<StartPerson>& people,
                const std::vector<StartPosture>& postures) {
  for (std::size_t i = 0; i < people.size(); ++i) {
    PrintPart(people[i].name, Those(tried, [&](const TriedStart& o) {
                return o.trial.person == static_cast<int>(i);
              }));
  }
  for (std::size_t i = 0; i < postures.size(); ++i) {
    PrintPart(postures[i].name, Those(tried, [&](const TriedStart& o) {
                return o.trial.posture == static_cast<int>(i);
              }));
  }
  for (const double heading_deg : {0.0, 90.0, 180.0, 270.0}) {
    PrintPart(fmt::format("heading {:.0f}", heading_deg), Those(tried, [&](const TriedStart& o) {
                return o.trial.heading_deg == heading_deg;
              }));
  }
}

}  // namespace

std::vector<Row> Starts() {
  const std::vector<StartPerson> people = StartPeople();
  const std::vector<StartPosture> postures = StartPostures();
  const TriedStarts all = TriedInTurn(people, postures);
  const TriedStarts untuned = Those(all, IsUntuned), facing = Those(all, FacesCamera);
  PrintParts(all, people, postures);
  const std::vector<double> first_mm = ValuesOf(all, &StartResult::first_error_m, 1e3);
  const std::vector<double> last_mm = ValuesOf(all, &StartResult::last_error_m, 1e3);
  const std::vector<double> ms = ValuesOf(all, &StartResult::first_ms, 1.0);
  return {{"starts_found", ShareOf(all, IsFound), "%"},
          {"starts_within_5_cm", ShareOf(all, IsClose), "%"},
          {"starts_within_5_cm_untuned", ShareOf(untuned, IsClose), "%"},
          {"starts_last_within_2_cm", ShareOf(all, IsSettled), "%"},
          {"starts_last_within_2_cm_untuned", ShareOf(untuned, IsSettled), "%"},
          {"starts_swapped", ShareOf(all, IsSwapped), "%"},
          {"starts_found_but_swapped", ShareOf(all, IsFoundButSwapped), "%"},
          {"starts_swapped_facing_the_camera", ShareOf(facing, IsSwapped), "%"},
          {"start_first_error_mean", Mean(first_mm), "mm"},
          Spread("start_first_error", first_mm, "mm"),
          {"start_last_error_mean", Mean(last_mm), "mm"},
          Spread("start_last_error", last_mm, "mm"),
          Spread("start_first_frame", ms, "ms"),
          {"start_first_frame_longest", Maximum(ms), "ms"}};
}

}  // namespace vitruvia::bench
