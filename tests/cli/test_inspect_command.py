"""`twinarm inspect`: quantities of the passes, wrenches that sum to zero, named forces, rejected input."""
import math
import re

from program import ROOT, data, main
from recording_command import DRIVEN
from robot_command import PENDULUM, RobotCommand, add, cross, joint, link, robot

S103 = "assets/robots/s103/s103.urdf"
PUMA = "assets/robots/puma560/puma560.urdf"
MOVING = ROOT / "assets/states/puma_qn_moving.json"
STATE = {"q": {"joint1": 0.3, "joint2": -0.8}, "qd": {"joint1": 1.2, "joint2": -0.5}, "tau": {"joint1": 2}}


class Inspect(RobotCommand):
    command = "inspect"

    def quantity(self, answer, number, body, name):
        found = [q for p in answer["passes"] if p["pass"] == number and p["body"] == body
                 for q in p["quantities"] if q["name"] == name]
        self.assertEqual(len(found), 1, f"{name} of {body} in pass {number}")
        return found[0]["value"]

    def wrenches_on(self, answer, body):
        """By their sources."""
        found, = (b for b in answer["balance"] if b["body"] == body)
        return {w["source"]: w for w in found["wrenches"]}

    def check_sums(self, answer):
        """Sums computed here, not the printed residual."""
        for body in answer["balance"]:
            for part in ("force", "torque"):
                total = add(*(w[part] for w in body["wrenches"]))
                largest = max(abs(x) for w in body["wrenches"] for p in ("force", "torque") for x in w[p])
                if largest > 1e-15:  # less is the rounding of a body on which nothing acts
                    self.assertLessEqual(max(map(abs, total)), 1e-10 * largest, body["body"])
            self.assertLess(body["residual"], 1e-10)
        for line in answer["joint_balance"]:
            self.assertLess(line["residual"], 1e-10, line)
        for check in answer["checks"]:
            self.assertTrue(check["pass"], check)
            self.assertLessEqual(check["error"], check["tolerance"])

    def test_every_check_passes_on_the_robots_that_come_with_it(self):
        for urdf, options, state in ((S103, [], STATE), (S103, ["--no-friction"], STATE),
                                     (PUMA, [], MOVING),
                                     (PUMA, ["--floating"], None),
                                     (PUMA, ["--axes", "link"], None)):
            with self.subTest(urdf=urdf, options=options):
                self.check_sums(self.answer(urdf, *options, state=state))

    def test_accelerations_are_those_of_twinarm_dynamics(self):
        found = self.answer(PUMA, state=MOVING)
        wanted = self.json_of("dynamics", PUMA, "--state", MOVING)["qdd"]
        of_joint = {p["joint"]: p["body"] for p in found["passes"]}
        for name, qdd in wanted.items():
            self.close([self.quantity(found, 3, of_joint[name], "qdd")], [qdd], 1e-9, name)

    def test_a_pendulum_by_hand(self):
        # A point of 1 kg on 1 m, at 90 degrees: D = 1, u = S^T of its weight, a = -g downwards.
        found = self.answer(PENDULUM, state={"q": {"hinge": 1.5707963267948966},
                                             "qd": {"hinge": 2}, "tau": {"hinge": 3}})
        self.close([self.quantity(found, 2, "bob", "D")], [1])
        self.close([self.quantity(found, 2, "bob", "u")], [3])
        self.close([self.quantity(found, 3, "bob", "qdd")], [3 - 9.81])
        self.close(self.quantity(found, 1, "bob", "S"), [0, -1, 0, 0, 0, 0])
        self.close(self.quantity(found, 1, "bob", "v"), [0, -2, 0, 0, 0, 0])
        wrenches = self.wrenches_on(found, "bob")
        self.close(wrenches["gravity"]["force"], [0, 0, -9.81])
        # The bob is 1 m from the axis: centripetal force m w^2 r, torque tau.
        at = wrenches["joint/hinge"]
        self.assertAlmostEqual(abs(at["force"][0]), 4, places=12)
        self.assertAlmostEqual(at["torque"][1], -3, places=12)

    def test_each_applied_wrench_has_its_own_name(self):
        state = {"wrenches": [{"link": "bob", "point": [0, 0, -1], "force": [1, 2, 3]},
                              {"link": "bob", "torque": [0, 0, 7]}]}
        found = self.answer(PENDULUM, state=state)
        wrenches = self.wrenches_on(found, "bob")
        self.close(wrenches["wrench/0"]["force"], [1, 2, 3])
        self.close(wrenches["wrench/0"]["torque"], cross([0, 0, -1], [1, 2, 3]))
        self.close(wrenches["wrench/1"]["torque"], [0, 0, 7])
        self.check_sums(found)

    def test_all_joint_types_and_friction_and_mimics(self):
        parts, parent = ['<link name="base"/>'], "base"
        kinds = ["spherical", "universal", "cylindrical", "screw", "planar", "floating", "fixed",
                 "prismatic", "revolute"]
        for n, kind in enumerate(kinds):
            more = '<twinarm pitch="0.2"/>' if kind == "screw" else ""
            if kind == "revolute":
                more = '<dynamics damping="0.3" friction="0.1"/><mimic joint="j7" multiplier="2"/>'
            parts += [link(f"l{n}"), joint(f"j{n}", kind, parent, f"l{n}", xyz="0.1 0.2 0.3",
                                           rpy="0.3 -0.2 0.9", axis="0.6 0 0.8", more=more)]
            parent = f"l{n}"
        state = {"qd": {"j0": [1, 2, 3], "j1": [1, -1], "j2": [2, 0.3], "j3": 1,
                        "j4": [0.1, 0.2, 0.3], "j5": [1, 2, 3, 0.3, 0.2, 0.1], "j7": 0.7}}
        self.check_sums(self.answer(robot(*parts), state=state))

    def test_pass_and_body_select_the_output(self):
        found = self.answer(S103, "--pass", "2", "--body", "arm2")
        self.assertEqual([(p["pass"], p["body"]) for p in found["passes"]], [(2, "arm2")])
        self.assertEqual([b["body"] for b in found["balance"]], ["arm2"])

    def test_the_text_fits_a_terminal(self):
        for model, state in ((S103, None), (S103, STATE), (PUMA, MOVING),
                             ("assets/scenes/box_stack.toml", None),
                             ("assets/scenes/four_bar.toml", None)):
            text = self.run_it(model, state=state).stdout
            self.assertIn("PASS 3", text)
            wide = [line for line in text.splitlines() if len(line) > 100]
            self.assertEqual(wide, [])

    def test_the_documentation_lists_every_quantity_with_its_equation(self):
        page = (ROOT / "docs/use/inspect_a_state.md").read_text(encoding="utf-8")
        page = page.split("## What each quantity is")[1].split("\n## ")[0]
        for step in self.answer(PUMA)["passes"]:
            for quantity in step["quantities"]:
                row = [line for line in page.splitlines() if line.startswith(f"| `{quantity['name']}` |")]
                self.assertEqual(len(row), 1, quantity["name"])
                self.assertIn(quantity["equation"], row[0])
                self.assertIn(quantity["meaning"], row[0])

    def test_both_triangles_of_a_matrix_show_the_same_digits(self):
        found = self.answer(PUMA, state=MOVING)
        for step in found["passes"]:
            for quantity in step["quantities"]:
                if quantity["name"] in ("I", "IA", "Ia"):
                    m = quantity["value"]
                    self.assertEqual(m, [list(column) for column in zip(*m)], step["body"])

    def test_rounding_errors_are_printed_as_zero(self):
        for model, state in ((S103, STATE), (PUMA, MOVING)):
            page = self.run_it(model, state=state).stdout.split("CROSS-CHECKS")[0]
            page = re.sub(r"(difference|residual) \S+", "", page)
            self.assertEqual(re.findall(r"\S*e-(?:1[4-9]|[2-9]\d)\b", page), [])


