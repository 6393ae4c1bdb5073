#!/usr/bin/env python3
"""The runner of the lessons says what is wrong with a lesson: a number, a command, a picture, its form.

    test_lessons.py
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

from waiting import TIMEOUT  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
GOOD = """# 0. A sum

## The law
## By hand

It is 41.5.

## Predict
## Run

```sh
mkdir -p out
echo '{"sum": 41.5, "list": [{"name": "a", "x": 1}, {"name": "b", "x": 2}]}' > out/run.json
printf 't,x\\n0,-1\\n1,1\\n3,-3\\n' > out/rows.csv
head -c 600 /dev/zero > out/sum.svg
```

## Compare

![A sum](sum.svg)

<!-- check
run.sum = 41.5 +- 0.01
named(run.list, name="b").x > 1.5
max(abs(x) for x in column("rows.csv", "x")) < 3.1
crossings(column("rows.csv", "t"), column("rows.csv", "x"))[1] > 1.49
-->

## The trap
## A question
"""


class Runner(unittest.TestCase):
    def run_lesson(self, text, answers="[0](00_sum/lesson.md)", words=()):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place) / "00_sum"
            folder.mkdir()
            (folder / "lesson.md").write_text(text)
            (folder.parent / "instructor.md").write_text(answers)
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

    def test_its_picture_is_put_beside_it_when_asked_for(self):
        self.run_lesson(GOOD, words=["--pictures"])
        self.assertEqual(self.left, ["lesson.md", "sum.svg"])

    def test_a_number_that_is_off_is_told_with_its_line(self):
        self.assert_fails(GOOD.replace('"sum": 41.5', '"sum": 41.52'), "lesson.md:23: run.sum is 41.52")

    def test_a_number_that_is_not_there_is_no_number(self):
        self.assert_fails(GOOD.replace('"sum": 41.5', '"sum": null'), "'run.sum' has no value")

    def test_a_limit_is_a_limit(self):
        self.assert_fails(GOOD.replace("x > 1.5", "x > 2.5"), 'named(run.list, name="b").x is 2')

    def test_what_is_checked_must_be_what_the_text_says(self):
        for said in ("It is 41.", "It is 41.55.", "It is 141.5."):
            self.assert_fails(GOOD.replace("It is 41.5.", said), "41.5 is checked, but the lesson's text does not say it")

    def test_a_command_that_fails_is_told_with_what_it_said(self):
        self.assert_fails(GOOD.replace("mkdir -p out", "echo no room; false"), "no room")

    def test_a_picture_must_be_made_by_the_commands(self):
        self.assert_fails(GOOD.replace("head -c 600", "head -c 6"), "its commands make no out/sum.svg")

    def test_a_command_may_not_stand_before_the_prediction(self):
        self.assert_fails(GOOD.replace("## The law\n", "## The law\n\n```sh\ntrue\n```\n"),
                          "a command stands before the prediction")

    def test_each_part_must_be_there(self):
        self.assert_fails(GOOD.replace("## The trap\n", ""), "its headings are")

    def test_the_instructor_must_have_its_answers(self):
        self.assert_fails(GOOD, "instructor.md has no answers to it", answers="none yet")

    def test_a_check_that_is_none_is_told(self):
        self.assert_fails(GOOD.replace(" +- 0.01", ""), "is no check")

    def test_a_name_that_no_lesson_has_is_refused_with_those_that_there_are(self):
        done = self.run_lesson(GOOD, words=["nothing"])
        self.assertEqual(done.returncode, 2)
        self.assertIn("00_sum", done.stderr)


class Lessons(unittest.TestCase):
    def test_the_list_names_every_lesson(self):
        listed = (ROOT / "docs/lessons/README.md").read_text()
        lessons = sorted((ROOT / "docs/lessons").glob("*/lesson.md"))
        self.assertGreaterEqual(len(lessons), 10)
        for lesson in lessons:
            self.assertIn(f"({lesson.parent.name}/lesson.md)", listed)


if __name__ == "__main__":
    sys.exit(unittest.main())
