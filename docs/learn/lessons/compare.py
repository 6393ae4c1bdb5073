#!/usr/bin/env python3
"""Prints every number that a lesson compares, with the formula and the files in out/ from which it is computed.

    python3 ../compare.py        in the folder of a lesson, after its commands

The formulas are those of checks.txt beside the lesson, and of comments <!-- check --> in it; scripts/check/lessons
checks them.
"""
import csv
import json
import math
import pathlib
import re
import sys

STEP = re.compile(r"^```sh\n(?P<commands>.*?)^```$|^<!-- check\n(?P<checks>.*?)^-->$", re.M | re.S)


class Fault(Exception):
    """What is wrong with a lesson, where."""


class Numbers:
    """A JSON value whose members are attributes and items: run.samples[-1].q.hinge."""

    def __init__(self, value):
        self._value = value

    def __getattr__(self, name):
        return self[name]

    def __getitem__(self, key):
        found = self._value[key]
        return Numbers(found) if isinstance(found, (dict, list)) else found

    def __len__(self):
        return len(self._value)

    def __iter__(self):
        return iter([self[k] for k in range(len(self))] if isinstance(self._value, list) else self._value)


class Results(dict):
    """What checks can name: each out/NAME.json by its name, column("NAME.csv", "t[s]"), mathematics."""

    def __init__(self, folder):
        super().__init__({name: getattr(math, name)
                          for name in ("sqrt", "pi", "sin", "cos", "asin", "atan2", "log", "exp")})
        self.folder = folder
        self.update(column=self.column, degrees=math.degrees, norm=lambda v: math.hypot(*v), named=self.named,
                    crossings=self.crossings)

    def __missing__(self, name):
        file = self.folder / f"{name}.json"
        if not file.is_file():
            raise KeyError(name)  # a builtin, or a mistake
        return Numbers(json.loads(file.read_text()))

    def column(self, file, name):
        with open(self.folder / file, newline="") as rows:
            return [float(row[name]) for row in csv.DictReader(rows)]

    @staticmethod
    def named(items, **wanted):
        """The item of a list whose members have these values: named(run.checks, name="loops")."""
        return next(item for item in items if all(item[key] == value for key, value in wanted.items()))

    @staticmethod
    def crossings(times, values):
        """The times at which a curve passes zero, straight between its points."""
        points = list(zip(times, values))
        return [t - x * (u - t) / (y - x) for (t, x), (u, y) in zip(points, points[1:]) if x * y < 0]


def parts_of(line):
    """Of `EXPRESSION = NUMBER +- TOLERANCE`, `EXPRESSION < NUMBER` or `EXPRESSION > NUMBER`."""
    parts = re.fullmatch(r"(.*?)\s+(=|<|>)\s+(\S+)(?:\s+\+-\s+(\S+))?", line)
    if not parts or (parts[2] == "=") != (parts[4] is not None):
        raise Fault(f"'{line}' is no check; write EXPRESSION = NUMBER +- TOLERANCE, or EXPRESSION < NUMBER")
    return parts.groups()


def steps_of(folder):
    """Of a lesson: file and first line, commands, checks; in the order in which they are run."""
    text = (folder / "lesson.md").read_text(encoding="utf-8")
    steps = [(("lesson.md", text[:m.start()].count("\n") + 2), m["commands"], m["checks"] or "")
             for m in STEP.finditer(text)]
    checks = folder / "checks.txt"
    return steps + ([(("checks.txt", 1), None, checks.read_text(encoding="utf-8"))] if checks.is_file() else [])


def main():
    folder = pathlib.Path.cwd()
    if not (folder / "lesson.md").is_file():
        sys.exit("compare.py: there is no lesson.md here; run it in the folder of a lesson")
    results = Results(folder / "out")
    for _, _, checks in steps_of(folder):
        for line in filter(str.strip, checks.splitlines()):
            expression, sign, number, _ = parts_of(line.strip())
            try:
                found = f"{float(eval(expression, results)):.7g}"  # of this repository's own lessons
            except (OSError, KeyError, NameError) as error:
                found = f"not there yet ({error})"
            print(f"{found:>12}   {'the lesson says ' if sign == '=' else sign + ' '}{number}\n    {expression}")


if __name__ == "__main__":
    main()
