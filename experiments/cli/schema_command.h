// `vitruvia schema [KIND] [-o DIR]`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddSchemaCommand(CLI::App& app);

}  // namespace vitruvia
