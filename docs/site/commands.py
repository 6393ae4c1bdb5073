"""Converts the program's manual (`twinarm help --man`) to Markdown for docs/reference/commands.md on the site."""
import html
import re


def plain(line):
    """Text without roff markup."""
    line = re.sub(r"\\f[BIRP]", "", line)
    return line.replace("\\-", "-").replace("\\&", "").replace("\\e", "\\").replace("\\(aq", "'")


def written(line):
    """Text with Markdown characters escaped."""
    return re.sub(r"([\\`*_{}\[\]#|$~^])", r"\\\1", html.escape(plain(line), quote=False))


def markdown_of(manual):
    """The section COMMANDS as Markdown."""
    made = []
    lines = iter(re.search(r"^\.SH COMMANDS\n(.*?)(?=^\.SH|\Z)", manual, re.M | re.S)[1].splitlines())
    for line in lines:
        if line in (".RS", ".RE"):
            continue
        if line.startswith(".SS"):
            made += ["", f"## twinarm {written(line[4:])}", ""]
        elif line == ".nf":
            block = []
            for code in lines:
                if code == ".fi":
                    break
                if code not in (".RS", ".RE"):
                    block.append(plain(code))
            made += ["", "```", *block, "```", ""]
        elif line == ".TP":
            made += ["", f"`{plain(next(lines))}`<br>"]
        elif line == ".PP":
            made.append("")
        elif not line.startswith("."):
            made.append(written(line))
    return "\n".join(made)
