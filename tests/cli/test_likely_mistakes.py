"""Mistakes of newcomers, tests/data/likely_mistakes.toml: each is refused, or warned of, with its value and remedy.

A warning is on stderr; in JSON it is under `warnings`.
"""
import json
import pathlib
import shlex
import tempfile
import tomllib

from program import DATA, ProgramTest, data, main

ROWS = tomllib.loads(data("likely_mistakes.toml"))["mistake"]


class LikelyMistakes(ProgramTest):
    cwd = DATA

    def test_there_are_46_different_ones(self):
        self.assertGreaterEqual(len({(row["words"], row.get("scene"), row.get("state")) for row in ROWS}), 46)

    def test_each_message_has_the_value_and_the_remedy(self):
        for row in ROWS:
            with self.subTest(row["words"]), tempfile.TemporaryDirectory() as folder:
                self.folder = pathlib.Path(folder)
                for key, name in (("scene", "scene.toml"), ("state", "state.json")):
                    if key in row:
                        self.write(name, row[key])
                self.check(row, shlex.split(row["words"].replace("{out}", folder)))

    def check(self, row, words):
        warns = row.get("warns", False)
        done = self.twinarm(*words, code=0 if warns else 2)
        line = next((line for line in done.stderr.splitlines() if all(part in line for part in row["says"])), None)
        self.assertIsNotNone(line, done.stderr)
        self.assertEqual(done.stderr.count(line), 1)
        self.assertEqual(warns, "warning: " in line)
        if not warns:
            return
        self.assertNotIn("warning", done.stdout)
        found = self.twinarm(*words, "--json")
        self.assertEqual(found.stderr, "")
        self.assertTrue(any(row["says"][0] in warning for warning in json.loads(found.stdout)["warnings"]))


if __name__ == "__main__":
    main()
