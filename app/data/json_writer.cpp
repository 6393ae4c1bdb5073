#include "app/data/json_writer.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "solver/support/number_text.h"

namespace twinarm {
namespace {

// Quoted and escaped; invalid UTF-8 is replaced.
std::string quoted(std::string_view text) {
  const nlohmann::ordered_json json = std::string(text);
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

JsonWriter& JsonWriter::key(std::string_view name) {
  separate();
  if (depth_ == 1) {  // on a new line
    if (text_.ends_with(' ')) text_.pop_back();
    text_ += '\n';
  }
  text_ += quoted(name);
  text_ += ": ";
  keyed_ = true;
  return *this;
}

void JsonWriter::number(double value) {
  if (!std::isfinite(value)) return null();
  std::string digits = number_text(value);
  if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
  write(digits);
}
void JsonWriter::text(std::string_view value) {
  write(quoted(value));
}

void JsonWriter::number_or_list(const std::vector<double>& values) {
  if (values.size() == 1) return number(values[0]);
  numbers(values);
}

void JsonWriter::open(char bracket) {
  separate();
  text_ += bracket;
  ++depth_;
  first_ = true;
}
void JsonWriter::close(char bracket) {
  text_ += bracket;
  --depth_;
  first_ = false;
}
void JsonWriter::separate() {
  if (!first_ && !keyed_) text_ += ", ";
  first_ = keyed_ = false;
}
void JsonWriter::write(std::string_view item) {
  separate();
  text_ += item;
}

}  // namespace twinarm
