// Options that several commands take, and files, whose names must not be empty.
#pragma once

#include <filesystem>
#include <vector>

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace twinarm {

struct RobotOptions;

// An option, or a word without dashes, that names a file or a folder. An empty name is refused: it
// comes from a variable of a script that is not set.
CLI::Option* add_file_option(CLI::App& command, const char* name, std::filesystem::path& file,
                             const char* help);
CLI::Option* add_file_option(CLI::App& command, const char* name,
                             std::vector<std::filesystem::path>& files, const char* help);
// One that is only read: assets/.. is found wherever the program runs (find_input).
CLI::Option* add_input_option(CLI::App& command, const char* name, std::filesystem::path& file,
                              const char* help);
bool is_file_option(CLI::Option& option);  // made by one of these

// Checks of numbers, called as the help tells them (help_formatter.h).
CLI::Validator above_zero();
CLI::Validator zero_or_more();
CLI::Validator between(int least, int most);

// The model that a command is about, which `model` describes, its state, and what to leave out.
void add_robot_options(CLI::App& command, RobotOptions& options, const char* model);

}  // namespace twinarm
