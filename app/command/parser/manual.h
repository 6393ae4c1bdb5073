// The tree of commands and options as a man page, and as completion for a shell. Made from the tree
// that reads the command line itself, so that neither can go stale.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace twinarm {

// In man(7), section 1.
std::string man_page(CLI::App& program, const std::string& version);
// To be sourced by bash, or by zsh after bashcompinit.
std::string shell_completion(CLI::App& program);

}  // namespace twinarm
