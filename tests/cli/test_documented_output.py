"""Numbers that pages show as output of a command are those that the program prints.

A ```sh block followed by ```text blocks is an example: its commands run in an empty folder, with the program on the
path. Each line of the text blocks must have the numbers, in order, of a line of the output; words are not compared.
"""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import program
from program import ROOT, main
from waiting import TIMEOUT

PAGES = sorted([ROOT / "README.md", ROOT / "docs/learn/first_half_hour.md", *(ROOT / "docs/use").glob("*.md"),
                *(ROOT / "docs/understand").glob("*.md"), *(ROOT / "docs/reference").glob("*.md")])
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)
NUMBER = re.compile(r"(?<![\w.^])[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?(?![\w.]*\w)")


def numbers(line):
    return [float(word) for word in NUMBER.findall(line)]


def examples(page):
    """Pairs of commands and the lines that they print."""
    found = []
    for language, text in BLOCK.findall(page.read_text(encoding="utf-8")):
        if language == "sh":
            found.append((text, []))
        elif language == "text" and found:
            found[-1][1].extend(text.splitlines())
    return [(commands, lines) for commands, lines in found if lines]


def has(output, line):
    """Whether a line of the output has these numbers, each to the digits shown here."""
    wanted = numbers(line)
    for printed in output:
        if len(printed) == len(wanted) and all(abs(p - w) <= 1e-5 * abs(w) + 1e-15 for p, w in zip(printed, wanted)):
            return True
    return not wanted


class DocumentedOutput(unittest.TestCase):
    def test_each_number_of_an_example_is_printed(self):
        pages = [(page, example) for page in PAGES for example in examples(page)]
        self.assertGreater(len(pages), 4)
        path = {**os.environ, "PATH": f"{os.path.dirname(program.PROGRAM)}:{os.environ['PATH']}"}
        for page, (commands, lines) in pages:
            with self.subTest(page=page.name, commands=commands), tempfile.TemporaryDirectory() as place:
                (pathlib.Path(place) / "build").symlink_to(ROOT / "build")
                ran = subprocess.run(["bash", "-ec", commands.replace("build/release/twinarm", "twinarm")], cwd=place,
                                     env=path, capture_output=True, text=True, timeout=TIMEOUT)
                self.assertEqual(ran.returncode, 0, ran.stderr[-2000:])
                output = [numbers(line) for line in (ran.stdout + ran.stderr).splitlines()]
                self.assertEqual([line for line in lines if not has(output, line)], [])


if __name__ == "__main__":
    main()
