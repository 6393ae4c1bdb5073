// Options that several commands take, and files, whose names must not be empty.
#pragma once

#include <filesystem>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace twinarm {

struct RobotOptions;

// An option, or a word without dashes, that names a file or a folder. An empty name is refused: it
// comes from a variable of a script that is not set.
CLI::Option* add_file_option(CLI::App& command, const char* name, std::filesystem::path& file,
                             const char* help);
CLI::Option* add_file_option(CLI::App& command, const char* name,
                             std::vector<std::filesystem::path>& files, const char* help);

// The model that a command is about, which `model` describes, its state, and what to leave out.
void add_robot_options(CLI::App& command, RobotOptions& options, const char* model);

}  // namespace twinarm
