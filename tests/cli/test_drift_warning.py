#!/usr/bin/env python3
"""Floating robots under semi-implicit Euler: warned of, with what the drift costs and what avoids it.

    test_drift_warning.py PATH/TO/twinarm
"""
import json
import pathlib
import subprocess
import sys
import unittest

import robot_command
from robot_command import joint, link, robot

BOX = '<collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>'


def arm():
    return robot(link("base", 3, (0, 0, 0), (0.05, 0, 0, 0.06, 0, 0.07)),
                 link("a", 2, (0.25, 0, 0), (0.01, 0, 0, 0.02, 0, 0.02)),
                 link("b", 1, (0.2, 0, 0), (0.005, 0, 0, 0.01, 0, 0.01)),
                 joint("j1", "continuous", "base", "a", xyz="0.2 0 0"),
                 joint("j2", "continuous", "a", "b", xyz="0.5 0 0", axis="0.6 0 0.8"))


SCENE = """gravity = [0, 0, %s]
duration = 0.01
%s
[[robot]]
name = "r"
model = "arm.urdf"
%s
position = [1, 2, 3]
linear_velocity = [0.5, -0.2, 0.1]
angular_velocity = [1, 2, -1.5]
q = { j1 = 0.3, j2 = -0.8 }
qd = { j1 = 3, j2 = -5 }
"""
FLOATS = 'base = "floating"'


class DriftWarning(robot_command.RobotCommand):
    command = "simulate"

    def simulate(self, *options, urdf=None, gravity=0, base=FLOATS, keys=""):
        (self.folder / "arm.urdf").write_text(urdf or arm())
        scene = self.folder / "scene.toml"
        text = SCENE % (gravity, keys, base)
        if base != FLOATS:
            text = "".join(line for line in text.splitlines(True) if "r_velocity" not in line)
        scene.write_text(text)
        result = subprocess.run([robot_command.PROGRAM, "simulate", str(scene), "--json",
                                 *map(str, options)], capture_output=True, text=True, timeout=300)
        self.assertEqual(result.returncode, 0, result.stderr)
        answer = json.loads(result.stdout)
        warnings = [w for w in answer["warnings"] if "floating base" in w]
        self.assertEqual("floating base" in result.stderr, bool(warnings))
        return answer, warnings

    def test_the_drift_that_the_warning_names_is_what_such_a_robot_shows(self):
        def gain(*options):
            answer, warnings = self.simulate("--duration", 100, *options)
            start, end = (sample["kinetic_energy"] for sample in answer["samples"])
            return (end - start) / start, warnings

        drift, warnings = gain()
        self.assertAlmostEqual(drift, 0.14, delta=0.005)
        self.assertEqual(len(warnings), 1)
        for part in ("'base'", "semi-implicit", "14 %", "--integrator rk4 or implicit-midpoint",
                     "--step"):
            self.assertIn(part, warnings[0])
        drift, warnings = gain("--integrator", "rk4")
        self.assertLess(abs(drift), 1e-9)
        self.assertEqual(warnings, [])

    def test_only_first_order_integrators_of_floating_bases_with_joints_are_warned_of(self):
        for integrator in ("semi-implicit", "semi-implicit-xv"):
            self.assertEqual(len(self.simulate("--integrator", integrator)[1]), 1, integrator)
        for integrator in ("rk4", "implicit-midpoint", "verlet", "dopri5"):
            self.assertEqual(self.simulate("--integrator", integrator)[1], [], integrator)
        self.assertEqual(self.simulate("--contact", "event")[1], [])
        self.assertEqual(self.simulate(base="")[1], [])
        self.assertEqual(len(self.simulate(gravity=-9.81)[1]), 1)  # it falls, and nothing is there
        stiff = arm().replace('type="continuous"', 'type="fixed"')
        (self.folder / "arm.urdf").write_text(stiff)
        scene = self.folder / "scene.toml"
        scene.write_text("".join(line for line in (SCENE % (0, "", FLOATS)).splitlines(True)
                                 if not line.startswith("q")))
        result = subprocess.run([robot_command.PROGRAM, "simulate", str(scene)],
                                capture_output=True, text=True, timeout=60)
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_where_shapes_may_touch_the_remedy_is_event_steps_and_gravity_silences_it(self):
        urdf = arm().replace("</link>", BOX)
        floor = ('[[body]]\nname = "floor"\nfixed = true\n'
                 'shape = { halfspace = { normal = [0, 0, 1], offset = 0 } }\n')
        _, warnings = self.simulate(urdf=urdf, keys=floor)
        self.assertEqual(len(warnings), 1)
        self.assertIn("--contact event", warnings[0])
        self.assertNotIn("rk4", warnings[0])
        self.assertEqual(self.simulate(urdf=urdf, keys=floor, gravity=-9.81)[1], [])
        self.assertEqual(self.simulate("--contact", "event", urdf=urdf, keys=floor)[1], [])

    def test_a_floating_urdf_alone_is_warned_of_too(self):
        result = self.run_it(arm(), "--floating", "--duration", 0.1, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("floating base 'base'", result.stderr)


if __name__ == "__main__":
    robot_command.PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
