// twinarm: the command line, its exit codes, and how errors are told.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "app/command/command.h"
#include "app/command/parser/command_tree.h"
#include "app/support/files.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "app/support/version.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

enum ExitCode { kDone = 0, kBadInput = 2, kInternal = 4, kInterrupted = 130 };

// All faults at once: on stderr for people, on stdout for machines too.
int tell(const InputError& error, bool as_json) {
  using Told = nlohmann::ordered_json;  // the one flavour of this program: it is compiled once
  Told errors = Told::array();
  for (const Diagnostic& fault : error.faults()) {
    say("twinarm: {}\n", to_string(fault));
    errors.push_back({{"code", fault.code},
                      {"file", fault.file},
                      {"line", fault.line},
                      {"remedy", fault.fix},
                      {"rule", fault.problem},
                      {"where", fault.where}});
  }
  if (as_json)
    std::puts(  // does not throw where it is full
        Told{{"errors", errors}}.dump(1, ' ', false, Told::error_handler_t::replace).c_str());
  return kBadInput;
}

// What printed threw, perhaps: then that is the fault.
int tell_internal(const std::exception& error, bool as_json) {
  try {
    check_stdout();
  } catch (const InputError& full) {
    return tell(full, as_json);
  }
  say("twinarm: internal fault: {}\n", error.what());
  return kInternal;
}

// --help and --version: what is printed goes the way of all output, and is checked as such.
int tell_help(const CLI::App& app, const CLI::ParseError& asked, bool as_json) {
  std::ostringstream text;
  app.exit(asked, text);
  std::fputs(text.str().c_str(), stdout);
  try {
    check_stdout();
    return kDone;
  } catch (const InputError& full) {
    return tell(full, as_json);
  }
}

// The first word, where it is meant to be a command and is none.
void check_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::ranges::find(names, argv[1]) != names.end()) return;
  throw InputError({{"", 0, "command line", fmt::format("there is no command '{}'", argv[1]),
                     name_remedy(argv[1], names, "commands"), "command.unknown"}});
}

// `--png=` of a script whose variable is not set: CLI11 would take the next word for its value.
void check_values(int argc, char** argv) {
  DiagnosticList faults;
  for (const std::string_view word : std::vector<std::string_view>(argv, argv + argc))
    if (word.starts_with("--") && word.find('=') == word.size() - 1)
      faults.add({"", 0, "command line", fmt::format("'{}' has no value", word),
                  "give one, or leave the option out", "option.no-value"});
  faults.check();
}

// When its words are parsed, `chosen` runs it.
void add_command(CLI::App& parent, const Command& command,
                 std::function<int(const Words&)>& chosen) {
  CLI::App* app = parent.add_subcommand(command.name, command.help);
  for (const Command& next : command.below) add_command(*app, next, chosen);
  if (!command.below.empty())
    app->require_subcommand(1);
  else
    app->callback([run = command.prepare(*app), &chosen] { chosen = run; });
}

int run_program(int argc, char** argv) {
  fill_closed_streams();
  CLI::App app{"twinarm: a glass-box multibody laboratory\n\nExample:  twinarm study"};
  app.formatter(help_formatter());
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("twinarm ") + kProgramVersion,
                       "Print the version and exit");
  std::vector<Command> listed = commands();
  std::ranges::sort(listed, [](const Command& a, const Command& b) { return a.place < b.place; });
  std::function<int(const Words&)> chosen;
  for (const Command& command : listed) add_command(app, command, chosen);
  const bool as_json =
      std::any_of(argv, argv + argc, [](std::string_view word) { return word == "--json"; });
  try {
    check_command(app, argc, argv);
    check_values(argc, argv);
    app.parse(argc, argv);
  } catch (const InputError& error) {
    return tell(error, as_json);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return tell_help(app, error, as_json);
    return tell(
        InputError({{"", 0, "command line", error.what(), "see twinarm --help", "command.line"}}),
        as_json);
  }

  catch_interrupts();
  try {
    const int code = chosen({argv, argv + argc});
    check_stdout();
    return code;
  } catch (const InputError& error) {
    const int code = tell(error, as_json);
    return is_interrupted() ? kInterrupted : code;  // Ctrl-C ends the reader of a mesh too
  } catch (const Interrupted&) {
    say("twinarm: interrupted; nothing half-written was left behind\n");
    return kInterrupted;
  } catch (const std::exception& error) {
    return tell_internal(error, as_json);
  }
}

}  // namespace
}  // namespace twinarm

int main(int argc, char** argv) {
  return twinarm::run_program(argc, argv);
}
