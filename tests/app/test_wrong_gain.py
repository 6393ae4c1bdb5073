#!/usr/bin/env python3
"""A gain above its limit on the S-103, as a user meets it: the post-mortem names the right one of two
springs, each remedy that it offers works, and the last steps can be opened.

    test_wrong_gain.py PATH/TO/twinarm
"""
import json
import pathlib
import re
import subprocess
import sys
import unittest

import robot_command
from robot_command import RobotCommand

SPRING = ('[[coupling]]\nname = "{name}"\ntype = "torsional"\nmeasure = "joint"\nlink = "{link}"\n'
          'stiffness = {k}\ndamping = {b}\ntreatment = "{treatment}"\n'
          '[coupling.target]\nq = {{ {joint} = 0.2 }}\n')


class WrongGain(RobotCommand):
    def run_with(self, k, *options, step=0.001, treatment="explicit", duration=0.5):
        scene = self.folder / "scene.toml"
        scene.write_text(
            f'step = {step}\n[[robot]]\nname = "arm"\nmodel = "robots/s103/s103.urdf"\n' +
            SPRING.format(name="soft", link="arm1", joint="joint1", k=200, b=2, treatment=treatment) +
            SPRING.format(name="hard", link="arm2", joint="joint2", k=k, b=0, treatment=treatment))
        return subprocess.run(
            [robot_command.PROGRAM, "simulate", scene, "--duration", str(duration), "--json",
             *map(str, options)], capture_output=True, text=True, timeout=120,
            cwd=robot_command.ROOT)

    def test_the_right_spring_is_named_and_what_it_says_would_hold_holds(self):
        file = self.folder / "last.twinrec"
        broken = self.run_with(9e5, "--post-mortem", file, "--energy-bound", 1e6)
        self.assertEqual(broken.returncode, 3, broken.stderr)
        self.assertIn("behind it: coupling 'hard'", broken.stderr)
        suspect = json.loads(broken.stdout)["post_mortem"]["suspects"][0]
        self.assertIn("'hard'", suspect["name"])
        self.assertGreater(suspect["w_h"], suspect["limit"])
        # What the words advise has room: the spring, which swings for ever, keeps to its energy.
        step, gain = (float(re.search(pattern, broken.stderr).group(1)) for pattern in
                      (r"a step of (\S+) s would hold", r"a stiffness of (\S+) N m/rad would hold"))
        for run in (self.run_with(9e5, "--energy-bound", 5e4, step=step),
                    self.run_with(gain, "--energy-bound", 0.06 * gain)):
            self.assertEqual(run.returncode, 0, run.stderr)
        for run in (self.run_with(9e5, step=0.99 * suspect["largest_step"]),
                    self.run_with(0.99 * suspect["largest_gain"]),
                    self.run_with(9e5, treatment="implicit")):
            self.assertEqual(run.returncode, 0, run.stderr)

    def test_a_run_that_bounces_between_its_limits_does_not_pass_for_sound(self):
        answer = json.loads(self.run_with(9e5, duration=0.034).stdout)
        self.assertEqual(answer["alarm"]["row"], "numerical")

    def test_a_recorded_robot_with_meshes_is_opened_with_its_forces(self):
        file = self.folder / "run.twinrec"
        done = self.run_with(100, "--record", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        opened = subprocess.run(
            [robot_command.PROGRAM, "inspect", file, "--at", "0.03", "--force", "hard", "--json"],
            capture_output=True, text=True, timeout=60)
        self.assertEqual(opened.returncode, 0, opened.stdout + opened.stderr)
        force, = json.loads(opened.stdout)["forces"]
        self.assertEqual([j["joint"] for j in force["joints"]], ["joint2"])


if __name__ == "__main__":
    robot_command.PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
