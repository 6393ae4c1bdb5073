"""Constraints between bodies that leave some motions free, against closed forms."""
import math

from program import ProgramTest, main

G = 9.81
BODY = """step = 0.001
integrator = "rk4"
gravity = [0, 0, -9.81]
[[body]]
name = "block"
shape = {{ box = {{ size = [0.1, 0.2, 0.3] }} }}
mass = 2
position = [0.5, 0, 0]
linear_velocity = {velocity}
angular_velocity = {spin}
[[constraint]]
name = "guide"
type = "{type}"
a = "world"
b = "block"
{keys}
"""
SLOPE = (0.6, 0, -0.8)  # downwards


class JointsBetweenBodies(ProgramTest):
    def last(self, type, keys, velocity=(0, 0, 0), spin=(0, 0, 0), time=0.5, forces=False, code=0):
        scene = self.write("guide.toml", BODY.format(type=type, keys=keys, velocity=list(velocity), spin=list(spin)))
        if code:
            return self.twinarm("simulate", scene, "--duration", time, code=code).stderr
        run = self.json_of("simulate", scene, "--duration", time, *(["--forces"] if forces else []))
        return run["samples"][-1]

    def near(self, found, expected, delta=1e-8):
        for one, other in zip(found, expected, strict=True):
            self.assertAlmostEqual(one, other, delta=delta)

    def test_a_prismatic_body_slides_without_turning(self):
        sample = self.last("prismatic", f"point = [0.5, 0, 0.1]\naxis = {list(SLOPE)}", forces=True)
        block = sample["links"]["block"]
        way = 0.5 * G * 0.8 * 0.5**2
        self.near(block["position"], (0.5 + 0.6 * way, 0, -0.8 * way))
        self.near(block["orientation"], (1, 0, 0, 0))
        # The guide carries the weight across the slope, and the moment about the point of the block.
        on = sample["forces"][0]["on"][0]
        self.near(on["force"], (2 * G * 0.6 * 0.8, 0, 2 * G * 0.6 * 0.6))
        self.near(sample["accelerations"]["block"]["linear"], (G * 0.8 * 0.6, 0, -G * 0.8 * 0.8))

    def test_a_cylindrical_body_slides_and_keeps_its_spin(self):
        block = self.last("cylindrical", "point = [0.5, 0, 0]\naxis = [0, 0, 1]", spin=(0, 0, 3))["links"]["block"]
        self.near(block["position"], (0.5, 0, -0.5 * G * 0.5**2))
        self.near(block["angular_velocity"], (0, 0, 3))
        self.near(block["orientation"], (math.cos(0.75), 0, 0, math.sin(0.75)))

    def test_a_universal_joint_keeps_its_axes_perpendicular(self):
        sample = self.last("universal", "point = [0, 0, 0]\naxis = [0, 0, 1]\naxis_b = [0, 1, 0]",
                           spin=(0, 1, 2), velocity=(0, 1, -0.5), time=1)
        block, R = sample["links"]["block"], sample["links"]["block"]["rotation"]
        self.assertAlmostEqual(R[2][1], 0, delta=1e-8)  # z of the world, y of the block
        self.near(block["position"], [0.5 * row[0] for row in R])
        # No moment about the world's z: its part of the angular momentum is kept. The block's inertia about its centre.
        inertia = [2 / 12 * (b**2 + c**2) for b, c in ((0.2, 0.3), (0.1, 0.3), (0.1, 0.2))]
        spin = block["angular_velocity"]
        of_block = [inertia[i] * sum(R[k][i] * spin[k] for k in range(3)) for i in range(3)]
        x, y, _ = block["position"]
        vx, vy, _ = block["linear_velocity"]
        momentum = sum(R[2][i] * of_block[i] for i in range(3)) + 2 * (x * vy - y * vx)
        self.assertAlmostEqual(momentum, 2 * (inertia[2] + 2 * 0.5**2), delta=1e-7)
        energy = sample["kinetic_energy"] + sample["potential_energy"]
        self.assertAlmostEqual(energy, 0.5 * (inertia[1] + 0.5) + 0.5 * 4 * (inertia[2] + 0.5), delta=1e-8)

    def test_a_point_on_a_line_slides_and_the_body_turns_freely(self):
        block = self.last("point_on_line", f"point = [0.5, 0, 0]\naxis = {list(SLOPE)}", spin=(0, 2, 0))[
            "links"]["block"]
        way = 0.5 * G * 0.8 * 0.5**2
        self.near(block["position"], (0.5 + 0.6 * way, 0, -0.8 * way))
        self.near(block["angular_velocity"], (0, 2, 0))

    def test_a_point_on_a_plane_falls_within_the_plane(self):
        block = self.last("point_on_plane", "point = [0.5, 0, 0]\naxis = [0.8, 0, 0.6]", velocity=(0, 1, 0))[
            "links"]["block"]
        way = 0.5 * G * 0.8 * 0.5**2
        self.near(block["position"], (0.5 + 0.6 * way, 0.5, -0.8 * way))

    def test_bad_axes_are_refused_with_a_remedy(self):
        for type, keys, words in (("prismatic", "point = [0, 0, 0]", "axis: is missing"),
                                  ("point_on_line", "axis = [0, 0, 1]", "point: is missing"),
                                  ("universal", "point = [0, 0, 0]\naxis = [0, 0, 1]\naxis_b = [0, 1, 1]",
                                   "axis and axis_b are not perpendicular"),
                                  ("cylindrical", "point = [0, 0, 0]\naxis = [0, 0, 1]\naxis_b = [0, 1, 0]",
                                   "axis_b: is not a key of this type of constraint")):
            with self.subTest(type):
                self.assertIn(words, self.last(type, keys, code=2))


if __name__ == "__main__":
    main()
