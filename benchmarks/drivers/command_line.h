// Shared by the benchmark programs: options and exit codes.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "solver/support/number_text.h"

namespace twinarm::bench {

using Names = std::vector<std::string>;

// An empty list contains all names.
inline bool chosen(const Names& list, std::string_view name) {
  return list.empty() || std::ranges::find(list, name) != list.end();
}

// An option --name A,B with names of `known`.
template <class Known>
void add_names(CLI::App& program, const char* name, Names& list, const std::string& help,
               const Known& known) {
  program.add_option(name, list, help)->delimiter(',')->check(CLI::IsMember(known));
}
template <class Number>
void add_positive(CLI::App& program, const char* name, Number& number, const std::string& help) {
  const auto fault = [](const std::string& text) {
    return parse_number(text).value_or(0) > 0 ? "" : text + " is not a positive number";
  };
  program.add_option(name, number, help)->check(fault)->capture_default_str();
}
// --list prints these lines and ends the program.
inline void add_list(CLI::App& program, const std::string& help, const Names& lines) {
  const auto print = [lines] {
    for (const std::string& line : lines) std::cout << line << '\n';
    throw CLI::Success();
  };
  program.add_flag_callback("--list", print, help);
}

// Reads the options and runs the program. Returns its exit code; 2 for a bad option, 4 if it fails.
inline int run_program(CLI::App& program, int argc, char** argv, const std::function<int()>& run) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& fault) {
    return program.exit(fault) == 0 ? 0 : 2;
  }
  try {
    return run();
  } catch (const std::exception& fault) {
    std::cerr << program.get_name() << ": " << fault.what() << '\n';
    return 4;
  }
}

}  // namespace twinarm::bench
