// The command line: `vitruvia list | synth | track | run | report | explain`.
#pragma once

namespace vitruvia {

// Parses and carries out one command. Never throws: an error is printed to standard error with its
// context, and the exit code (core/error.h) says of which kind it was.
int RunCommandLine(int argc, const char* const* argv);

}  // namespace vitruvia
