// The options of `twinarm help`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/manual.h"
#include "app/command/options.h"
#include "app/support/nearest_name.h"
#include "app/support/version.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

struct HelpOptions {
  std::vector<std::string> command;
  bool man = false, completion = false;
};

CLI::App* find_command(CLI::App& parent, const std::string& name) {
  std::vector<std::string> names;
  for (CLI::App* command : parent.get_subcommands({})) {
    if (command->get_name() == name) return command;
    names.push_back(command->get_name());
  }
  throw InputError({{"", 0, "help", fmt::format("there is no command '{}'", name),
                     names.empty() ? "leave it out" : name_remedy(name, names, "commands")}});
}

int tell_help(CLI::App& program, const HelpOptions& asked) {
  if (asked.man) {
    fmt::print("{}", man_page(program, kProgramVersion));
  } else if (asked.completion) {
    fmt::print("{}", shell_completion(program));
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

void add_help(CLI::App& app, CommandLine& line) {
  const auto asked = std::make_shared<HelpOptions>();
  CLI::App* help = app.add_subcommand("help",
                                      "The help of a command, or the manual of all of them\n\n"
                                      "Example:  twinarm help coupling predict");
  help->add_option("command", asked->command, "the program itself if not given");
  CLI::Option* man = help->add_flag("--man", asked->man, "print the man page, for man -l -");
  help->add_flag("--completion", asked->completion,
                 "print the completion of commands, options and files, for bash")
      ->excludes(man);
  help->callback(
      [&app, asked, &line] { line.chosen = [&app, asked] { return tell_help(app, *asked); }; });
}

}  // namespace twinarm
