// Adds the options of a command; the ranges of their numbers.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace twinarm {

struct RobotOptions;

inline constexpr const char* kFileWord = "PATH";  // value of a file option in help texts

// A file or folder on the command line.
struct FileOption {
  const CLI::Option* option;
  bool is_output;
  std::string ending;  // of an output; empty: a folder. Of an input: ".toml .urdf"; empty: any
};
using FileOptions = std::vector<FileOption>;

struct OptionAdder {
  CLI::App& command;
  std::shared_ptr<FileOptions> files = std::make_shared<FileOptions>();

  // The options added after this call appear under this heading in the help, with their defaults.
  void group(const char* heading) const {
    command.option_defaults()->group(heading)->always_capture_default();
  }
  // By the type of the value: a flag (bool), a file or folder (path), a number or a text.
  // "--name": an option, "name": a positional argument.
  template <class T>
  CLI::Option* operator()(const char* name, T& value, const std::string& help) const {
    if constexpr (std::is_same_v<T, bool>)
      return command.add_flag(name, value, help);
    else if constexpr (std::is_same_v<T, std::filesystem::path> ||
                       std::is_same_v<T, std::vector<std::filesystem::path>>)
      return as_file(command.add_option(name, value, help));
    else
      return command.add_option(name, value, help);
  }
  // An input file, or several; names that begin with assets/ are looked up by find_input().
  template <class Paths>
  CLI::Option* input(const char* name, Paths& file, const char* endings, const char* help) const {
    return as_input((*this)(name, file, help), endings);
  }
  // An output file with names in `ending` (".svg"), or an output folder ("").
  CLI::Option* output(const char* name, std::filesystem::path& file, const char* ending,
                      const std::string& help) const;

  // Options that several commands share.
  void json(bool& value) const { (*this)("--json", value, "print one JSON object on stdout"); }
  void assets(std::filesystem::path& folder) const {
    (*this)("--assets", folder, "folder with robots and settings; default: beside the program");
  }
  void scene_step(std::optional<double>& step, std::string& integrator) const;
  // The model, described by `model`, its state, and which of its effects to ignore.
  void robot(RobotOptions& options, const char* model) const;

 private:
  // An empty name is an error: an unset shell variable.
  static CLI::Option* as_file(CLI::Option* option);
  CLI::Option* as_input(CLI::Option* option, const char* endings) const;
};

inline constexpr const char* kModelEndings = ".toml .urdf .xacro .twinrec";

// Throws InputError if the input is a folder, an empty file or of another kind. `wanted`: for the
// remedy, up to a semicolon.
void check_input(const std::filesystem::path& file, const std::string& option,
                 const std::string& endings, const std::string& wanted);
// Throws InputError, before anything is read or written, if an input is of another kind, or if an
// output is also an input or another output, is of another kind, or cannot be written.
void check_files(const FileOptions& files);

// Ranges of numbers, described as in help texts (command_tree.h).
CLI::Validator above_zero(double max = HUGE_VAL);
CLI::Validator zero_or_more();
CLI::Validator between(int min, int max);

std::string integrator_names();  // "semi-implicit, rk4, .."

}  // namespace twinarm
