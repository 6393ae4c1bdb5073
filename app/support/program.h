// Other programs, started without a shell.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace twinarm {

// The executable of this name in the folders of PATH; empty if there is none.
std::filesystem::path find_program(const std::string& name);

// Starts the program words[0], a path, with these file descriptors as standard streams, in its own
// process group, so that Ctrl-C does not reach it. Returns 0 and sets errno if it cannot start.
pid_t start_program(std::vector<std::string> words, int in, int out, int err);

// Waits for its end. Returns its exit code; 128 after a signal.
int exit_code_of(pid_t child);

}  // namespace twinarm
