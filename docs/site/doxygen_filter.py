#!/usr/bin/env python3
"""Converts plain // comments of headers into Doxygen comments; the code is unchanged.

    doxygen_filter.py TO_FOLDER SOURCE_FOLDER...

- the first comment of a file describes the file;
- a comment directly above a line of code describes what that line declares;
- a comment after code describes that code, and continues below in the same column;
- lines indented by three or more are a table and keep their layout.
Other comments (isolated, after a closing brace, notes for tools) stay plain.
"""
import pathlib
import re
import sys

ALONE = re.compile(r"( *)//(?: (.*))?$")
FOR_TOOLS = re.compile(r"NOLINT|clang-format|IWYU")
CHARACTERS = {"\\": "\\\\", "@": "\\@", "&": "&amp;", "<": "&lt;", ">": "&gt;", "#": "\\#", "%": "\\%", '"': "&quot;"}


def escaped(text):
    return "".join(CHARACTERS.get(character, character) for character in text)


def comment_of(line):
    """Column at which the comment of a line begins; -1: none. Slashes in string literals do not count."""
    quoted = False
    for at, character in enumerate(line):
        if character == '"' and (at == 0 or line[at - 1] != "\\"):
            quoted = not quoted
        elif not quoted and line.startswith("//", at):
            return at
    return -1


def block(lines, indent, head=False):
    """The lines of a comment as a Doxygen comment."""
    made, in_table = [], False
    for number, words in enumerate(lines):
        is_table = words.startswith("  ") and (in_table or words.strip() != "")
        before = ("</pre>" if in_table and not is_table else "") + ("<pre>" if is_table and not in_table else "")
        in_table = is_table
        mark = "\\file\n" + indent + "/// " if head and number == 0 else ""
        made.append(f"{indent}/// {mark}{before}{escaped(words)}")
    if in_table:
        made[-1] += "</pre>"
    return made


def filtered(text):
    lines, made, at, column = text.split("\n"), [], 0, -1
    while at < len(lines):
        line = lines[at]
        alone = ALONE.match(line)
        if alone and column >= 0 and len(alone[1]) == column:  # continues the comment after the code above
            made.append(f"{alone[1]}///< {escaped(alone[2] or '')}")
            at += 1
            continue
        column = -1
        if alone:
            end = at
            while end < len(lines) and ALONE.match(lines[end]):
                end += 1
            words = [ALONE.match(each)[2] or "" for each in lines[at:end]]
            is_above = end < len(lines) and lines[end].strip() not in ("", "}", "};")
            if at == 0 or is_above and not FOR_TOOLS.search(words[0]):
                made += block(words, alone[1], head=at == 0)
            else:
                made += lines[at:end]
            at = end
            continue
        begin = comment_of(line)
        code = line[:begin].rstrip() if begin > 0 else line
        if begin < 0 or FOR_TOOLS.search(line[begin:]) or code.lstrip().startswith(("}", "#")) or code.endswith(":"):
            made.append(line)
        elif code.endswith("{"):  # describes the block that opens here
            opens_type = re.match(r" *(struct|class|enum|union)\b", code)
            made.append(f"/** {escaped(line[begin + 2:].strip())} */ {code}" if opens_type else line)
        else:
            made.append(f"{line[:begin]}///< {escaped(line[begin + 2:].strip())}")
            column = begin
        at += 1
    return "\n".join(made)


def main():
    to = pathlib.Path(sys.argv[1])
    for folder in sys.argv[2:]:
        for header in sorted(pathlib.Path(folder).rglob("*.h")):
            (to / header).parent.mkdir(parents=True, exist_ok=True)
            (to / header).write_text(filtered(header.read_text()))


if __name__ == "__main__":
    main()
