// Completion for a shell: which words may stand where, as one function of bash. Options whose value
// is a file complete files; those with another value complete nothing.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/command/parser/command_tree.h"

namespace twinarm {
namespace {

struct CompletedWords {
  std::string next, files, values;  // what may come, options before a file, and before a value
  bool is_file = false;             // a word without dashes is one
};

CompletedWords completed_words(const ToldCommand& command) {
  CompletedWords words;
  const auto add = [](std::string& list, const std::string& word) {
    list += (list.empty() ? "" : " ") + word;
  };
  for (const std::string& follower : command.followers) add(words.next, follower);
  for (const ToldOption& option : command.options) {
    if (option.is_word) words.is_file = words.is_file || option.is_file;
    if (option.is_word) continue;
    for (const std::string& name : option.names) {
      if (name.starts_with("--")) add(words.next, name);
      if (option.is_file)
        add(words.files, name);
      else if (!option.value.empty())
        add(words.values, name);
    }
  }
  return words;
}

// Names of commands and options have no blanks or quotes. zsh runs it too, after bashcompinit.
constexpr const char* kFunction = R"(# Made by `twinarm help --completion`.
_twinarm() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD-1]}}"
  local path="" next="" files="" values="" word_is_file="" i IFS=$'\n'
  if [ "$word" = "=" ]; then word=""; fi
  if [ "$before" = "=" ]; then before="${{COMP_WORDS[COMP_CWORD-2]}}"; fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "$path ${{COMP_WORDS[i]}}" in
      {0}) path="$path ${{COMP_WORDS[i]}}" ;;
    esac
  done
  case "$path" in
{1}  esac
  COMPREPLY=()
  case " $values " in *" $before "*) return ;; esac
  case " $files " in *" $before "*) word_is_file=yes next="" ;; esac
  case "$word" in
    -*) word_is_file="" ;;
  esac
  if [ -n "$word_is_file" ]; then
    COMPREPLY=($(compgen -f -- "$word"))
    compopt -o filenames 2>/dev/null
  else
    next=${{next// /$'\n'}}
    COMPREPLY=($(compgen -W "$next" -- "$word"))
  fi
}}
complete -F _twinarm twinarm
)";

}  // namespace

std::string shell_completion(CLI::App& program) {
  std::string paths, cases;
  for (const ToldCommand& command : command_tree(program)) {
    const CompletedWords words = completed_words(command);
    const std::string path = command.name.empty() ? "" : " " + command.name;
    if (!path.empty()) paths += fmt::format("{}\"{}\"", paths.empty() ? "" : "|", path);
    cases += fmt::format("    \"{}\") next=\"{}\" files=\"{}\" values=\"{}\" word_is_file={} ;;\n",
                         path, words.next, words.files, words.values, words.is_file ? "yes" : "");
  }
  return fmt::format(kFunction, paths, cases);
}

}  // namespace twinarm
