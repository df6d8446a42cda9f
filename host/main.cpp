// The program: everything is in host/cli.
#include "cli/command_line.h"

int main(int argc, char** argv) { return quasilux::runCommandLine(argc, argv); }
