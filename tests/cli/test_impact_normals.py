"""Impacts at an angle in fixed steps: how far the contact normal turns within a step bounds their error."""
import json
import math
import re

from program import ProgramTest, main

RADIUS, OFFSET, SPEED = 0.03, 0.03, 3
SCENE = f"""gravity = [0, 0, 0]
[[body]]
name = "cue"
shape = {{ sphere = {{ radius = {RADIUS} }} }}
mass = 0.2
position = [-0.5, {OFFSET}, 0]
linear_velocity = [{SPEED}, 0, 0]
friction = 0
restitution = 1
[[body]]
name = "object"
shape = {{ sphere = {{ radius = {RADIUS} }} }}
mass = 0.2
position = [0, 0, 0]
friction = 0
restitution = 1
"""
EXACT = -math.asin(OFFSET / (2 * RADIUS))  # direction of the object ball: the line of centres


class ImpactNormals(ProgramTest):
    def shot(self, *options, scene=SCENE):
        """Error of the object ball's direction [rad], and the turns of normals that the run warns of [rad]."""
        result = self.twinarm("simulate", self.write("shot.toml", scene), "--duration", 0.4, "--json", *options)
        answer = json.loads(result.stdout)
        warnings = [w for w in answer["warnings"] if "contact normal" in w]
        self.assertEqual("contact normal" in result.stderr, bool(warnings))
        for warning in warnings:
            self.assertRegex(warning, "cue-object .*--contact event, or a shorter --step")
        x, y, _ = answer["samples"][-1]["links"]["object"]["position"]
        turns = [float(re.search(r"by up to (\S+) rad", w).group(1)) for w in warnings]
        return abs(math.atan2(y, x) - EXACT), turns

    def test_a_cut_shot_is_wrong_by_no_more_than_the_turn_of_the_normal(self):
        for start in (-0.5, -0.5004, -0.5012, -0.502):  # different flights before the impact
            error, turns = self.shot("--step", 0.001, scene=SCENE.replace("-0.5,", f"{start},"))
            self.assertEqual(len(turns), 1)
            self.assertLess(error, 1.1 * turns[0])
            self.assertLess(turns[0], SPEED * 0.001 / (2 * RADIUS))  # |u_t| h / r

    def test_no_warning_below_one_percent_nor_with_located_events_nor_for_central_impacts(self):
        error, turns = self.shot("--step", 0.0001)
        self.assertEqual(turns, [])
        self.assertLess(error, 0.01)
        error, turns = self.shot("--step", 0.001, "--contact", "event")
        self.assertEqual(turns, [])
        self.assertLess(error, 1e-8)
        _, turns = self.shot("--step", 0.001, scene=SCENE.replace(f"{OFFSET}, 0]", "0, 0]", 1))
        self.assertEqual(turns, [])


if __name__ == "__main__":
    main()
