// Shared by the benchmark programs: options, exit codes, statistics of repetitions.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
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

// NAN of no values.
inline double median_of(std::vector<double> values) {
  if (values.empty()) return NAN;
  std::ranges::sort(values);
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}
// (longest - shortest) / median.
inline double spread_of(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  return (high - low) / median_of(values);
}

// Options by name. Exit codes: 2 for a bad option, 4 if the program fails.
class CommandLine {
 public:
  CommandLine(std::string program, const char* usage)
      : program_(std::move(program)), usage_(usage) {
    flag("--help", help_), flag("-h", help_);
  }
  void list(const std::string& name, std::vector<std::string>& values) {
    options_[name] = {true, [&](const std::string& text) { values = split(text); }};
  }
  template <class Number>
  void number(const std::string& name, Number& value) {
    options_[name] = {true, [&](const std::string& text) { value = positive<Number>(text); }};
  }
  void flag(const std::string& name, std::function<void()> set) {
    options_[name] = {false, [set = std::move(set)](const std::string&) { set(); }};
  }
  void flag(const std::string& name, bool& value) {
    flag(name, [&value] { value = true; });
  }

  // Reads and checks the options, and runs the program.
  int run(
      int argc, char** argv, const std::function<int()>& program,
      const std::function<void()>& check = [] {}) const {
    try {
      for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        const auto option = options_.find(name);
        if (option == options_.end()) throw std::invalid_argument("unknown option " + name);
        if (option->second.has_value && ++i == argc)
          throw std::invalid_argument(name + " needs a value");
        option->second.set(argv[i]);
      }
      check();
    } catch (const std::exception& fault) {
      std::cerr << program_ << ": " << fault.what() << "; see --help\n";
      return 2;
    }
    if (help_) {
      std::cout << usage_;
      return 0;
    }
    try {
      return program();
    } catch (const std::exception& fault) {
      std::cerr << program_ << ": " << fault.what() << '\n';
      return 4;
    }
  }

 private:
  struct Option {
    bool has_value;
    std::function<void(const std::string&)> set;
  };
  std::string program_;
  const char* usage_;
  bool help_ = false;
  std::map<std::string, Option> options_;
};

// Throws if a wanted name is unknown.
inline void check_known(const std::vector<std::string>& wanted,
                        const std::vector<std::string>& known, const std::string& what,
                        const std::string& fix) {
  for (const std::string& name : wanted)
    if (std::ranges::find(known, name) == known.end())
      throw std::invalid_argument("no " + what + " " + name + fix);
}

}  // namespace twinarm::bench
