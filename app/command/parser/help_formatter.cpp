#include "app/command/parser/help_formatter.h"

#include <CLI/CLI.hpp>

namespace twinarm {
namespace {

// CLI11 says "FLOAT:above 0": the type, and what each check is called.
constexpr char kBetween = ':';

class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string words = value_word(*option);
    if (words.empty()) return words;
    if (option->get_expected_max() == CLI::detail::expected_max_vector_size) words += " ...";
    if (option->get_required()) words += " (required)";
    return " " + words;
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    std::string notes;
    const auto note = [&](const std::string& words) {
      if (!words.empty()) notes += (notes.empty() ? "" : "; ") + words;
    };
    note(value_limits(*option));
    const std::string preset = option->get_default_str();
    if (option->get_items_expected_max() > 0 && !preset.empty()) note("if not given " + preset);
    for (const CLI::Option* other : option->get_needs()) note("with " + other->get_name());
    for (const CLI::Option* other : option->get_excludes()) note("not with " + other->get_name());
    return option->get_description() + (notes.empty() ? "" : " (" + notes + ")");
  }
};

}  // namespace

std::string value_word(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  const std::string told = option.get_type_name(), type = told.substr(0, told.find(kBetween));
  if (type == "FLOAT") return "NUMBER";
  if (type == "INT" || type == "UINT") return "N";
  return type;
}

std::string value_limits(const CLI::Option& option) {
  const std::string told = option.get_type_name();
  const std::size_t at = told.find(kBetween);
  return at == std::string::npos ? "" : told.substr(at + 1);
}

std::shared_ptr<CLI::FormatterBase> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

}  // namespace twinarm
