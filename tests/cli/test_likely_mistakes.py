"""What is allowed but likely a mistake: a warning on stderr, in JSON under `warnings`, that names value and remedy."""
import json

from program import ProgramTest, main

HINGE = "tests/data/hinge.urdf"


class LikelyMistakes(ProgramTest):
    def check(self, words, *parts):
        done = self.twinarm(*words)
        for part in parts:
            self.assertIn(part, done.stderr)
        self.assertNotIn("warning", done.stdout)
        found = self.twinarm(*words, "--json")
        self.assertEqual(found.stderr, "")
        self.assertTrue(any(parts[0] in warning for warning in json.loads(found.stdout)["warnings"]))

    def test_degrees_in_a_state_file(self):
        for degrees, turns, radians in ((90, "14.3", "1.5708"), (-45, "7.2", "-0.7854")):
            state = self.write("state.json", f'{{"q": {{"hinge": {degrees}}}}}')
            for command in ("dynamics", "modes", "inspect"):
                self.check([command, HINGE, "--state", state],
                           f"q of joint 'hinge' is {degrees} rad, {turns} turns; angles are in radians: "
                           f"{degrees} degrees are {radians}")

    def test_gravity_upwards(self):
        for command in ("dynamics", "modes"):
            self.check([command, HINGE, "--gravity", "0,0,9.81"], "gravity points up", "-9.81")

    def test_a_step_longer_than_a_second_or_than_the_run(self):
        self.check(["simulate", HINGE, "--duration", 40, "--step", 20], "the step is 20 s", "0.0001 to 0.01 s")
        self.check(["simulate", HINGE, "--duration", 1e-4], "the run of 0.0001 s is shorter than the step of 0.001 s")


if __name__ == "__main__":
    main()
