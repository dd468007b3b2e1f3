// Shared parts of figures: several runs as one curve with a band, colours, names.
#pragma once

#include <string>
#include <vector>

#include "records/run_record.h"
#include "reports/drawing/plot.h"

namespace vitruvia {

// `curves` may be of different lengths and have gaps (NaN); the mean is over those that have a
// value. A single curve has no band. `x` is as long as the longest.
Series MeanCurve(const std::string& name, Color color, const std::vector<double>& x,
                 const std::vector<std::vector<double>>& curves);

// Sentence of a caption that explains the bands.
inline constexpr const char* kBandText =
    " Lines are means over a variant's seeds and repeats, bands run from the lowest to the "
    "highest.";

// Stores the runs behind a name in the legend.
void AddRuns(const std::string& name, const std::vector<const RunRecord*>& runs, Figure& figure);

// The scenes of the runs, in their order.
std::vector<std::string> ScenesOf(const std::vector<const RunRecord*>& runs);

// A name as part of a file's name: letters, digits, - and _.
std::string FileSafe(std::string text);

// Logarithmic where the positive ones of the values differ by more than a factor of 20.
Scale ScaleFor(std::vector<double> values);

// Of lines whose colours are used a second time.
inline constexpr double kSecondRoundDash = 5.0;

// The colour of the i-th variant, in all figures.
Color VariantColor(std::size_t index);

// What follows a time on an axis: ", 1 thread", as the runs' records say; "" where none does.
std::string ThreadsText(const std::vector<const RunRecord*>& runs);

}  // namespace vitruvia
