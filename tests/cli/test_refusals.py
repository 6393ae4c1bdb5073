"""Command lines that are refused: exit code 2, all faults at once, on stderr and in JSON; nothing is made.

The rows are in tests/data/refusals.toml.
"""
import json
import pathlib
import shlex
import tempfile
import tomllib

from program import DATA, ProgramTest, data, line_of, main

NO_JSON = ("twinarm", "trace", "make-robot")  # commands without --json
ROWS = [(command, row) for command, rows in tomllib.loads(data("refusals.toml")).items() for row in rows]


def is_told(faults, wanted):
    """Whether each of the wanted faults is reported, and no other."""
    tells = [[all(part in fault for part in parts) for parts in wanted] for fault in faults]
    return len(faults) == len(wanted) and all(map(any, tells)) and all(map(any, zip(*tells)))


class Refusals(ProgramTest):
    cwd = DATA

    def test_each_is_reported_with_all_its_faults_and_nothing_is_made(self):
        for command, row in ROWS:
            with self.subTest(row["words"], state=row.get("state")), tempfile.TemporaryDirectory() as folder:
                self.folder = pathlib.Path(folder)
                self.check(command, row)

    def check(self, command, row):
        words = shlex.split(row["words"].replace("{out}", str(self.folder)))
        if "state" in row:
            words += ["--state", self.write("state.json", row["state"])]
        wanted = [[part.replace("{out}", str(self.folder)) for part in parts] for parts in row["faults"]]
        done = self.twinarm(*words, *([] if command in NO_JSON else ["--json"]), code=2)
        reported = [line for line in done.stderr.splitlines() if line.startswith("twinarm: ") and "warning" not in line]
        if command not in NO_JSON:
            faults = json.loads(done.stdout)["errors"]
            self.assertEqual(len(reported), len(faults), done.stderr)
            reported = [f'{fault["code"]} {line_of(fault)}' for fault in faults]
        self.assertTrue(is_told(reported, wanted), reported)
        self.assertLessEqual({path.name for path in self.folder.iterdir()}, {"state.json"})


if __name__ == "__main__":
    main()
