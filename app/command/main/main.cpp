// twinarm: parses the command line, runs a command, reports errors.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "app/command/command.h"
#include "app/command/parser/command_tree.h"
#include "app/data/json_writer.h"
#include "app/support/files.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "app/support/version.h"
#include "collision/sandbox/sandboxed_process.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

enum ExitCode { kDone = 0, kBadInput = 2, kInternal = 4, kInterrupted = 130 };

// Of a missing file: the file of its folder with the most similar name.
std::string remedy(const Diagnostic& fault) {
  constexpr std::size_t kMaxFiles = 1000;  // of which names are compared
  if (fault.code != "file.missing") return fault.fix;
  const std::filesystem::path file(fault.file);
  std::vector<std::string> names;
  std::error_code ignored;
  for (std::filesystem::directory_iterator at(folder_of(file), ignored), end;
       at != end && names.size() < kMaxFiles; at.increment(ignored))
    if (at->path().filename() != file.filename())  // a device, or a link that leads nowhere
      names.push_back(at->path().filename().string());
  const std::string nearest = nearest_name(file.filename().string(), names);
  if (nearest.empty()) return fault.fix;
  const std::filesystem::path found = file.parent_path() / nearest;
  const std::string here =
      found.lexically_proximate(std::filesystem::current_path(ignored)).string();
  return fmt::format("did you mean '{}'?", here.starts_with("..") ? found.string() : here);
}

// Prints all diagnostics on stderr and, if as_json, on stdout as JSON.
int report(const InputError& error, bool as_json) {
  using Json = nlohmann::ordered_json;  // the one variant that the program instantiates
  Json errors = Json::array();
  for (Diagnostic fault : error.faults()) {
    fault.fix = remedy(fault);
    print_error("twinarm: {}\n", to_string(fault));
    errors.push_back({{"code", fault.code},
                      {"file", fault.file},
                      {"line", fault.line},
                      {"fix", fault.fix},
                      {"problem", fault.problem},
                      {"where", fault.where}});
  }
  if (as_json)
    std::puts(  // does not throw if stdout is full
        Json{{"schema", kJsonSchema}, {"errors", errors}}
            .dump(1, ' ', false, Json::error_handler_t::replace)
            .c_str());
  return kBadInput;
}

// Flushes stdout; returns `code`, or that of the error if the output is incomplete.
int check_output(int code, bool as_json) {
  try {
    check_stdout();
    return code;
  } catch (const InputError& full) {
    return report(full, as_json);
  }
}

// --help and --version.
int print_help(const CLI::App& app, const CLI::ParseError& parsed, bool as_json) {
  std::ostringstream text;
  app.exit(parsed, text);
  std::fputs(text.str().c_str(), stdout);
  return check_output(kDone, as_json);
}

// The command or subcommand that the first words name, and its path, "twinarm coupling predict".
// Throws if a word that must be one is neither that nor an option.
std::pair<const CLI::App*, std::string> find_command(const CLI::App& app, int argc, char** argv) {
  const CLI::App* command = &app;
  std::string path = "twinarm";
  for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
    const std::string word = argv[i];
    std::vector<std::string> names;
    for (const CLI::App* below : command->get_subcommands({})) names.push_back(below->get_name());
    if (names.empty()) break;
    if (std::ranges::find(names, word) == names.end())
      throw InputError("command line", fmt::format("there is no command '{}'", word),
                       word.ends_with(".toml") || word.ends_with(".urdf")
                           ? fmt::format("give `twinarm simulate {0}` or `twinarm lab {0}`", word)
                           : name_remedy(word, names, "commands"),
                       "command.unknown");
    command = command->get_subcommand(word);
    path += " " + word;
  }
  return {command, path};
}

// `--png=` without a value (an unset shell variable): CLI11 would use the next word as its value.
void check_values(int argc, char** argv) {
  DiagnosticList faults;
  for (const std::string_view word : std::vector<std::string_view>(argv, argv + argc))
    if (word.starts_with("--") && word.find('=') == word.size() - 1)
      faults.add("command line", fmt::format("'{}' has no value", word),
                 "give a value, or leave the option out", "option.no-value");
  faults.check();
}

