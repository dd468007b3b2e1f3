// docs/metrics.md: all metrics of the catalogue for people who read or write papers.
#pragma once

#include <string>

namespace vitruvia {

// Markdown.
std::string MetricsPage();

}  // namespace vitruvia
