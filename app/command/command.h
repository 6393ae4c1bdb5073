// A command of the program is a file of this folder that defines `Command STEM_command()`. Help,
// manual and completion are made from these entries (docs/develop/extending.md).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace twinarm {

using Words = std::vector<std::string>;  // the command line as it was typed, the program first

struct Command {
  // `add` adds the options. `run` gives the exit code; it throws InputError for bad input and
  // Interrupted after Ctrl-C.
  template <class Options>
  Command(int at, std::string called, std::string text, void (*add)(CLI::App&, Options&),
          int (*run)(const Options&, const Words&))
      : place(at), name(std::move(called)), help(std::move(text)) {
    prepare = [add, run](CLI::App& command) {
      const auto options = std::make_shared<Options>();
      add(command, *options);
      return [options, run](const Words& words) { return run(*options, words); };
    };
  }
  template <class Options>
  Command(int at, std::string called, std::string text, void (*add)(CLI::App&, Options&),
          int (*run)(const Options&))
      : place(at), name(std::move(called)), help(std::move(text)) {
    prepare = [add, run](CLI::App& command) {
      const auto options = std::make_shared<Options>();
      add(command, *options);
      return [options, run](const Words&) { return run(*options); };
    };
  }
  Command(int at, std::string called, std::string text, std::vector<Command> commands)
      : place(at), name(std::move(called)), help(std::move(text)), below(std::move(commands)) {}

  int place;         // in the list of commands, ascending
  std::string name;  // as it is typed
  std::string help;  // a line, an example, and what else there is to say, as paragraphs
  // Adds the options; gives what runs with them.
  std::function<std::function<int(const Words&)>(CLI::App&)> prepare;
  std::vector<Command> below;  // those of which one comes next: "coupling predict"
};

const std::vector<Command>& commands();  // by the names of their files

}  // namespace twinarm
