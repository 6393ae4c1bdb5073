// The man page: a section for the program and one for each command.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/command/parser/command_tree.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

// Escapes roff's special characters, and requests at the start of a line.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool starts_line = out.empty() || out.back() == '\n';
    if (starts_line && (c == '.' || c == '\'')) out += "\\&";
    out += c == '\\'  ? "\\e"
           : c == '-' ? "\\-"  // minus, not hyphen: can be copied
           : c == '`' ? "\\(ga"
                      : std::string(1, c);
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
    names += (names.empty() ? "" : ", ") + (option.is_positional ? italic(name) : bold(name));
  if (!option.value.empty() && !option.is_positional) names += " " + italic(option.value);
  std::string help = roff(option.help);
  if (!option.preset.empty()) help += fmt::format(" (default: {})", roff(option.preset));
  return fmt::format(".TP\n{}\n{}\n", names, help.empty() ? "\\&" : help);
}

std::string of_paragraph(const std::string& text) {
  const std::string examples = "Examples:\n";
  if (!text.starts_with(examples)) return ".PP\n" + roff(text) + "\n";
  return ".PP\nExamples:\n.PP\n.nf\n.RS\n" + roff(text.substr(examples.size())) + "\n.RE\n.fi\n";
}

std::string usage(const CommandInfo& command) {
  std::string line = bold("twinarm " + command.name);
  for (const OptionInfo& option : command.options) {
    if (!option.is_positional) continue;
    line += option.is_required ? " " + italic(option.names.front())
                               : " [" + italic(option.names.front()) + "]";
  }
  if (!command.subcommands.empty()) line += " " + italic("COMMAND");
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
a check failed
.TP
2
bad input; all errors are printed, each with a remedy
.TP
3
the simulation diverged: a number that is not finite, or too much energy
.TP
4
an internal error
.TP
130
Ctrl\-C
.SH ENVIRONMENT
.TP
.B TWINARM_ISA
.BR generic ", " v3 " or " v4 :
highest instruction set level to use; default: the processor's.
Results of two levels differ by rounding.
.SH FILES
Robots, scenes and states of the examples are in
.IR share/twinarm
beside the program's folder, the documentation in
.IR share/doc/twinarm .
A path that begins with
.I assets/
and does not exist is looked up in the former.
)";

// Completion as one function of bash or zsh, and as lines of fish. Options with a file as value
// complete files; those with another value complete nothing.

struct CompletedWords {
  std::string next, files, values;  // subcommands and options; options that take a file; a value
  bool is_file = false;             // a positional argument is a file
};

CompletedWords completed_words(const CommandInfo& command) {
  CompletedWords words;
  const auto add = [](std::string& list, const std::string& word) {
    list += (list.empty() ? "" : " ") + word;
  };
  for (const std::string& name : command.subcommands) add(words.next, name);
  for (const OptionInfo& option : command.options) {
    if (option.is_positional) {
      words.is_file = words.is_file || option.is_file;
      continue;
    }
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

// Names of commands and options have no blanks or quotes.
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

constexpr const char* kZshFunction = R"(#compdef twinarm
# Made by `twinarm help --completion zsh`.
local place="" next="" files="" values="" word_is_file="" word
for word in ${{words[2,CURRENT-1]}}; do
  case "$place $word" in
    {0}) place="$place $word" ;;
  esac
done
case "$place" in
{1}esac
local before=" ${{words[CURRENT-1]}} "
if [[ " $values " == *$before* ]]; then
  return 1
elif [[ " $files " == *$before* || ( -n $word_is_file && ${{words[CURRENT]}} != -* ) ]]; then
  _files
else
  compadd -- ${{=next}}
fi
)";

constexpr const char* kFishFunction = R"(# Made by `twinarm help --completion fish`.
function __twinarm_at --description 'whether the words typed name this command'
    set -l path
    for word in (commandline -opc)[2..-1]
        contains -- "$path $word"{0}; and set path "$path $word"
    end
    test "$path" = "$argv"
end
complete -c twinarm -f
)";

std::string in_fish_quotes(const std::string& text) {
  return "'" + replace_all(replace_all(text, "\\", "\\\\"), "'", "\\'") + "'";
}

std::string fish_completion(const std::vector<CommandInfo>& tree) {
  std::string paths, lines;
  for (const CommandInfo& command : tree) {
    const std::string path = command.name.empty() ? "" : " " + command.name;
    if (!path.empty()) paths += " \"" + path + "\"";
    const std::string start = fmt::format("complete -c twinarm -n '__twinarm_at \"{}\"'", path);
    for (const CommandInfo& below : tree)
      if (std::ranges::any_of(command.subcommands, [&](const std::string& name) {
            return below.name == (path.empty() ? name : command.name + " " + name);
          }))
        lines += fmt::format("{} -a {} -d {}\n", start, below.name.substr(path.size()),
                             in_fish_quotes(below.summary));
    for (const OptionInfo& option : command.options) {
      if (option.is_positional)
        lines += option.is_file ? start + " -F\n" : "";
      else
        lines += fmt::format("{} -l {}{} -d {}\n", start, option.names.back().substr(2),
                             option.is_file         ? " -r -F"
                             : option.value.empty() ? ""
                                                    : " -x",
                             in_fish_quotes(option.help));
    }
  }
  return fmt::format(kFishFunction, paths) + lines;
}

}  // namespace

std::string man_page(CLI::App& program, const std::string& version) {
  const std::vector<CommandInfo> tree = command_tree(program);
  const std::string& title = tree.front().summary;  // "twinarm: what it is"
  const std::string what = title.substr(std::min(title.find(": ") + 2, title.size()));
  std::string out = fmt::format(
      ".\\\" Made by `twinarm help --man`.\n.TH TWINARM 1 \"\" \"twinarm {}\"\n"
      ".SH NAME\ntwinarm \\- {}\n.SH SYNOPSIS\n{} {} [{}]\n.SH DESCRIPTION\n"
      "Options and examples of a command:\n{} {} {}.\n"
      "Units are SI and radians unless a name says otherwise.\n",
      version, roff(what), bold("twinarm"), italic("COMMAND"), italic("options"), bold("twinarm"),
      italic("COMMAND"), bold("--help"));
  for (const std::string& detail : tree.front().details) out += of_paragraph(detail);
  for (const OptionInfo& option : tree.front().options) out += of_option(option);
  out += ".SH COMMANDS\n";
  for (std::size_t i = 1; i < tree.size(); ++i) out += of_command(tree[i]);
  return out + kEnd;
}

std::string shell_completion(CLI::App& program, const std::string& shell) {
  if (shell == "fish") return fish_completion(command_tree(program));
  std::string paths, cases;
  for (const CommandInfo& command : command_tree(program)) {
    const CompletedWords words = completed_words(command);
    const std::string path = command.name.empty() ? "" : " " + command.name;
    if (!path.empty()) paths += fmt::format("{}\"{}\"", paths.empty() ? "" : "|", path);
    cases += fmt::format("    \"{}\") next=\"{}\" files=\"{}\" values=\"{}\" word_is_file={} ;;\n",
                         path, words.next, words.files, words.values, words.is_file ? "yes" : "");
  }
  return fmt::format(fmt::runtime(shell == "zsh" ? kZshFunction : kFunction), paths, cases);
}

}  // namespace twinarm
