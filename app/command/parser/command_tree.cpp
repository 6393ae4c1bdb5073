#include "app/command/parser/command_tree.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/command/parser/help_formatter.h"
#include "app/command/parser/shared_options.h"

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

ToldOption told(CLI::Option& option) {
  ToldOption result;
  result.is_word = option.get_positional();
  if (result.is_word) {
    result.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  }
  if (option.get_items_expected_max() > 0) {
    result.value = value_word(option);
    result.preset = option.get_default_str();
  }
  result.help = option.get_description();
  if (const std::string limits = value_limits(option); !limits.empty())
    result.help += " (" + limits + ")";
  result.is_file = value_word(option) == kFileWord;
  result.is_required = option.get_required();
  return result;
}

void tell(CLI::App& command, const std::string& name, std::vector<ToldCommand>& tree) {
  ToldCommand result;
  result.name = name;
  result.details = paragraphs(command.get_description());
  if (!result.details.empty()) {
    result.summary = result.details.front();
    result.details.erase(result.details.begin());
  }
  for (CLI::Option* option : command.get_options()) result.options.push_back(told(*option));
  std::stable_partition(result.options.begin(), result.options.end(),
                        [](const ToldOption& option) { return option.is_word; });
  const std::vector<CLI::App*> next = command.get_subcommands({});
  for (const CLI::App* follower : next) result.followers.push_back(follower->get_name());
  tree.push_back(std::move(result));
  for (CLI::App* follower : next)
    tell(*follower, (name.empty() ? "" : name + " ") + follower->get_name(), tree);
}

}  // namespace

std::vector<ToldCommand> command_tree(CLI::App& program) {
  std::vector<ToldCommand> tree;
  tell(program, "", tree);
  return tree;
}

}  // namespace twinarm
