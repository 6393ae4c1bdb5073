"""Accuracy and budget of the contact solver: what a scene asks for is kept, or reported."""
import re

from program import SCENES, ProgramTest, main

SCENE = """step = 0.002
[[body]]
name = "floor"
fixed = true
shape = { halfspace = { normal = [0, 0, 1], offset = 0 } }
[[body]]
name = "box"
shape = { box = { size = [0.1, 0.1, 0.1] } }
position = [0, 0, 0.06]
copies = { count = [3, 3, 3], spacing = [0.105, 0.105, 0.12], scatter = 0.002 }
mass = 1
"""


class ContactEffort(ProgramTest):
    def residual(self, head):
        """Largest residual that the run reports [m/s]; None without a warning."""
        answer = self.json_of("simulate", self.write("scene.toml", head + SCENE), "--duration", 0.4)
        texts = [re.search(r"by ([0-9.e-]+) m/s at most", text) for text in answer["warnings"]]
        return max((float(found[1]) for found in texts if found), default=None)

    def test_an_accuracy_is_kept_without_a_warning_and_a_coarse_one_moves_otherwise(self):
        for head in ("", "accuracy = 1e-4\n", "accuracy = 1e-6\n"):
            self.assertIsNone(self.residual(head), head)
        exact, coarse = (self.json_of("simulate", self.write("scene.toml", head + SCENE), "--duration", 0.2)["samples"]
                         for head in ("", "accuracy = 1e-3\n"))
        self.assertNotEqual(exact[-1]["links"], coarse[-1]["links"])

    def test_a_budget_that_ends_early_is_reported_and_a_larger_one_leaves_less(self):
        small, larger = self.residual("budget = 2e6\n"), self.residual("budget = 2e8\n")
        self.assertGreater(small, 1e-3)
        self.assertLess(larger or 0, 0.1 * small)

    def test_values_that_are_no_effort_are_errors_with_their_line(self):
        for head in ("accuracy = 0\n", "accuracy = -1e-4\n", "budget = -1\n", "budget = nan\n"):
            result = self.twinarm("simulate", self.write("scene.toml", head + SCENE), code=2)
            self.assertIn("scene.toml:1: ", result.stderr)
            self.assertIn(head.split()[0], result.stderr)

    def test_a_budget_is_part_of_what_a_recording_repeats(self):
        file = self.folder / "heap.twinrec"
        self.twinarm("simulate", SCENES / "heap.toml", "--duration", 0.3, "--set", "budget=3e7", "--record", file)
        self.twinarm("replay", file, "--from", 0.1)


if __name__ == "__main__":
    main()
