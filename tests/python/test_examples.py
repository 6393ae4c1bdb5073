#!/usr/bin/env python3
"""The examples of app/python/examples and of docs/python.md run, and print what they promise."""
import os
import re
import subprocess
import sys
import tempfile
import unittest

from notebook import PRELOADED, ROOT, main, twinarm

ENVIRONMENT = {**os.environ, **PRELOADED, "PYTHONPATH": os.path.dirname(twinarm.__file__)}


def printed(*command):
    done = subprocess.run([sys.executable, "-B", *map(str, command)], capture_output=True, text=True,
                          cwd=ROOT, env=ENVIRONMENT, timeout=600)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return done.stdout


class Examples(unittest.TestCase):
    def test_all_scripts_run_and_say_that_what_they_claim_holds(self):
        scripts = sorted((ROOT / "app" / "python" / "examples").glob("*.py"))
        self.assertEqual(len(scripts), 3)
        for script in scripts:
            with self.subTest(script=script.name):
                self.assertRegex(printed(script).splitlines()[-1], "^holds: ")

    def test_the_page_prints_what_it_shows(self):
        text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
        blocks = re.findall(r"```python\n(.*?)```(?:\n+prints\n+```\n(.*?)```)?", text, re.DOTALL)
        self.assertGreater(len(blocks), 0)
        shown = [(code, output) for code, output in blocks if output]
        self.assertGreater(len(shown), 0)
        for code, output in shown:
            with tempfile.NamedTemporaryFile("w", suffix=".py") as script:
                script.write(code)
                script.flush()
                self.assertEqual(printed(script.name).split(), output.split())


if __name__ == "__main__":
    main()
