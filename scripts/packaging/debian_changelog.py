#!/usr/bin/env python3
"""docs/develop/changelog.md as Debian has it: debian_changelog.py CHANGELOG.md OUT.

A version is a heading `## 0.1.0, 22 November 2026`, and its changes a list below it.
"""
import datetime
import pathlib
import re
import sys
import textwrap

HEADING = re.compile(r"## (\d+\.\d+\.\d+), (\d+ \w+ \d{4})\n(.*?)(?=^## |\Z)", re.M | re.S)
MAINTAINER = "The twinarm authors <twinarm@packages.invalid>"


def entries(text):
    for version, day, body in HEADING.findall(text):
        date = datetime.datetime.strptime(day, "%d %B %Y").strftime("%a, %d %b %Y 12:00:00 +0000")
        changes = [" ".join(item.split()) for item in re.findall(r"^- (.*?)(?=^- |\Z)", body, re.M | re.S)]
        lines = [textwrap.fill(change, 78, initial_indent="  * ", subsequent_indent="    ")
                 for change in changes]
        yield "\n".join([f"twinarm ({version}) stable; urgency=medium", "", *lines, "",
                         f" -- {MAINTAINER}  {date}"])


def main():
    source, out = map(pathlib.Path, sys.argv[1:])
    found = list(entries(source.read_text(encoding="utf-8")))
    if not found:
        sys.exit(f"{source}: no heading like '## 0.1.0, 22 November 2026' is in it")
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text("\n\n".join(found) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
