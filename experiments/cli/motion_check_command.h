// `vitruvia import motion --check FILE`: prints and draws how a motion file is interpreted.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddMotionCheckCommand(CLI::App& import);

}  // namespace vitruvia
