// The metric catalogue: what each number of a run record means and how it is printed.
//
// Tables, plots, comparisons, the regression gate, `vitruvia explain` and the expectations of
// experiment files take keys, labels, units, directions and selections from here. To add a metric,
// add one entry to the list of its kind (catalogue_*.cpp) and compute the number where its kind is
// scored (src/scoring, or the study that measures it).
#pragma once

#include <string>
#include <vector>

namespace vitruvia {

enum class Better { kLower, kHigher, kNeither };
const char* Name(Better better);  // "lower is better" …

// Where a metric is shown or used. Every metric that a run has is in the table of all runs and can
// be compared on request; these are the selections for places that do not show all metrics.
enum class Place {
  kSummaryTable,  // the leading columns of the report's table of all runs
  kVariantTable,  // the report's table with one row for each variant
  kComparison,    // comparisons between variants
  kTerminal,      // the rows that `vitruvia run` prints
  kIndexPage,     // the table of all runs of an output folder
  kGate,          // accuracy numbers that the regression gate compares with its baseline
  kPictureNote,   // beside a run's pictures
  kSpeedPlot,     // error axis of the plot of speed against error: the first of these that some run
                  // has
  kHistoryPlot,   // error axis of the gate's history: the first of these that the experiment has
};

struct Metric {
  std::string key{};    // of the summary row, or of the series per frame
  std::string label{};  // for people, without unit
  std::string unit{};   // of the printed number; "" for text, counts and ratios
  double scale = 1.0;   // printed number = stored number × scale
  int decimals = 0;     // of the printed number
  Better better = Better::kNeither;
  std::vector<Place> shown_in{};
  std::string definition{};     // full sentences
  std::string formula{};        // in the symbols of FormulaSymbols; "" if the definition needs none
  std::string averaged_over{};  // the sets averaged over, in order; "" if nothing is averaged
  std::string hidden_and_lost{};  // full sentences: how hidden parts and lost frames count

  // A member of a family (see MetricFamilies): the family's key, and which member it is.
  std::string family{}, member{};

  bool IsShownIn(Place place) const;
};

// Definitions of the symbols in the metrics' formulas, one sentence each.
const std::vector<std::string>& FormulaSymbols();

// Metrics of one kind, for pages and lists.
struct MetricGroup {
  std::string title;
  std::vector<Metric> metrics;
};
const std::vector<MetricGroup>& MetricGroups();  // all but the families

// All metrics but the families, in the order in which tables show them.
const std::vector<Metric>& MetricCatalogue();

// Metrics that exist once for each joint, each timed step or each energy term. Key and label hold
// the parameter in braces: "step_ms_median[{step}]" has the member "step_ms_median[7 classify]".
const std::vector<Metric>& MetricFamilies();
inline constexpr const char* kJointErrorOfJoint = "joint_error_mean_m[{joint}]";
inline constexpr const char* kStepMedian = "step_ms_median[{step}]";
inline constexpr const char* kStepP95 = "step_ms_p95[{step}]";
inline constexpr const char* kStepMax = "step_ms_max[{step}]";
inline constexpr const char* kEnergyOfTerm = "energy_{term}";
inline constexpr const char* kOwnSummary = "summary[{name}]";

// The median time of a frame divided by that of the calibration kernel (core/calibration.h) in the
// same process, for comparisons across machines. Computed from a record, not stored.
inline constexpr const char* kCalibratedTime = "frame_median_per_calibration";

// The metric of a key, or the member of a family with key and label filled in. ConfigError with the
// nearest known key if there is none.
Metric FindMetric(const std::string& key);
// "" if the catalogue has the key, otherwise the message of FindMetric's exception.
std::string UnknownMetricProblem(const std::string& key);

// In the order of the catalogue.
std::vector<Metric> MetricsShownIn(Place place);

}  // namespace vitruvia
