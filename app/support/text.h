// Names and their misspellings, CSV, SI prefixes; errors collected from several calls.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "solver/support/diagnostics.h"
#include "solver/support/text.h"

namespace twinarm {

// The name with the smallest edit distance (insert, delete, change, swap) of it or of its
// beginning, ignoring case; empty if all distances exceed half of the letters, a third for a
// beginning.
std::string nearest_name(std::string_view misspelt, const std::vector<std::string>& names);

// "did you mean 'elbow'?" and up to 12 of the names; `kind`: "joints". Of a renamed one (renames.h)
// its new name.
std::string name_remedy(std::string_view misspelt, const std::vector<std::string>& names,
                        std::string_view kind);

// Index of `name`, or a diagnostic of the option `where` with the nearest name.
std::optional<std::size_t> choose(const std::string& where, const std::string& name,
                                  const std::vector<std::string>& names, std::string_view kind,
                                  DiagnosticList& faults, std::string_view code = "option.choice");

// The result of f (monostate if void); nothing if it throws InputError, whose diagnostics are
// added.
template <class F>
auto attempt(DiagnosticList& faults, F f) {
  using Result = std::invoke_result_t<F>;
  std::optional<std::conditional_t<std::is_void_v<Result>, std::monostate, Result>> found;
  try {
    if constexpr (std::is_void_v<Result>)
      f(), found.emplace();
    else
      found.emplace(f());
  } catch (const InputError& error) {
    faults.add(error.faults());
  }
  return found;
}

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.emplace_back(item.name);
  return names;
}

std::string csv_field(const std::string& text);                // quoted if necessary; no formula
std::string csv_line(const std::vector<std::string>& fields);  // without line end
std::string csv_line(const std::vector<double>& numbers);

// Of the unit in which the value is from 1 to 1000, or nano if it is smaller; of 0 none.
struct SiPrefix {
  double factor;
  const char* name;
};
SiPrefix si_prefix(double value);

// ---- names that replaced others in options, scene files and JSON output (assets/renamed.json)
// ----

// The name that replaced `old`; empty if none did. `kind`: "commands", "options" (with "--"),
// "keys" and "values" of scene files, "choices" of options.
std::string renamed(const std::string& kind, const std::string& old);

}  // namespace twinarm