bool is_number(const CLI::App& command, const std::string& name) {
  const CLI::Option* option = command.get_option_no_throw(name);
  return option && option->get_type_name().starts_with("FLOAT");
}

// For a command line that cannot be parsed: an unknown option, else what CLI11 says.
InputError parse_fault(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const auto [command, path] = find_command(app, argc, argv);
  std::vector<std::string> names;
  for (const CLI::Option* option : command->get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const std::string& word : std::vector<std::string>(argv + 1, argv + argc)) {
    const std::string option = word.substr(0, word.find('='));
    if (!option.starts_with("--") || std::ranges::find(names, option) != names.end()) continue;
    const std::string now = renamed("options", option), nearest = nearest_name(option, names);
    const std::string fix = !now.empty()       ? fmt::format("'{}' is now '{}'", option, now)
                            : !nearest.empty() ? fmt::format("did you mean '{}'?", nearest)
                                               : fmt::format("see {} --help", path);
    return InputError("command line", fmt::format("{} has no option '{}'", path, option), fix,
                      "command.line");
  }
  std::string problem = error.what(), fix = fmt::format("see {} --help", path);
  // "Could not convert: --step = abc", "--step: 1 required FLOAT missing"
  const std::string_view refused = "Could not convert: ";
  const bool is_refused = problem.starts_with(refused);
  if (is_refused) problem.erase(0, refused.size());
  const std::string option = problem.substr(0, problem.find_first_of(" :"));
  if (is_refused || problem.ends_with(" missing")) {
    const std::size_t value = problem.find(" = ");
    const char* kind = is_number(*command, option) ? "number" : "whole number";
    const bool has_value = is_refused && problem.compare(value + 3, 2, "--") != 0;
    problem = has_value
                  ? fmt::format("{}: '{}' is not a {}", option, problem.substr(value + 3), kind)
                  : fmt::format("{} has no value", option);
    fix = fmt::format("give {} VALUE, as {} --help describes it", option, path);
  }
  return InputError("command line", problem, fix, "command.line");
}

// Adds a subcommand whose callback stores the function to run in `chosen`.
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
  CLI::App app{
      "twinarm: rigid-body dynamics solver with inspectable algorithms\n\n"
      "Examples:\n  twinarm lab\n  twinarm simulate assets/scenes/pendulum.toml --duration 1"};
  app.formatter(help_formatter());
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("twinarm ") + kProgramVersion,
                       "Print the version and exit");
  std::function<int(const Words&)> chosen;
  for (const Command& command : commands()) add_command(app, command, chosen);
  const bool as_json =
      std::any_of(argv, argv + argc, [](std::string_view word) { return word == "--json"; });
  try {
    find_command(app, argc, argv);
    check_values(argc, argv);
    app.parse(argc, argv);
  } catch (const InputError& error) {
    return report(error, as_json);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return print_help(app, error, as_json);
    return report(parse_fault(app, error, argc, argv), as_json);
  }

  catch_interrupts();
  end_children_when(is_interrupted);
  try {
    const int code = chosen({argv, argv + argc});
    check_stdout();
    return code;
  } catch (const InputError& error) {
    if (!is_interrupted()) return report(error, as_json);     // Ctrl-C also ends reading a mesh
  } catch (const std::filesystem::filesystem_error& error) {  // such as a name that is too long
    return report(InputError({{error.path1().string(), 0, "", error.code().message(),
                               "check the name and its folder", "file.unwritable"}}),
                  as_json);
  } catch (const Interrupted&) {  // reported below
  } catch (const std::exception& error) {
    // An error of printing may be the cause: then it is reported instead.
    const int code = check_output(kInternal, as_json);
    if (code == kInternal) print_error("twinarm: internal error: {}\n", error.what());
    return code;
  }
  print_error("twinarm: interrupted; no partial files were left\n");
  return kInterrupted;
}

}  // namespace
}  // namespace twinarm

int main(int argc, char** argv) {
  return twinarm::run_program(argc, argv);
}
