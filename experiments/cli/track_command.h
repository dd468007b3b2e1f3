// `vitruvia track`: one method on one stored sequence.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddTrackCommand(CLI::App& app);

}  // namespace vitruvia
