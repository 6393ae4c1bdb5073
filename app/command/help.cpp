// `twinarm help`: help of a command, a glossary entry, manual, completion.
#include <fmt/format.h>
#include <algorithm>
#include <regex>

#include "app/command/command.h"
#include "app/command/parser/command_tree.h"
#include "app/scene/read/scene_keys.h"
#include "app/support/text.h"
#include "app/support/version.h"
#include "solver/support/diagnostics.h"
#include "solver/support/embedded_file.h"

namespace twinarm {

const std::vector<EmbeddedFile>& glossary_files();  // CMakeLists.txt

namespace {

struct HelpOptions {
  CLI::App* program = nullptr;
  std::vector<std::string> words;
  std::string completion;
  bool man = false, scene_keys = false;
};

void add_options(const OptionAdder& add, HelpOptions& options) {
  options.program = add.command.get_parent();
  add("word", options.words, "a command, or a term of the glossary; default: the list of commands");
  add.group("Instead");
  CLI::Option* man = add("--man", options.man, "print the man page, for man -l -");
  CLI::Option* completion =
      add("--completion", options.completion,
          "print the completion script for this shell: commands, options, files")
          ->check(CLI::IsMember({"bash", "zsh", "fish"}))
          ->type_name("bash|zsh|fish")
          ->expected(0, 1)
          ->default_str("bash")
          ->excludes(man);
  add("--scene-keys", options.scene_keys,
      "print tables of the numbers in a scene file: units, defaults, ranges, meanings")
      ->excludes(man)
      ->excludes(completion);
}

const CLI::App* find_subcommand(const CLI::App& parent, const std::string& name) {
  for (const CLI::App* command : parent.get_subcommands({}))
    if (command->get_name() == name) return command;
  return nullptr;
}

// A Markdown cell as plain text: links by their names, formulas by their letters.
std::string plain(const std::string& cell) {
  std::string text = std::regex_replace(cell, std::regex(R"(\[([^\]]*)\]\([^)]*\))"), "$1");
  text = std::regex_replace(text, std::regex(R"([\\$`]|^ +| +$)"), "");
  return text;
}

// The rows of the glossary's tables: term, symbol, unit, meaning, source; or a word that is not
// used and its replacement.
std::vector<std::vector<std::string>> glossary_rows() {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : split(std::string(glossary_files().front().text), '\n')) {
    if (!line.starts_with("| ")) continue;
    std::vector<std::string> cells;
    static const std::regex kCell(R"(((?:[^|\\]|\\.)*)\|)");
    for (std::sregex_iterator cell(line.begin() + 1, line.end(), kCell), end; cell != end; ++cell)
      cells.push_back(plain((*cell)[1]));
    if (cells.front() != "term" && cells.front() != "not") rows.push_back(std::move(cells));
  }
  return rows;
}

// The entries whose term or symbol is `word`; the names of all terms are added to `terms`.
std::string glossary_entries(const std::string& word, std::vector<std::string>& terms) {
  std::string text;
  for (const std::vector<std::string>& row : glossary_rows()) {
    std::vector<std::string> names = split(row[0] + (row.size() == 5 ? "," + row[1] : ""));
    for (std::string& name : names) name.erase(0, name.find_first_not_of(' '));
    terms.push_back(names.front());
    if (std::ranges::find(names, word) == names.end()) continue;
    if (row.size() != 5) {
      text += fmt::format("{}: not used; use {}\n", row[0], row[1]);
      continue;
    }
    text += row[0] + (row[1].empty() ? "" : ", symbol " + row[1]) +
            (row[2].empty() ? "" : " [" + row[2] + "]") + "\n  " + row[3] + "\n" +
            (row[4].empty() ? "" : "  source: " + row[4] + "\n");
  }
  return text;
}

// The help of a command, or else a glossary entry.
std::string help_of(const CLI::App& program, const std::vector<std::string>& words) {
  const CLI::App* command = &program;
  std::string path = "twinarm";
  for (const std::string& word : words) {
    const CLI::App* parent = command;
    command = find_subcommand(*parent, word);
    path += " " + word;
    if (command) continue;
    std::vector<std::string> names;
    for (const CLI::App* other : parent->get_subcommands({})) names.push_back(other->get_name());
    if (parent == &program)
      if (std::string found = glossary_entries(fmt::format("{}", fmt::join(words, " ")), names);
          !found.empty())
        return found;
    throw InputError("help", fmt::format("there is no command or term '{}'", word),
                     names.empty() ? "leave it out" : name_remedy(word, names, "words"),
                     "command.unknown");
  }
  return command->get_formatter()->make_help(command, path, CLI::AppFormatMode::Normal);
}

int run_help(const HelpOptions& options) {
  CLI::App& program = *options.program;
  fmt::print("{}", options.man                   ? man_page(program, kProgramVersion)
                   : !options.completion.empty() ? shell_completion(program, options.completion)
                   : options.scene_keys          ? scene_numbers()
                                                 : help_of(program, options.words));
  return 0;
}

}  // namespace

Command help_command() {
  return {180, "help",
          "Print the help of a command, a glossary entry, or the manual\n\n"
          "Examples:\n"
          "  twinarm help coupling predict\n"
          "  twinarm help \"bias force\"",
          add_options, run_help};
}

}  // namespace twinarm
