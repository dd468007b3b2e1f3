// Formatting of metrics: scaled to the catalogue's unit, with its number of decimals.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "metrics/catalogue.h"

namespace vitruvia {

inline constexpr const char* kNoNumber = "–";  // printed for a missing value

std::string Printed(double value, const Metric& metric);  // without unit
std::string PrintedSigned(double difference, const Metric& metric);
std::string SignedNumber(double number, int decimals);
// A cell of a summary row: number, text or null.
std::string PrintedCell(const nlohmann::json& cell, const Metric& metric);
// "label (unit)"
std::string Titled(const Metric& metric);
// Unit, and the factor between stored and printed numbers; "" if there is no unit.
std::string UnitText(const Metric& metric);
// Label, definition, formula, what is averaged, what counts, unit and direction on a few lines.
std::string Explanation(const Metric& metric);

}  // namespace vitruvia
