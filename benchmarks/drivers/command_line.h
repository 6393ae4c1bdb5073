// Shared by the benchmark programs: options and exit codes.
#pragma once

#include <algorithm>
#include <charconv>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace twinarm::bench {

// Splits A,B,C.
inline std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  if (parts.empty()) throw std::invalid_argument("the list is empty");
  return parts;
}

template <class Number>
Number positive(const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !(number > 0))
    throw std::invalid_argument(text + " is not a positive number");
  return number;
}

// An empty list contains all names.
inline bool chosen(const std::vector<std::string>& list, std::string_view name) {
  return list.empty() || std::ranges::find(list, name) != list.end();
}

// What an option sets: a list, a positive number, a flag; or what a flag does.
using Option = std::variant<std::vector<std::string>*, int*, double*, bool*, std::function<void()>>;

inline void read_options(int argc, char** argv, const std::map<std::string, Option>& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const auto found = options.find(name);
    if (found == options.end()) throw std::invalid_argument("unknown option " + name);
    const Option& option = found->second;
    if (const auto* action = std::get_if<std::function<void()>>(&option))
      (*action)();
    else if (auto* const* flag = std::get_if<bool*>(&option))
      **flag = true;
    else if (++i == argc)
      throw std::invalid_argument(name + " needs a value");
    else if (auto* const* list = std::get_if<std::vector<std::string>*>(&option))
      **list = split(argv[i]);
    else if (auto* const* whole = std::get_if<int*>(&option))
      **whole = positive<int>(argv[i]);
    else
      *std::get<double*>(option) = positive<double>(argv[i]);
  }
}

// Reads the options, checks them, and runs the program. Returns its exit code; 2 for a bad option,
// 4 if the program fails.
inline int run_program(
    const std::string& program, const char* usage, int argc, char** argv,
    std::map<std::string, Option> options, const std::function<int()>& run,
    const std::function<void()>& check = [] {}) {
  bool help = false;
  options["--help"] = options["-h"] = &help;
  try {
    read_options(argc, argv, options);
    check();
  } catch (const std::exception& fault) {
    std::cerr << program << ": " << fault.what() << "; see --help\n";
    return 2;
  }
  if (help) {
    std::cout << usage;
    return 0;
  }
  try {
    return run();
  } catch (const std::exception& fault) {
    std::cerr << program << ": " << fault.what() << '\n';
    return 4;
  }
}

// Throws if a wanted name is unknown.
inline void check_known(const std::vector<std::string>& wanted,
                        const std::vector<std::string>& known, const std::string& what,
                        const std::string& fix) {
  for (const std::string& name : wanted)
    if (std::ranges::find(known, name) == known.end())
      throw std::invalid_argument("no " + what + " " + name + fix);
}

}  // namespace twinarm::bench
