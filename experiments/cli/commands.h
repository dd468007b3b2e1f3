// The command line of `vitruvia`: all commands of this folder.
#pragma once

namespace vitruvia {

// Parses and runs one command. Never throws: an error is printed to standard error with its
// context, and the exit code (core/error.h) gives its kind.
int RunCommandLine(int argc, const char* const* argv);

}  // namespace vitruvia
