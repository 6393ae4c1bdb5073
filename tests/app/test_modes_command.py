#!/usr/bin/env python3
"""`twinarm modes`: frequencies and damping that are known in closed form, and what is refused.

    test_modes_command.py PATH/TO/twinarm
"""
import math
import pathlib
import sys
import unittest

import robot_command
from robot_command import PENDULUM, RobotCommand, joint, link, robot, slider

INERTIA = 0.5
HINGE = robot('<link name="base"/>', link("rod", 1, (0, 0, 0), (1, 0, 0, 1, 0, INERTIA)),
              joint("hinge", "continuous", "base", "rod"))


class Modes(RobotCommand):
    command = "modes"

    def scene(self, urdf, text):
        (self.folder / "test.urdf").write_text(urdf)
        scene = self.folder / "scene.toml"
        scene.write_text('[[robot]]\nname = "arm"\nmodel = "test.urdf"\n' + text)
        return str(scene)

    def test_a_torsional_coupling_swings_with_k_over_I(self):
        k, b = 30.0, 0.4
        for measure in ("world", "joint"):
            for treatment in ("explicit", "implicit"):
                scene = self.scene(HINGE, '[[coupling]]\nname = "pull"\ntype = "torsional"\n'
                                   f'measure = "{measure}"\nlink = "rod"\nstiffness = {k}\n'
                                   f'damping = {b}\ntreatment = "{treatment}"\n')
                mode, = self.answer(scene)["modes"]
                self.close([mode["frequency"], mode["damping_ratio"]],
                           [math.sqrt(k / INERTIA), b / (2 * math.sqrt(k * INERTIA))], 1e-11)
                self.assertEqual(mode["shape"], {"hinge": 1.0})
                self.assertGreater(mode["eigenvalue"][1], 0)

    def test_a_linear_coupling_adds_to_gravity(self):
        # A point of 1 kg on 1 m: w^2 = g/l + k/m about the lowest place, where the target is.
        scene = self.scene(PENDULUM, '[[coupling]]\nname = "pull"\ntype = "linear"\nlink = "bob"\n'
                           'point = [0, 0, -1]\nstiffness = 25\ndamping = 0\n')
        mode, = self.answer(scene)["modes"]
        self.close([mode["frequency"], mode["damping_ratio"]], [math.sqrt(9.81 + 25), 0], 1e-11)

    def test_a_pendulum_hangs_and_stands(self):
        mode, = self.answer(PENDULUM)["modes"]
        self.close([mode["frequency"]], [math.sqrt(9.81)], 1e-12)
        up = self.answer(PENDULUM, state={"q": {"hinge": math.pi}})["modes"]
        self.close(sorted(m["eigenvalue"][0] for m in up), [-math.sqrt(9.81), math.sqrt(9.81)])

    def test_a_damped_slider_drifts_and_decays(self):
        modes = self.answer(slider(damping=0.8, mass=2))["modes"]
        self.assertEqual(modes[0]["eigenvalue"], [0, 0])
        self.close(modes[1]["eigenvalue"], [-0.4, 0])

    def test_zeros_are_kept_two_for_each_drift(self):
        modes = self.answer(slider())["modes"]
        self.assertEqual([m["eigenvalue"] for m in modes], [[0, 0], [0, 0]])
        two = robot(link("a"), link("b"), joint("j", "continuous", "a", "b", xyz="1 0 0"))
        modes = self.answer(two, "--floating", "--gravity", "0,0,0")["modes"]
        self.assertEqual([m["frequency"] for m in modes], [0] * 14)

    def test_a_follower_counts_through_its_ratio(self):
        # Leader and follower slide along x: (m1 + ratio^2 m2) with the leader's spring.
        both = robot('<link name="base"/>', link("a", 2, (0, 0, 0)), link("b", 3, (0, 0, 0)),
                     joint("j1", "prismatic", "base", "a", axis="1 0 0"),
                     joint("j2", "prismatic", "base", "b", axis="1 0 0",
                           more='<mimic joint="j1" multiplier="2"/>'))
        scene = self.scene(both, '[[coupling]]\nname = "pull"\ntype = "torsional"\n'
                           'measure = "joint"\nlink = "a"\nstiffness = 56\ndamping = 0\n')
        mode, = self.answer(scene)["modes"]
        self.close([mode["frequency"]], [math.sqrt(56 / (2 + 4 * 3))], 1e-11)

    def test_the_table_for_people_tells_periods_and_shapes(self):
        text = self.run_it("assets/robots/puma560/puma560.urdf").stdout
        for word in ("[Hz]", "period", "damping ratio", "shapes"):
            self.assertIn(word, text)

    def test_faults_come_all_at_once(self):
        scene = self.scene(HINGE, '[[constraint]]\nname = "tie"\ntype = "ball"\na = "rod"\n'
                           'b = "world"\npoint = [0, 0, 0]\n')
        errors = self.errors(scene)
        self.assertEqual(len(errors), 1, errors)
        self.assertIn("tie", errors[0])


if __name__ == "__main__":
    robot_command.PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
