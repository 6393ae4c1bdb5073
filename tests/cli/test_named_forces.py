"""`twinarm inspect` reads out the force of each constraint, contact and coupling by its name, in
chosen axes and about a chosen point: against what statics and Newton say."""
import math

from program import SCENES, data, main
from robot_command import PENDULUM, WHEELS, RobotCommand, add, cross

G = 9.81
BODY = ('[[body]]\nname = "{name}"\nshape = {{ box = {{ size = [0.1, 0.1, 0.1] }} }}\nmass = {mass}\n'
        'position = {position}\ngroup = 1\n')


class NamedForces(RobotCommand):
    command = "inspect"

    def scene(self, text, *options):
        return self.answer(str(self.write("scene.toml", "step = 1e-6\n" + text)), *options)

    def force(self, answer, source):
        found, = (f for f in answer["forces"] if f["source"] == source)
        return found

    def on(self, answer, source, body):
        found, = (end for end in self.force(answer, source)["on"] if end["body"] == body)
        return found

    def test_a_weld_carries_weight_and_its_moment(self):
        scene = (BODY.format(name="lamp", mass=3, position=[0.4, 0, 0]) +
                 '[[constraint]]\nname = "wall"\ntype = "weld"\na = "world"\nb = "lamp"\n'
                 'point = [0, 0, 0]\n')
        wall = self.on(self.scene(scene, "--about", "0,0,0"), "constraint/wall", "lamp")
        self.close(wall["force"], [0, 0, 3 * G], 1e-7)
        self.close(wall["torque"], [0, -0.4 * 3 * G, 0], 1e-7)
        about_com = self.on(self.scene(scene, "--about", "com"), "constraint/wall", "lamp")
        self.close(about_com["torque"], [0, 0, 0], 1e-6)

    def test_a_ball_and_a_distance_carry_weight_and_what_keeps_a_body_on_its_circle(self):
        # Through the lowest place with v: m g + m v^2 / L.
        for kind, point in (("distance", "point = [0, 0, 2]"), ("ball", "point = [0, 0, 2]")):
            text = BODY.format(name="bob", mass=2, position=[0, 0, 0])
            spin = "" if kind == "distance" else "angular_velocity = [0, 0.75, 0]\n"
            text += (f'linear_velocity = [{1.5 if kind == "distance" else -1.5}, 0, 0]\n{spin}'
                     f'[[constraint]]\nname = "string"\ntype = "{kind}"\na = "bob"\n'
                     f'b = "world"\n{point}\n')
            found = self.on(self.scene(text), "constraint/string", "bob")
            self.close(found["force"], [0, 0, 2 * G + 2 * 1.5 ** 2 / 2], 1e-5)

    def test_a_rod_that_is_let_go_leans_on_its_hinge_with_a_quarter_of_its_weight(self):
        m, l = 4.0, 0.6
        text = ('[[body]]\nname = "rod"\nshape = { box = { size = [0.6, 0.01, 0.01] } }\n'
                f'mass = {m}\ninertia = [0.001, {m * l * l / 12}, {m * l * l / 12}, 0, 0, 0]\n'
                f'com = [0, 0, 0]\nposition = [{l / 2}, 0, 0]\n'
                '[[constraint]]\nname = "nail"\ntype = "hinge"\na = "world"\nb = "rod"\n'
                'point = [0, 0, 0]\naxis = [0, 1, 0]\n')
        nail = self.on(self.scene(text, "--about", "0,0,0"), "constraint/nail", "rod")
        self.close(nail["force"], [0, 0, m * G / 4], 1e-4)
        self.close(nail["torque"], [0, 0, 0], 1e-4)

    def test_a_gear_passes_torque_on_by_its_ratio(self):
        self.write("test.urdf", WHEELS)
        self.write("state.json", '{"tau": {"ja": 7.0}}')
        found = self.scene('[[robot]]\nname = "arm"\nmodel = "test.urdf"\n[[constraint]]\n'
                           'name = "mesh"\ntype = "gear"\na = "arm/ja"\nb = "arm/jb"\nratio = 3\n',
                           "--state", self.folder / "state.json")
        by_joint = {j["joint"]: j["value"] for j in self.force(found, "constraint/mesh")["joints"]}
        # Wheel a turns with 7 / (0.2 + 0.5 / 9); the gear gives b what it takes, and takes a third.
        qdd = 7 / (0.2 + 0.5 / 9)
        self.close([by_joint["jb"], by_joint["ja"]], [0.5 * qdd / 3, -0.5 * qdd / 9], 1e-7)

    def test_a_contact_is_reported_by_pressing_and_friction(self):
        # A box at rest on an incline: m g cos, m g sin, between all points of contact.
        tilt, m = 0.3, 2.0
        text = ('contact = "rigid"\n[[body]]\nname = "box"\nmass = 2\nfriction = 0.9\n'
                'shape = { box = { size = [0.2, 0.2, 0.2] } }\n'
                f'position = [{0.1 * math.sin(tilt)}, 0, {0.1 * math.cos(tilt)}]\n'
                f'orientation = [{math.cos(tilt / 2)}, 0, {math.sin(tilt / 2)}, 0]\n'
                '[[body]]\nname = "slope"\nfixed = true\nfriction = 0.9\nshape = { halfspace = '
                f'{{ normal = [{math.sin(tilt)}, 0, {math.cos(tilt)}], offset = 0 }} }}\n')
        file = self.write("scene.toml", "step = 0.001\n" + text)
        found = [f for f in self.answer(str(file))["forces"] if f["source"].startswith("contact/")]
        self.assertTrue(found)
        self.close(sum(f["normal"] for f in found), m * G * math.cos(tilt), 1e-6)
        total = add(*(end["force"] for f in found for end in f["on"]))
        self.close(total, [0, 0, m * G], 1e-6)
        sliding = sum(f["friction"] for f in found)
        self.assertGreater(sliding, m * G * math.sin(tilt) - 1e-6)

    def test_a_coupling_in_the_axes_of_a_link_and_about_a_point(self):
        self.write("test.urdf", PENDULUM)
        text = data("pulled_pendulum.toml", damping=0).replace("q = { hinge = 0 }", "q = { hinge = 0.7 }")
        plain, own = self.scene(text), self.scene(text, "--axes", "bob", "--about", "0.3,0,-2")
        a, b = self.on(plain, "coupling/pull", "bob"), self.on(own, "coupling/pull", "bob")
        where = self.force(plain, "coupling/pull")["point"]
        self.close(where, [math.sin(0.7), 0, -math.cos(0.7)], 1e-12)
        chord = [math.sin(0.2) - math.sin(0.7), 0, math.cos(0.7) - math.cos(0.2)]
        self.close(a["force"], [100 * c for c in chord], 1e-9)
        self.close(a["torque"], cross(where, a["force"]), 1e-9)
        # The link is turned by -0.7 about y.
        c, s = math.cos(0.7), math.sin(0.7)
        turned = lambda v: [c * v[0] + s * v[2], v[1], -s * v[0] + c * v[2]]
        self.close(b["force"], turned(a["force"]), 1e-9)
        lever = [where[0] - 0.3, 0, where[2] + 2]
        self.close(b["torque"], turned(cross(lever, a["force"])), 1e-9)
        self.assertEqual((own["axes"], own["about"]), ("bob", "0.3,0,-2"))

    def test_ends_on_two_bodies_cancel_about_one_point(self):
        found = self.answer("assets/scenes/box_stack.toml", "--about", "0.3,0.2,0.1")
        pairs = [f["on"] for f in found["forces"] if len(f["on"]) == 2]
        self.assertGreater(len(pairs), 30)
        for one, other in pairs:
            for part in ("force", "torque"):
                self.close(add(one[part], other[part]), [0, 0, 0], 1e-10)

    def test_all_of_it_at_a_recorded_instant(self):
        file = self.folder / "run.twinrec"
        self.twinarm("simulate", SCENES / "slider_crank.toml", "--duration", 0.2, "--record", file)
        found = self.answer(str(file), "--at", 0.1, "--axes", "rod", "--about", "piston")
        pin = self.force(found, "constraint/pin")
        self.assertEqual({end["body"] for end in pin["on"]}, {"rod", "piston"})
        for body in found["balance"]:
            self.assertLess(body["residual"], 1e-10)

    def test_a_loop_in_motion_has_the_forces_of_the_instant(self):
        found = self.answer("assets/scenes/slider_crank.toml")
        force = next(end["force"] for end in self.force(found, "constraint/pin")["on"] if end["body"] == "piston")
        r, length, rate, mass = 0.1, 0.3, 5, 1.5  # at dead centre
        self.close([force[0]], [-mass * r * rate**2 * (1 + r / length)], 1e-9)

    def test_one_force_alone_on_a_page_that_fits(self):
        result = self.run_it("assets/scenes/slider_crank.toml", "--force", "pin")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("constraint/pin at (0.4, 0, 0)", result.stdout)
        self.assertNotIn("PASS 1", result.stdout)
        self.assertEqual([x for x in result.stdout.splitlines() if len(x) > 100], [])
        found = self.answer("assets/scenes/slider_crank.toml", "--force", "constraint/pin")
        self.assertEqual([f["source"] for f in found["forces"]], ["constraint/pin"])


if __name__ == "__main__":
    main()
