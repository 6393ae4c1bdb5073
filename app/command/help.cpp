// `twinarm help`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/command/command.h"
#include "app/command/parser/command_tree.h"
#include "app/scene/read/scene_keys.h"
#include "app/support/text.h"
#include "app/support/version.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

struct HelpOptions {
  CLI::App* program = nullptr;
  std::vector<std::string> command;
  bool man = false, completion = false, scene_numbers = false;
};

void add_options(CLI::App& command, HelpOptions& options) {
  options.program = command.get_parent();
  command.add_option("command", options.command, "the program itself if not given");
  CLI::Option* man = command.add_flag("--man", options.man, "print the man page, for man -l -");
  CLI::Option* completion =
      command
          .add_flag("--completion", options.completion,
                    "print the completion of commands, options and files, for bash")
          ->excludes(man);
  command
      .add_flag("--scene-numbers", options.scene_numbers,
                "print the numbers of a scene file as tables: units, defaults, ranges, meanings")
      ->excludes(man)
      ->excludes(completion);
}

CLI::App* find_command(CLI::App& parent, const std::string& name) {
  std::vector<std::string> names;
  for (CLI::App* command : parent.get_subcommands({})) {
    if (command->get_name() == name) return command;
    names.push_back(command->get_name());
  }
  throw InputError(
      {{"", 0, "help", fmt::format("there is no command '{}'", name),
        names.empty() ? "leave it out" : name_remedy(name, names, "commands"), "command.unknown"}});
}

int run_help(const HelpOptions& asked) {
  CLI::App& program = *asked.program;
  if (asked.man) {
    fmt::print("{}", man_page(program, kProgramVersion));
  } else if (asked.completion) {
    fmt::print("{}", shell_completion(program));
  } else if (asked.scene_numbers) {
    fmt::print("{}", scene_numbers());
  } else {
    CLI::App* command = &program;
    std::string path = "twinarm";
    for (const std::string& word : asked.command) {
      command = find_command(*command, word);
      path += " " + word;
    }
    fmt::print("{}",
               command->get_formatter()->make_help(command, path, CLI::AppFormatMode::Normal));
  }
  return 0;
}

}  // namespace

Command help_command() {
  return {180, "help",
          "The help of a command, or the manual of all of them\n\n"
          "Example:  twinarm help coupling predict",
          add_options, run_help};
}

}  // namespace twinarm
