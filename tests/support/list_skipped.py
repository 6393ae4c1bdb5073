"""Lists the tests that ctest skipped, why, and which packages they need.

    list_skipped.py REPORT.xml      of ctest --output-junit

Exit codes: 0 none was skipped; 77 some were.
"""
import re
import sys
import xml.etree.ElementTree

SKIPPED = 77


def skipped_tests(report):
    """[(test, reason)]"""
    found = []
    for case in xml.etree.ElementTree.parse(report).iter("testcase"):
        if case.find("skipped") is not None:
            lines = (case.findtext("system-out") or "").splitlines()
            reasons = [line.partition("skipped: ")[2] for line in lines if line.startswith("skipped: ")]
            found += [(case.get("name"), reason) for reason in reasons or ["no reason given"]]
    return found


def main():
    skipped = skipped_tests(sys.argv[1])
    if not skipped:
        return 0
    print(f"\nSkipped tests: {len({test for test, _ in skipped})}")
    for test, reason in skipped:
        print(f"  {test}: {reason}")
    groups = sorted({group for _, reason in skipped for group in re.findall(r"scripts/setup (--[a-z]+)", reason)})
    if groups:
        print(f"scripts/setup {' '.join(groups)} installs what is missing (--test: what all tests need)")
    return SKIPPED


if __name__ == "__main__":
    sys.exit(main())
