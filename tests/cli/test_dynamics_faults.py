#!/usr/bin/env python3
"""`twinarm dynamics`: all faults of a state file and of the options, at once.

    test_dynamics_faults.py PATH/TO/twinarm
"""
import os
import sys
import unittest

import robot_command
from robot_command import PENDULUM, RobotCommand, joint, link, robot


class Faults(RobotCommand):
    command = "dynamics"
    ARM = robot('<link name="base"/>', link("upper"), link("fore"), link("hand"), link("tip"),
                joint("shoulder", "continuous", "base", "upper"),
                joint("elbow", "continuous", "upper", "fore"),
                joint("wrist", "continuous", "fore", "hand", more='<mimic joint="elbow"/>'),
                joint("glue", "fixed", "hand", "tip"))
    BALL = robot('<link name="base"/>', link("body"), joint("ball", "spherical", "base", "body"))

    def told(self, errors, *wanted):
        """Each of the wanted lists of words is told by one error, and nothing else is."""
        self.assertEqual(len(errors), len(wanted), errors)
        for words in wanted:
            self.assertTrue(any(all(w in error for w in words) for error in errors),
                            f"{words} in {errors}")

    def test_all_faults_of_a_state_are_told_at_once_with_their_lines(self):
        state = """{
 "q": {"elbo": 0.3,
       "wrist": 0.1,
       "glue": 0.2, "shoulder": [1, 2]},
 "qd": {"elbow": NaN, "shoulder": "fast"},
 "speed": {},
 "wrenches": [
  {"link": "foer", "force": [1, 2]},
  {"force": [1, 2, 3], "frame": "tool"}],
 "base": {"position": [0, 0, 1]}
}"""
        self.told(self.errors(self.ARM, state=state),
                  ["state.json:2", "elbo", "'elbow'"], ["state.json:3", "wrist", "follows"],
                  ["state.json:4", "glue", "fixed"], ["state.json:4", "shoulder", "a number"],
                  ["state.json:5", "elbow"], ["state.json:5", "shoulder", "fast"],
                  ["state.json:6", "speed"], ["state.json:8", "wrenches[0].link", "'fore'"],
                  ["state.json:8", "wrenches[0].force"], ["state.json:9", "wrenches[1].link"],
                  ["state.json:9", "frame", "tool"], ["state.json:10", "base", "--floating"])

    def test_a_file_that_is_not_there_or_not_json_is_named_with_its_line(self):
        missing = self.folder / "nowhere.json"
        self.told(self.errors(self.ARM, state=missing), ["nowhere.json"])
        self.told(self.errors(self.ARM, state='{"q":\n {"elbow": 1,}\n}'), ["state.json:2"])
        self.told(self.errors(self.ARM, state='{"q": {"elbow": 1}'), ["state.json:1"])
        self.told(self.errors(self.ARM, state='[1, 2]'), ["must be an object"])
        self.told(self.errors(self.ARM, state='{"q": {"elbow": 1,\n"elbow": 2}}'),
                  ["state.json:2", "elbow", "twice"])
        self.told(self.errors(self.ARM, state='{"q": {"elbow": 1e999}}'), ["state.json:1"])
        self.told(self.errors("nowhere.urdf", "--gravity", "1,2", state=missing),
                  ["nowhere.urdf"], ["--gravity", "three"], ["nowhere.json"])
        self.assertTrue(self.errors("<robot", state=missing))

    def test_a_quaternion_must_have_unit_length_but_for_the_digits_it_was_typed_with(self):
        nearly = [0.7071068, 0.7071068, 0, 0]
        answer = self.answer(self.BALL, state={"q": {"ball": nearly}})
        self.assertTrue(any("normalised" in warning for warning in answer["warnings"]))
        self.close(answer["links"]["body"]["rotation"], [[1, 0, 0], [0, 0, -1], [0, 1, 0]], 1e-15)
        for bad in ([0.7, 0.7, 0, 0], [0, 0, 0, 0], [1, 0, 0], 1.0):
            self.told(self.errors(self.BALL, state={"q": {"ball": bad}}), ["ball"])
        self.told(self.errors(robot(link("body")), "--floating",
                              state={"base": {"orientation": [1, 1, 0, 0], "speed": 1}}),
                  ["base.orientation"], ["base.speed"])

    def test_an_inertia_that_no_body_has_is_a_warning_and_under_strict_a_fault(self):
        flat = robot('<link name="base"/>', link("disc", inertia=(0.01, 0, 0, 0.01, 0, 0.05)),
                     joint("hinge", "continuous", "base", "disc"))
        warnings = self.answer(flat)["warnings"]
        self.assertTrue(any("disc" in w and "A + B >= C" in w for w in warnings), warnings)
        self.told(self.errors(flat, "--strict"), ["disc", "A + B >= C"])

    def test_options_that_are_no_numbers_are_told(self):
        self.told(self.errors(self.ARM, "--gravity", "0,0,down"), ["--gravity", "down"])
        self.told(self.errors(self.ARM, "--gravity", "0,0,nan"), ["--gravity", "nan"])
        self.told(self.errors(self.ARM, "--speed"), ["--speed"])
        self.told(self.errors("scene.toml"), ["scene.toml", "a scene"])

    def test_what_is_not_finite_is_not_printed_but_told_with_its_cause(self):
        for qd, name in ((1e200, "qd of joint 'hinge', 1e+200"),):
            error, = self.errors(PENDULUM, state={"q": {"hinge": 0.1}, "qd": {"hinge": qd}})
            self.assertIn("kinetic_energy", error)
            self.assertIn(name, error)
        self.assertEqual(self.run_it(PENDULUM, state={"qd": {"hinge": 1e100}}).returncode, 0)

    def test_a_folder_is_told_to_be_one(self):
        error, = self.errors("assets/robots")
        self.assertIn("is a folder; name the robot's URDF", error)
        error, = self.errors("run.twinrec")
        self.assertIn("is a recording", error)
        error, = self.errors(PENDULUM, state=self.folder / "none.json")
        self.assertIn("does not exist; check the name", error)


if __name__ == "__main__":
    robot_command.PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
