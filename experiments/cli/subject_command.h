// `vitruvia subject --space DIR --height M -o DIR`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddSubjectCommand(CLI::App& app);

}  // namespace vitruvia
