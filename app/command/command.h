// A command is a file of this folder that defines `Command STEM_command()`. Help, manual and
// completion are made from these entries (docs/develop/extending.md).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/command/parser/shared_options.h"

namespace twinarm {

using Words = std::vector<std::string>;  // the command line as typed, with the program's name

struct Command {
  // `add` adds the options. `run(options)` or `run(options, words)` returns the exit code; it
  // throws InputError for bad input and Interrupted after Ctrl-C.
  template <class Options, class... Typed>
  Command(int at, std::string called, std::string text, void (*add)(const OptionAdder&, Options&),
          int (*run)(const Options&, Typed...))
      : place(at), name(std::move(called)), help(std::move(text)) {
    prepare = [add, run](CLI::App& command) {
      const auto options = std::make_shared<Options>();
      const OptionAdder adder{command};
      add(adder, *options);
      return [options, run, files = adder.files]([[maybe_unused]] const Words& words) {
        check_files(*files);
        if constexpr (sizeof...(Typed) == 0)
          return run(*options);
        else
          return run(*options, words);
      };
    };
  }
  Command(int at, std::string called, std::string text, std::vector<Command> commands)
      : place(at), name(std::move(called)), help(std::move(text)), below(std::move(commands)) {}

  int place;         // in the list of commands, ascending
  std::string name;  // as typed
  std::string help;  // paragraphs: summary in one sentence, "Examples:" with one per line, notes
  // Adds the options and returns the function that runs with them.
  std::function<std::function<int(const Words&)>(CLI::App&)> prepare;
  std::vector<Command> below;  // subcommands, as in "coupling predict"
};

const std::vector<Command>& commands();  // by `place`

}  // namespace twinarm
