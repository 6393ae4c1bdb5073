// Options that several commands share; file arguments.
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

inline constexpr const char* kFileWord = "PATH";  // their values in help texts

// The options added after this call appear under this heading in the help, with their defaults.
void begin_group(CLI::App& command, const char* heading);

// An option or positional argument that names a file or folder. An empty name is an error: an unset
// shell variable.
CLI::Option* add_file_option(CLI::App& command, const char* name, std::filesystem::path& file,
                             const char* help);
CLI::Option* add_file_option(CLI::App& command, const char* name,
                             std::vector<std::filesystem::path>& files, const char* help);
// An input file; names that begin with assets/ are looked up by find_input().
CLI::Option* add_input_option(CLI::App& command, const char* name, std::filesystem::path& file,
                              const char* help);

// Ranges of numbers, described as in help texts (command_tree.h).
CLI::Validator above_zero();
CLI::Validator zero_or_more();
CLI::Validator between(int min, int max);

void add_json_option(CLI::App& command, bool& json);
void add_assets_option(CLI::App& command, std::filesystem::path& assets);
void add_scene_step_options(CLI::App& command, std::optional<double>& step,
                            std::string& integrator);
std::string integrator_names();  // "semi-implicit, rk4, .."

// The model, described by `model`, its state, and which of its effects to ignore.
void add_robot_options(CLI::App& command, RobotOptions& options, const char* model);

}  // namespace twinarm
