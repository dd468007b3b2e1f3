#include "experiments/cli/commands.h"

int main(int argc, char** argv) { return vitruvia::RunCommandLine(argc, argv); }
