// Generates docs/metrics.md: all metrics of the catalogue, for readers and authors of papers.
#pragma once

#include <string>

namespace vitruvia {

// Markdown.
std::string MetricsPage();

}  // namespace vitruvia
