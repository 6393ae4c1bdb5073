// Options that several commands take, and files, whose names must not be empty.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace twinarm {

struct RobotOptions;

inline constexpr const char* kFileWord = "PATH";  // what the value of these is called

// An option, or a word without dashes, that names a file or a folder. An empty name is refused: it
// comes from a variable of a script that is not set.
CLI::Option* add_file_option(CLI::App& command, const char* name, std::filesystem::path& file,
                             const char* help);
CLI::Option* add_file_option(CLI::App& command, const char* name,
                             std::vector<std::filesystem::path>& files, const char* help);
// One that is only read: assets/.. is found wherever the program runs (find_input).
CLI::Option* add_input_option(CLI::App& command, const char* name, std::filesystem::path& file,
                              const char* help);

// Checks of numbers, called as the help tells them (command_tree.h).
CLI::Validator above_zero();
CLI::Validator zero_or_more();
CLI::Validator between(int least, int most);

void add_json_option(CLI::App& command, bool& json);  // in place of text for people
void add_assets_option(CLI::App& command, std::filesystem::path& assets);
// In place of a scene's own.
void add_scene_step_options(CLI::App& command, std::optional<double>& step,
                            std::string& integrator);
std::string integrator_names();  // " semi-implicit rk4 ..", for help

// The model that a command is about, which `model` describes, its state, and what to leave out.
void add_robot_options(CLI::App& command, RobotOptions& options, const char* model);

}  // namespace twinarm
