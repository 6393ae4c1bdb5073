// The commands and options of the program as plain lists, for what is written about them.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace CLI {
class FormatterBase;
class Option;
}  // namespace CLI

namespace twinarm {

struct OptionInfo {
  std::vector<std::string> names;  // "-h", "--help"; of a word without dashes its name alone
  std::string value;               // "NUMBER", "PATH"; empty: a flag
  std::string preset;              // what it is if not given; may be empty
  std::string help;
  bool is_word = false, is_file = false, is_required = false;
};

struct CommandInfo {
  std::string name;                    // "coupling predict"; empty: the program itself
  std::string summary;                 // the first paragraph of its description
  std::vector<std::string> details;    // the others, an example first
  std::vector<OptionInfo> options;     // words without dashes first
  std::vector<std::string> followers;  // names of commands that may come next
};

// The program first; each before the commands below it.
std::vector<CommandInfo> command_tree(CLI::App& program);

// That tree as a man page, in man(7), section 1; and as completion for a shell, to be sourced by
// bash, or by zsh after bashcompinit. Made from what reads the command line itself, so that neither
// can go stale.
std::string man_page(CLI::App& program, const std::string& version);
std::string shell_completion(CLI::App& program);

// How the help, the manual and the site tell what an option takes: "--port N", and "(0 to 65535)"
// at the end of its words.
std::string value_word(const CLI::Option& option);    // NUMBER, N, TEXT, PATH ..; empty: a flag
std::string value_limits(const CLI::Option& option);  // "above 0"; empty: none that are told
std::shared_ptr<CLI::FormatterBase> help_formatter();

}  // namespace twinarm
