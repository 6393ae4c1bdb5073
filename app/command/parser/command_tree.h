// Commands and options as plain lists, from which help, man page and completion are made.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class FormatterBase;
}  // namespace CLI

namespace twinarm {

struct OptionInfo {
  std::vector<std::string> names;  // "-h", "--help"; of a positional argument its name
  std::string value;               // "NUMBER", "PATH"; empty: a flag
  std::string preset;              // default value; may be empty
  std::string help;
  bool is_positional = false, is_file = false, is_required = false;
};

struct CommandInfo {
  std::string name;                      // "coupling predict"; empty: the program itself
  std::string summary;                   // first paragraph of its description
  std::vector<std::string> details;      // the other paragraphs, examples first
  std::vector<OptionInfo> options;       // positional arguments first
  std::vector<std::string> subcommands;  // their names
};

// The program first; each command before its subcommands.
std::vector<CommandInfo> command_tree(CLI::App& program);

// The tree as man page (man(7), section 1) and as completion script for bash, zsh or fish.
std::string man_page(CLI::App& program, const std::string& version);
std::string shell_completion(CLI::App& program, const std::string& shell);

// Prints value and range of an option: "--port N", "(0 to 65535)".
std::shared_ptr<CLI::FormatterBase> help_formatter();

}  // namespace twinarm
