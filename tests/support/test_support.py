"""The tests' own tools: a test that could not run is never reported as passed.

    test_support.py BUILD_FOLDER
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from list_skipped import skipped_tests
from waiting import TIMEOUT, wait_for

HERE = pathlib.Path(__file__).resolve().parent
BUILD = ""
FILE = """
import unittest
class T(unittest.TestCase):
    def test_good(self):
        pass
%s
if __name__ == "__main__":
    unittest.main()
"""
SKIPPED = "    def test_a(self):\n        self.skipTest('no ffmpeg: scripts/setup --film')\n"
SKIPPED_PART = ("    def test_b(self):\n        for n in range(2):\n            with self.subTest(n):\n"
                "                if n: self.skipTest('no Chromium: scripts/setup --lab')\n")
FAILED = "    def test_c(self):\n        self.fail()\n"
REPORT = """<testsuite>
<testcase name="good" status="run"><system-out>skipped: is no reason here</system-out></testcase>
<testcase name="part" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/>
<system-out>OK
skipped: no ffmpeg: scripts/setup --film (T.test_a)
</system-out></testcase>
<testcase name="silent" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/><system-out/></testcase>
</testsuite>"""


class Runner(unittest.TestCase):
    def run_file(self, text):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "test_it.py"
            file.write_text(text)
            done = subprocess.run([sys.executable, "-B", HERE / "run_test.py", file], capture_output=True, text=True,
                                  timeout=TIMEOUT)
            return done.returncode, [line for line in done.stdout.splitlines() if line.startswith("skipped: ")]

    def test_a_file_whose_tests_all_pass_exits_with_0(self):
        self.assertEqual(self.run_file(FILE % ""), (0, []))

    def test_a_skipped_method_or_subtest_is_printed_with_its_reason_and_exits_with_77(self):
        code, lines = self.run_file(FILE % (SKIPPED + SKIPPED_PART))
        self.assertEqual(code, 77)
        self.assertEqual(lines, ["skipped: no ffmpeg: scripts/setup --film (T.test_a)",
                                 "skipped: no Chromium: scripts/setup --lab (T.test_b [1])"])

    def test_a_module_that_skips_itself_exits_with_77(self):
        code, lines = self.run_file("import unittest\ndef setUpModule():\n    raise unittest.SkipTest('no pages')\n"
                                    + FILE % "")
        self.assertEqual((code, len(lines)), (77, 1))

    def test_a_failure_beside_a_skip_is_a_failure(self):
        self.assertEqual(self.run_file(FILE % (SKIPPED + FAILED))[0], 1)

    def test_a_file_without_a_test_fails(self):
        self.assertEqual(self.run_file("import unittest\nunittest.main()\n")[0], 1)
        self.assertEqual(self.run_file("print('skipped')\n")[0], 1)


class Report(unittest.TestCase):
    def test_skipped_tests_are_listed_with_their_reasons(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "tests.xml"
            file.write_text(REPORT)
            self.assertEqual(skipped_tests(file), [("part", "no ffmpeg: scripts/setup --film (T.test_a)"),
                                                   ("silent", "no reason given")])
            done = subprocess.run([sys.executable, "-B", HERE / "list_skipped.py", file], capture_output=True,
                                  text=True, timeout=TIMEOUT)
        self.assertEqual(done.returncode, 77)
        self.assertIn("scripts/setup --film installs", done.stdout)


class Registered(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        reported = subprocess.run(["ctest", "--test-dir", BUILD, "--show-only=json-v1"], capture_output=True, text=True,
                                  check=True, timeout=TIMEOUT).stdout
        cls.tests = {test["name"]: {p["name"]: p["value"] for p in test["properties"]}
                     for test in json.loads(reported)["tests"]}

    def test_every_test_can_be_skipped_and_none_is_then_counted_as_passed(self):
        self.assertGreater(len(self.tests), 50)
        self.assertEqual([name for name, of in self.tests.items() if of.get("SKIP_RETURN_CODE") != 77], [])

    def test_tests_of_the_clock_run_alone(self):
        clock = {name for name, of in self.tests.items() if "wallclock" in of.get("LABELS", [])}
        self.assertEqual(clock, {name for name, of in self.tests.items() if of.get("RUN_SERIAL")})
        self.assertTrue({"hand_clock", "hand_command"} <= clock)


class Waiting(unittest.TestCase):
    def test_a_condition_is_waited_for(self):
        values = iter([0, 0, 7])
        self.assertEqual(wait_for(lambda: next(values), "seven"), 7)


if __name__ == "__main__":
    BUILD = sys.argv.pop(1)
    unittest.main()
