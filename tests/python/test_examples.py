"""The examples of app/python/examples, README.md and docs/use/python.md run and print what they show."""
import importlib.machinery
import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

from notebook import PRELOADED, ROOT, main, twinarm
from waiting import TIMEOUT

ENVIRONMENT = {**os.environ, **PRELOADED, "PYTHONPATH": os.path.dirname(os.path.dirname(twinarm.__file__))}
EXAMPLES = ROOT / "app" / "python" / "examples"


def printed(*command, cwd=ROOT):
    done = subprocess.run([sys.executable, "-B", *map(str, command)], capture_output=True, text=True,
                          cwd=cwd, env=ENVIRONMENT, timeout=TIMEOUT)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return done.stdout


def runner_of_lessons():
    """scripts/check/lessons as a module: it knows how a lesson is written."""
    loader = importlib.machinery.SourceFileLoader("lessons", str(ROOT / "scripts/check/lessons"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("lessons", loader))
    loader.exec_module(module)
    return module


LESSONS = runner_of_lessons()


class Examples(unittest.TestCase):
    def test_each_lesson_has_a_script_that_it_links_to(self):
        lessons = sorted(file.parent for file in (ROOT / "docs" / "learn" / "lessons").glob("*/lesson.md"))
        self.assertGreater(len(lessons), 9)
        scripts = {file.stem for file in EXAMPLES.glob("*.py")} - {"lesson", "control_loop", "lqr"}
        self.assertEqual(scripts, {lesson.name for lesson in lessons})
        for lesson in lessons:
            link = f"(../../../../app/python/examples/{lesson.name}.py)"
            self.assertIn(link, (lesson / "lesson.md").read_text(encoding="utf-8"))

    def test_each_script_finds_the_numbers_that_its_lesson_claims(self):
        with tempfile.TemporaryDirectory() as elsewhere:  # where no assets/ lie
            for script in sorted(EXAMPLES.glob("[0-9]*.py")):
                with self.subTest(script=script.name):
                    self.compare(script, printed(script, cwd=elsewhere))

    def numbers_of(self, script, *kinds):
        """The numbers that say() printed, by the beginning of the line."""
        with tempfile.TemporaryDirectory() as elsewhere:
            output = printed(EXAMPLES / script, cwd=elsewhere)
        found = re.findall(r"^(\S.{40,}) = (\S+)$", output, re.MULTILINE)
        return {kind: [float(value) for what, value in found if what.startswith(kind)] for kind in kinds}

    def test_the_regulators_decay_as_their_linearised_systems_do(self):
        of = self.numbers_of("lqr.py", "Acrobot", "S-103: slowest", "S-103, target")
        growth, decay, found, lean = of["Acrobot"]
        # two uniform rods of 0.5 m upright, angles from the vertical: m l^2 M x'' = m g l K x
        M, K = np.array([[4 / 3, 1 / 2], [1 / 2, 1 / 3]]), np.diag([3 / 2, 1 / 2])
        self.assertAlmostEqual(growth, np.sqrt(np.linalg.eigvals(np.linalg.solve(M, K)).max() * 9.81 / 0.5), places=6)
        self.assertAlmostEqual(found / decay, 1, delta=0.02)
        self.assertGreater(lean, 1)
        alone, regulated = of["S-103: slowest"]
        late, early = of["S-103, target"]
        self.assertAlmostEqual(late * alone, np.log(50), delta=1)  # to 2 %
        self.assertLess(early, late / 5)
        self.assertGreater(regulated, 5 * alone)

    def test_the_control_loops_obey_the_laws_that_they_print(self):
        of = self.numbers_of("control_loop.py", "couplings", "computed torque", "impedance")
        error, predicted, push, unbalanced = of["computed torque"]
        self.assertAlmostEqual(error / predicted, 1, delta=0.1)  # first order in w h
        self.assertLess(unbalanced, 1e-5)
        soft_error, soft_push, unbalanced, by_stiffness, repeated = of["impedance"]
        self.assertLess(unbalanced, 1e-5)
        self.assertAlmostEqual(soft_push / by_stiffness, 1, delta=0.2)  # the box is not touched at the tip
        self.assertEqual(repeated, 0)
        self.assertLess(error, soft_error)
        self.assertLess(soft_push, of["couplings"][1])
        self.assertLess(of["couplings"][1], push)

    def compare(self, script, output):
        """The lesson's checks, one by one, with the numbers that say() printed."""
        lesson = LESSONS.Lesson(ROOT / "docs" / "learn" / "lessons" / script.stem)
        claims = [LESSONS.parts_of(line.strip()) for _, _, checks in lesson.steps
                  for line in (checks or "").splitlines() if line.strip()]
        found = re.findall(r"^(\S.{65,}) = (\S+)$", output, re.MULTILINE)
        self.assertEqual(len(found), len(claims), f"numbers found and claimed:\n{output}")
        for (what, value), (_, *claim) in zip(found, claims):
            self.assertTrue(LESSONS.holds(float(value), *claim), f"{what.strip()}: {value}; the lesson says {claim}")

    def test_the_pages_print_what_they_show(self):
        text = "".join((ROOT / page).read_text(encoding="utf-8") for page in ("README.md", "docs/use/python.md"))
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
