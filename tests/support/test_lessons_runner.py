"""The runner of the lessons says what is wrong with a lesson: a number, a command, a picture, its form."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from waiting import TIMEOUT

ROOT = pathlib.Path(__file__).resolve().parents[2]
GOOD = (ROOT / "tests/data/lesson.md").read_text()


class Runner(unittest.TestCase):
    def run_lesson(self, text, answers="[0](00_sum/lesson.md)", words=(), picture=None, checks=None):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place) / "00_sum"
            folder.mkdir()
            (folder / "lesson.md").write_text(text)
            (folder.parent / "instructor.md").write_text(answers)
            if checks:
                (folder / "checks.txt").write_text(checks)
            if picture:
                (folder / "sum.svg").write_text(picture)
            done = subprocess.run([ROOT / "scripts/check/lessons", "--program", "/bin/true", "--folder", place, *words],
                                  capture_output=True, text=True, timeout=TIMEOUT)
            self.left = sorted(file.name for file in folder.iterdir())
            return done

    def assert_fails(self, text, sentence, **words):
        done = self.run_lesson(text, **words)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertEqual(done.stdout.splitlines()[-1], "0 passed, 1 failed")
        self.assertIn(sentence, done.stdout)

    def test_a_lesson_that_is_right_passes_and_leaves_its_folder_as_it_was(self):
        done = self.run_lesson(GOOD)
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1]), (0, "1 passed, 0 failed"), done.stdout)
        self.assertEqual(self.left, ["lesson.md"])

    def test_checks_may_be_in_a_file_beside_the_text(self):
        text, checks = re.sub(r"<!-- check\n.*?^-->\n", "", GOOD, flags=re.M | re.S), "run.sum = 41.5 +- 0.01\n"
        done = self.run_lesson(text, checks=checks)
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1]), (0, "1 passed, 0 failed"), done.stdout)
        self.assert_fails(text.replace('"sum": 41.5', '"sum": 41.52'), "checks.txt:1: run.sum is 41.52", checks=checks)

    def test_its_picture_is_put_beside_it_when_asked_for(self):
        self.run_lesson(GOOD, words=["--pictures"])
        self.assertEqual(self.left, ["lesson.md", "sum.svg"])

    def test_each_fault_of_a_lesson_is_told(self):
        not_said = "41.5 is checked, but the lesson's text does not say it"
        for old, new, message in (
                ('"sum": 41.5', '"sum": 41.52', "lesson.md:23: run.sum is 41.52"),
                ('"sum": 41.5', '"sum": null', "'run.sum' has no value"),
                ("x > 1.5", "x > 2.5", 'named(run.list, name="b").x is 2'),
                ("It is 41.5.", "It is 41.", not_said), ("It is 41.5.", "It is 41.55.", not_said),
                ("It is 41.5.", "It is 141.5.", not_said), ("mkdir -p out", "echo no room; false", "no room"),
                ("head -c 600", "head -c 6", "its commands make no out/sum.svg"),
                ("## The law\n", "## The law\n\n```sh\ntrue\n```\n", "a command stands before the prediction"),
                ("## The trap\n", "", "its headings are"), (" +- 0.01", "", "is no check")):
            with self.subTest(message, new=new):
                self.assert_fails(GOOD.replace(old, new), message)

    def test_a_picture_that_is_no_longer_what_the_commands_make_is_a_fault(self):
        drawing = "<svg><path d='M0.00,0.00 L10.00,{0}.00 L40.00,10.00'/><text>{1}</text></svg>" + 60 * "<!-- -->"
        lesson = GOOD.replace("head -c 600 /dev/zero", f'echo "{drawing.format(10, "t [s]")}"')
        for height, text, message in ((10, "t [s]", None), (12, "t [s]", None), (30, "t [s]", "path 0 is elsewhere at"),
                                      (10, "t [ms]", "text 't [ms]' is now 't [s]'")):
            with self.subTest(height=height, text=text):
                picture = drawing.format(height, text)
                if message:
                    self.assert_fails(lesson, message, picture=picture)
                else:
                    self.assertEqual(self.run_lesson(lesson, picture=picture).returncode, 0)

    def test_the_instructor_must_have_its_answers(self):
        self.assert_fails(GOOD, "instructor.md has no answers to it", answers="none yet")

    def test_a_name_that_no_lesson_has_is_refused_with_those_that_there_are(self):
        done = self.run_lesson(GOOD, words=["nothing"])
        self.assertEqual(done.returncode, 2)
        self.assertIn("00_sum", done.stderr)


class Lessons(unittest.TestCase):
    def test_the_list_names_every_lesson(self):
        listed = (ROOT / "docs/learn/lessons/README.md").read_text()
        lessons = sorted((ROOT / "docs/learn/lessons").glob("*/lesson.md"))
        self.assertGreaterEqual(len(lessons), 10)
        for lesson in lessons:
            self.assertIn(f"({lesson.parent.name}/lesson.md)", listed)


if __name__ == "__main__":
    sys.exit(unittest.main())
