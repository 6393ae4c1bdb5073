// The options of each command, a file each beside this one. A new command is such a file, its line
// in the two lists below, and its function in commands.h.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace twinarm {

struct CommandLine {
  std::vector<std::string> words;  // as they were typed, the program first
  std::function<int()> chosen;     // the command with its options; gives the exit code
};

// Each adds its command. When its words are parsed, `line.chosen` runs it; `app` keeps the options.
void add_compare(CLI::App& app, CommandLine& line);
void add_coupling(CLI::App& app, CommandLine& line);
void add_dynamics(CLI::App& app, CommandLine& line);
void add_hand(CLI::App& app, CommandLine& line);
void add_help(CLI::App& app, CommandLine& line);
void add_inspect(CLI::App& app, CommandLine& line);
void add_lab(CLI::App& app, CommandLine& line);
void add_make_robot(CLI::App& app, CommandLine& line);
void add_map(CLI::App& app, CommandLine& line);
void add_modes(CLI::App& app, CommandLine& line);
void add_recordings(CLI::App& app, CommandLine& line);
void add_render(CLI::App& app, CommandLine& line);
void add_simulate(CLI::App& app, CommandLine& line);
void add_study(CLI::App& app, CommandLine& line);
void add_trial(CLI::App& app, CommandLine& line);
void add_trace(CLI::App& app, CommandLine& line);
void add_zwidth(CLI::App& app, CommandLine& line);

// In the order in which help lists them.
inline constexpr void (*kAddCommands[])(CLI::App&, CommandLine&) = {
    add_lab,   add_dynamics,   add_inspect,    add_modes,  add_coupling, add_simulate,
    add_hand,  add_trial,      add_recordings, add_render, add_compare,  add_map,
    add_study, add_make_robot, add_trace,      add_zwidth, add_help};

}  // namespace twinarm
