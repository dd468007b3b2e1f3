// vitruvia report: an experiment's report and the figures of a paper, from stored records.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddReportCommand(CLI::App& app);

}  // namespace vitruvia
