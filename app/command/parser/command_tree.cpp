#include "app/command/parser/command_tree.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "app/command/parser/shared_options.h"
#include "app/data/tables.h"

namespace twinarm {
namespace {

std::vector<std::string> paragraphs(const std::string& text) {
  std::vector<std::string> found;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find("\n\n", from), text.size());
    found.push_back(text.substr(from, end - from));
    from = end + 2;
  }
  return found;
}

// Separates the type from the checks in CLI11's type name: "FLOAT:above 0".
constexpr char kSeparator = ':';

// NUMBER, N, TEXT, PATH; empty: a flag.
std::string value_word(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  const std::string full = option.get_type_name(), type = full.substr(0, full.find(kSeparator));
  if (type == "FLOAT") return "NUMBER";
  if (type == "INT" || type == "UINT") return "N";
  return type;
}

// "above 0"; may be empty.
std::string value_limits(const CLI::Option& option) {
  const std::string full = option.get_type_name();
  const std::size_t at = full.find(kSeparator);
  return at == std::string::npos ? "" : full.substr(at + 1);
}

// "[]" is that of an empty list.
std::string default_text(const CLI::Option& option) {
  const std::string text = option.get_default_str();
  return text == "[]" ? "" : text;
}

OptionInfo describe(CLI::Option& option) {
  OptionInfo result;
  result.is_positional = option.get_positional();
  if (result.is_positional) {
    result.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  }
  if (option.get_items_expected_max() > 0) {
    result.value = value_word(option);
    result.preset = default_text(option);
  }
  result.help = option.get_description();
  if (const std::string limits = value_limits(option); !limits.empty())
    result.help += " (" + limits + ")";
  result.is_file = value_word(option) == kFileWord;
  result.is_required = option.get_required();
  return result;
}

void add_to_tree(CLI::App& command, const std::string& name, std::vector<CommandInfo>& tree) {
  CommandInfo result;
  result.name = name;
  result.details = paragraphs(command.get_description());
  if (!result.details.empty()) {
    result.summary = result.details.front();
    result.details.erase(result.details.begin());
  }
  for (CLI::Option* option : command.get_options()) result.options.push_back(describe(*option));
  std::stable_partition(result.options.begin(), result.options.end(),
                        [](const OptionInfo& option) { return option.is_positional; });
  const std::vector<CLI::App*> next = command.get_subcommands({});
  for (const CLI::App* below : next) result.subcommands.push_back(below->get_name());
  tree.push_back(std::move(result));
  for (CLI::App* below : next)
    add_to_tree(*below, (name.empty() ? "" : name + " ") + below->get_name(), tree);
}

// Columns of the terminal, else the variable COLUMNS, else no bound.
std::size_t page_width() {
  constexpr std::size_t kUnbounded = 100'000;
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  const char* variable = std::getenv("COLUMNS");
  const std::string_view text = variable ? variable : "";
  std::size_t columns = kUnbounded;
  std::from_chars(text.data(), text.data() + text.size(), columns);
  return columns;
}

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
    const std::string preset = default_text(*option);
    if (option->get_items_expected_max() > 0 && !preset.empty()) note("default " + preset);
    for (const CLI::Option* other : option->get_needs()) note("with " + other->get_name());
    for (const CLI::Option* other : option->get_excludes()) note("not with " + other->get_name());
    return in_column(option->get_description() + (notes.empty() ? "" : " (" + notes + ")"));
  }
  // Its first paragraph.
  std::string make_subcommand(const CLI::App* command) const override {
    std::ostringstream out;
    CLI::detail::format_help(out, command->get_name(),
                             in_column(paragraphs(command->get_description()).front()),
                             get_column_width());
    return out.str();
  }

 private:
  std::string in_column(const std::string& text) const {
    const std::size_t used = get_column_width(), columns = page_width();
    return wrapped(text, 0, columns > used + kMinColumn ? columns - used : kMinColumn);
  }
  static constexpr std::size_t kMinColumn = 30;  // of descriptions
};

}  // namespace

std::vector<CommandInfo> command_tree(CLI::App& program) {
  std::vector<CommandInfo> tree;
  add_to_tree(program, "", tree);
  return tree;
}

std::shared_ptr<CLI::FormatterBase> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

}  // namespace twinarm
