"""Runs a file of unittest so that skipped tests are visible.

    run_test.py TEST.py [ARGUMENT...]

Prints `skipped: REASON (TEST, ...)` for each reason; scripts/test collects these lines. Exit codes: 0 all tests ran
and passed; 1 a test failed, or the file has none; 77 none failed, but some were skipped (SKIP_RETURN_CODE of ctest).
"""
import pathlib
import runpy
import sys
import unittest

SKIPPED = 77


def report(skipped):
    """One line per reason."""
    tests = {}
    for test, reason in skipped:
        tests.setdefault(reason, []).append(test.id().replace("__main__.", ""))
    for reason, names in tests.items():
        more = f" and {len(names) - 3} more" if len(names) > 3 else ""
        print(f"skipped: {reason} ({', '.join(names[:3])}{more})", flush=True)


class Main(unittest.TestProgram):
    def runTests(self):
        self.exit = False
        super().runTests()
        report(self.result.skipped)
        if not self.result.wasSuccessful():
            sys.exit(1)
        if not self.result.testsRun and not self.result.skipped:
            sys.exit("no test was run")
        sys.exit(SKIPPED if self.result.skipped else 0)


if __name__ == "__main__":
    sys.argv.pop(0)
    here = sys.path[0]  # what tests share
    sys.path[:1] = [str(pathlib.Path(sys.argv[0]).resolve().parent), here]
    unittest.main = Main
    runpy.run_path(sys.argv[0], run_name="__main__")
    sys.exit(f"{sys.argv[0]} did not call unittest.main()")
