#include "app/support/text_fields.h"

#include "solver/support/number_text.h"

namespace twinarm {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
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

}  // namespace twinarm
