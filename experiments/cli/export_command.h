// `vitruvia export`: the surfaces of runs as files that ParaView opens.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddExportCommand(CLI::App& app);

}  // namespace vitruvia