TOO_LARGE = ("dominoes", "granular_column")  # more than 1000 degrees of freedom


class InspectScenes(RobotCommand):
    command = "inspect"
    check_sums, wrenches_on = Inspect.check_sums, Inspect.wrenches_on

    def scene(self, name, *options):
        return self.answer(f"assets/scenes/{name}.toml", *options)

    def test_every_scene_that_comes_with_it_is_in_balance(self):
        for scene in sorted((ROOT / "assets/scenes").glob("*.toml")):
            with self.subTest(scene=scene.stem):
                if scene.stem in TOO_LARGE:
                    self.fault("model.too-large", "inspect", scene)
                else:
                    self.check_sums(self.json_of("inspect", scene))

    def test_each_box_of_a_stack_carries_the_weight_of_those_above(self):
        found = self.scene("box_stack")
        for body in found["balance"]:
            number = int(re.fullmatch(r"box(\d+)", body["body"])[1])
            up = [w["force"][2] for w in body["wrenches"] if w["source"].startswith("contact/") and w["force"][2] > 0]
            self.assertAlmostEqual(sum(up), (11 - number) * 9.81, places=6)

    def test_closed_loops_have_a_cross_check_at_rest_and_in_motion(self):
        for scene in ("slider_crank", "four_bar", "cradle"):
            check, = (c for c in self.scene(scene)["checks"] if c["name"] == "loops")
            self.assertTrue(check["pass"], check)
        self.assertFalse([c for c in self.scene("box_stack")["checks"] if c["name"] == "loops"])
        file = self.write("scene.toml", DRIVEN.replace('integrator = "rk4"', ""))
        check, = (c for c in self.answer(str(file))["checks"] if c["name"] == "loops")
        self.assertTrue(check["pass"], check)

    def test_a_contact_of_several_points_is_selected_by_its_name(self):
        every = [f["source"] for f in self.scene("box_stack", "--body", "box1")["forces"]]
        pair = next(s for s in every if s.startswith("contact/") and s.endswith("/1"))[:-2]
        points = sorted(s for s in every if s.startswith(pair + "/"))
        self.assertGreater(len(points), 1)
        for name in (pair, pair[len("contact/"):]):
            found = self.scene("box_stack", "--force", name)["forces"]
            self.assertEqual(sorted(f["source"] for f in found), points)
        found = self.scene("box_stack", "--force", points[1])["forces"]
        self.assertEqual([f["source"] for f in found], [points[1]])

    def test_a_coupling_force_acts_on_its_link_under_its_name(self):
        self.write("test.urdf", PENDULUM)
        for discretization in ("explicit", "semi-implicit", "implicit"):
            scene = self.write("scene.toml", data("pulled_pendulum.toml", damping=3, discretization=discretization))
            found = self.answer(str(scene))
            self.check_sums(found)
            pull = self.wrenches_on(found, "bob")["coupling/pull"]["force"]
            # 100 N/m over the chord of 0.2 rad, from rest.
            size = sum(x * x for x in pull) ** 0.5
            self.assertAlmostEqual(size, 100 * 2 * math.sin(0.1), delta=1e-9 if discretization == "explicit" else 0.2)


if __name__ == "__main__":
    main()
