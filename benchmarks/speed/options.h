// Values of the benchmarks' command lines. Both throw std::invalid_argument, in words for people.
#pragma once

#include <charconv>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace twinarm::speed {

// A,B,C; at least one.
inline std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  if (parts.empty()) throw std::invalid_argument("an empty list");
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

}  // namespace twinarm::speed
