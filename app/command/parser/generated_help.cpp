// The manual as man(7) has it: a section for the program, one for each command.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/command/parser/command_tree.h"

namespace twinarm {
namespace {

// Text as roff takes it: its own letters escaped, no line that begins with a request.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool starts_line = out.empty() || out.back() == '\n';
    if (starts_line && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";  // a minus that can be copied, not a hyphen
    } else if (c == '`') {
      out += "\\(ga";
    } else {
      out += c;
    }
  }
  return out;
}

std::string bold(const std::string& text) {
  return "\\fB" + roff(text) + "\\fR";
}
std::string italic(const std::string& text) {
  return "\\fI" + roff(text) + "\\fR";
}

std::string of_option(const OptionInfo& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += (names.empty() ? "" : ", ") + (option.is_word ? italic(name) : bold(name));
  if (!option.value.empty() && !option.is_word) names += " " + italic(option.value);
  std::string help = roff(option.help);
  if (!option.preset.empty()) help += fmt::format(" (if not given: {})", roff(option.preset));
  return fmt::format(".TP\n{}\n{}\n", names, help.empty() ? "\\&" : help);
}

std::string of_paragraph(const std::string& text) {
  const std::string_view example = "Example:";
  if (!text.starts_with(example)) return ".PP\n" + roff(text) + "\n";
  const std::size_t from = text.find_first_not_of(' ', example.size());
  return ".PP\nExample:\n.PP\n.nf\n.RS\n" + roff(text.substr(std::min(from, text.size()))) +
         "\n.RE\n.fi\n";
}

std::string usage(const CommandInfo& command) {
  std::string line = bold("twinarm " + command.name);
  for (const OptionInfo& option : command.options) {
    if (!option.is_word) continue;
    line += option.is_required ? " " + italic(option.names.front())
                               : " [" + italic(option.names.front()) + "]";
  }
  if (!command.followers.empty()) line += " " + italic("COMMAND");
  return line + " [" + italic("options") + "]\n";
}

std::string of_command(const CommandInfo& command) {
  std::string out = fmt::format(".SS {}\n{}", roff(command.name), usage(command));
  out += ".PP\n" + roff(command.summary) + "\n";
  for (const std::string& detail : command.details) out += of_paragraph(detail);
  for (const OptionInfo& option : command.options)
    if (option.names.back() != "--help") out += of_option(option);
  return out;
}

constexpr const char* kEnd = R"(.SH EXIT STATUS
.TP
0
done
.TP
1
a checked result fell short
.TP
2
bad input; all faults are told, each with its remedy
.TP
3
the run stopped by itself: a number that is not finite, or too much energy
.TP
4
an internal fault
.TP
130
Ctrl\-C
.SH ENVIRONMENT
.TP
.B TWINARM_ISA
.BR generic ", " v3 " or " v4 :
the highest level of the instruction set that is used, the processor's own if not given.
Results of two levels differ by rounding.
.SH FILES
Robots, scenes and states that the examples name lie in
.IR share/twinarm
beside the folder of the program; the documentation in
.IR share/doc/twinarm .
A path that begins with
.I assets/
and is not there means the former.
)";

}  // namespace

std::string man_page(CLI::App& program, const std::string& version) {
  const std::vector<CommandInfo> tree = command_tree(program);
  const std::string& title = tree.front().summary;  // "twinarm: what it is"
  const std::string what = title.substr(std::min(title.find(": ") + 2, title.size()));
  std::string out = fmt::format(
      ".\\\" Made by `twinarm help --man`.\n.TH TWINARM 1 \"\" \"twinarm {}\"\n"
      ".SH NAME\ntwinarm \\- {}\n.SH SYNOPSIS\n{} {} [{}]\n.SH DESCRIPTION\n"
      "Each command tells its options and an example:\n{} {} {}.\n"
      "Units are SI and radians unless a name says otherwise.\n",
      version, roff(what), bold("twinarm"), italic("COMMAND"), italic("options"), bold("twinarm"),
      italic("COMMAND"), bold("--help"));
  for (const std::string& detail : tree.front().details) out += of_paragraph(detail);
  for (const OptionInfo& option : tree.front().options) out += of_option(option);
  out += ".SH COMMANDS\n";
  for (std::size_t i = 1; i < tree.size(); ++i) out += of_command(tree[i]);
  return out + kEnd;
}

// Completion for a shell: which words may stand where, as one function of bash. Options whose value
// is a file complete files; those with another value complete nothing.
namespace {

struct CompletedWords {
  std::string next, files, values;  // what may come, options before a file, and before a value
  bool is_file = false;             // a word without dashes is one
};

CompletedWords completed_words(const CommandInfo& command) {
  CompletedWords words;
  const auto add = [](std::string& list, const std::string& word) {
    list += (list.empty() ? "" : " ") + word;
  };
  for (const std::string& follower : command.followers) add(words.next, follower);
  for (const OptionInfo& option : command.options) {
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
  for (const CommandInfo& command : command_tree(program)) {
    const CompletedWords words = completed_words(command);
    const std::string path = command.name.empty() ? "" : " " + command.name;
    if (!path.empty()) paths += fmt::format("{}\"{}\"", paths.empty() ? "" : "|", path);
    cases += fmt::format("    \"{}\") next=\"{}\" files=\"{}\" values=\"{}\" word_is_file={} ;;\n",
                         path, words.next, words.files, words.values, words.is_file ? "yes" : "");
  }
  return fmt::format(kFunction, paths, cases);
}

}  // namespace twinarm
