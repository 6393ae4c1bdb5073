"""Floating robots under semi-implicit Euler: warned of, with what the drift costs and what avoids it."""
import json
import re

from program import data, main
from robot_command import RobotCommand, joint, link, robot

BOX = '<collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>'


def arm():
    return robot(link("base", 3, (0, 0, 0), (0.05, 0, 0, 0.06, 0, 0.07)),
                 link("a", 2, (0.25, 0, 0), (0.01, 0, 0, 0.02, 0, 0.02)),
                 link("b", 1, (0.2, 0, 0), (0.005, 0, 0, 0.01, 0, 0.01)),
                 joint("j1", "continuous", "base", "a", xyz="0.2 0 0"),
                 joint("j2", "continuous", "a", "b", xyz="0.5 0 0", axis="0.6 0 0.8"))


def scene(gravity=0, without="nothing"):
    """Without the keys of the robot that the expression matches."""
    return re.sub(rf"(?m)^({without}) = .*\n", "", data("floating_arm.toml", gravity=[0, 0, gravity]))


class DriftWarning(RobotCommand):
    command = "simulate"

    def simulate(self, *options, urdf=None, gravity=0, without="nothing", more=""):
        self.write("arm.urdf", urdf or arm())
        text = scene(gravity, without) + more
        result = self.twinarm("simulate", self.write("scene.toml", text), "--json", *options)
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
        for part in ("'base'", "semi-implicit", "14 %", "--integrator rk4 or implicit-midpoint", "--step"):
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
        self.assertEqual(self.simulate(without="base|\\w+_velocity")[1], [])
        self.assertEqual(len(self.simulate(gravity=-9.81)[1]), 1)  # it falls, and nothing is there
        self.write("arm.urdf", arm().replace('type="continuous"', 'type="fixed"'))
        fixed = self.twinarm("simulate", self.write("scene.toml", scene(without="q|qd")))
        self.assertNotIn("floating base", fixed.stderr)

    def test_where_shapes_may_touch_the_remedy_is_event_steps_and_gravity_silences_it(self):
        urdf = arm().replace("</link>", BOX)
        floor = data("floor.toml")
        _, warnings = self.simulate(urdf=urdf, more=floor)
        self.assertEqual(len(warnings), 1)
        self.assertIn("--contact event", warnings[0])
        self.assertNotIn("rk4", warnings[0])
        self.assertEqual(self.simulate(urdf=urdf, more=floor, gravity=-9.81)[1], [])
        self.assertEqual(self.simulate("--contact", "event", urdf=urdf, more=floor)[1], [])

    def test_a_floating_urdf_alone_is_warned_of_too(self):
        result = self.run_it(arm(), "--floating", "--duration", 0.1, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("floating base 'base'", result.stderr)


if __name__ == "__main__":
    main()
