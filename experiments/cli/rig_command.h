// vitruvia rig: makes a subject from a person's meshes.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddRigCommand(CLI::App& app);

}  // namespace vitruvia
