#include "app/support/text.h"

#include <algorithm>
#include <cmath>

#include "solver/support/number_text.h"

namespace twinarm {
namespace {

// Optimal string alignment distance (Levenshtein with swaps of neighbours).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before2, before(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) before[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = a[i - 1] == b[j - 1];
      now[j] = std::min({before[j] + 1, now[j - 1] + 1, before[j - 1] + (same ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        now[j] = std::min(now[j], before2[j - 2] + 1);
    }
    before2 = before;
    std::swap(before, now);
  }
  return before[b.size()];
}

}  // namespace

std::string nearest_name(std::string_view misspelt, const std::vector<std::string>& names) {
  constexpr std::size_t kMaxLength = 200;  // longer words are not misspellings
  if (misspelt.size() > kMaxLength) return "";
  const std::size_t n = misspelt.size();
  const std::string word = lower_case(misspelt);
  std::string nearest;
  std::size_t min = 2 * std::max<std::size_t>(2, (n + 1) / 2);
  for (const std::string& name : names) {
    if (name.size() > kMaxLength) continue;
    const std::string lower = lower_case(name);
    std::size_t d = 2 * distance(word, lower);
    const std::size_t of_start = distance(word, lower.substr(0, n));
    if (3 * of_start <= n) d = std::min(d, 2 * of_start + 1);
    if (d > min || (d == min && !nearest.empty())) continue;
    min = d;
    nearest = name;
  }
  return nearest;
}

std::string name_remedy(std::string_view misspelt, const std::vector<std::string>& names,
                        std::string_view kind) {
  constexpr std::size_t kMany = 12;
  for (const char* of : {"commands", "keys", "values", "choices"})
    if (const std::string now = renamed(of, std::string(misspelt));
        std::ranges::find(names, now) != names.end())
      return "'" + std::string(misspelt) + "' is now '" + now + "'";
  std::string fix;
  if (const std::string nearest = nearest_name(misspelt, names); !nearest.empty())
    fix = "did you mean '" + nearest + "'?";
  if (!fix.empty() && names.size() > kMany) return fix;
  if (!fix.empty()) fix += " ";
  if (names.empty()) return fix + "there are no " + std::string(kind);
  fix += std::string(kind) + ":";
  for (std::size_t i = 0; i < std::min(names.size(), kMany); ++i) fix += " " + names[i];
  if (names.size() > kMany) fix += " and " + std::to_string(names.size() - kMany) + " more";
  return fix;
}

std::optional<std::size_t> choose(const std::string& where, const std::string& name,
                                  const std::vector<std::string>& names, std::string_view kind,
                                  DiagnosticList& faults, std::string_view code) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  faults.add(where, "there is no '" + name + "'", name_remedy(name, names, kind), code);
  return std::nullopt;
}

std::string csv_field(const std::string& text) {
  // A spreadsheet computes a cell that begins with one of these, even in quotes.
  if (!text.empty() && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos)
    return csv_field("'" + text);
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) line += (line.empty() ? "" : ",") + csv_field(field);
  return line;
}

std::string csv_line(const std::vector<double>& numbers) {
  std::string line;
  for (const double number : numbers) line += (line.empty() ? "" : ",") + number_text(number);
  return line;
}

SiPrefix si_prefix(double value) {
  SiPrefix found{1e-9, "n"};
  for (const SiPrefix& p : {SiPrefix{1e-6, "µ"}, {1e-3, "m"}, {1, ""}, {1e3, "k"}, {1e6, "M"}})
    if (std::abs(value) >= 0.9995 * p.factor) found = p;
  return value == 0 ? SiPrefix{1, ""} : found;
}

}  // namespace twinarm
