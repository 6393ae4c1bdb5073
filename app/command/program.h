// The whole program: parses the command line, runs the command, tells errors. The exit code.
#pragma once

namespace twinarm {

int run_program(int argc, char** argv);

}  // namespace twinarm
