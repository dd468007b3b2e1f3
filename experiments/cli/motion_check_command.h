// `vitruvia import motion --check FILE`: what is understood of a motion file, in words and as a
// picture.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddMotionCheckCommand(CLI::App& import);

}  // namespace vitruvia
