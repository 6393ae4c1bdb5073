"""The program's own manual (`twinarm help --man`) as Markdown: what docs/reference/commands.md holds on the site."""
import html
import re


def plain(line):
    """Without roff's signs; what was bold or slanted stays as words."""
    return re.sub(r"\\f[BIRP]", "", line).replace("\\-", "-").replace("\\&", "").replace("\\e", "\\").replace("\\(aq", "'")


def written(line):
    """As words of a page: none of Markdown's signs means anything."""
    return re.sub(r"([\\`*_{}\[\]#|$~^])", r"\\\1", html.escape(plain(line), quote=False))


def markdown_of(manual):
    """Its commands; what stands before and after them is said on other pages."""
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
