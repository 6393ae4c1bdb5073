// What entries of devices.h read from the text after a name, and how they refuse it.
#pragma once

#include <charconv>
#include <optional>
#include <string>

#include "solver/support/diagnostics.h"

namespace twinarm {

[[noreturn]] inline void refuse_spec(const std::string& spec, const std::string& rule,
                                     const std::string& remedy) {
  throw InputError({{"", 0, "--device " + spec, rule, remedy}});
}

template <class Number>
std::optional<Number> whole_number(const std::string& text) {
  Number value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace twinarm
