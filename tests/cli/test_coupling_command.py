"""`twinarm coupling predict` and `twinarm coupling gains`: closed forms, runs, and rejected input."""
import json
import math

from program import main, run
from robot_command import HINGE, HINGE_INERTIA, PENDULUM, RobotCommand, joint, link, robot

BESIDE = "assets/scenes/robot_beside_obstacles.toml"


def coupling(**keys):
    lines = ["[[coupling]]"]
    for key, value in keys.items():
        lines.append(f"{key} = {json.dumps(value)}")
    return "\n".join(lines) + "\n"


class CouplingCommand(RobotCommand):
    command = "coupling"

    def scene(self, urdf, text):
        self.write("test.urdf", urdf)
        return str(self.write("scene.toml", f'[[robot]]\nname = "arm"\nmodel = "test.urdf"\n{text}'))

    def predict(self, scene, *options, state=None):
        return self.answer("predict", scene, *options, state=state)

    def gains(self, *options):
        return self.answer("gains", *options)["couplings"]


class Predict(CouplingCommand):
    def torsional(self, k=30.0, b=0.4, **more):
        keys = dict(name="pull", type="torsional", measure="joint", link="rod", stiffness=k, damping=b)
        return coupling(**{**keys, **more})

    def test_a_hinge_has_its_frequency_its_damping_and_the_limits_of_the_table(self):
        k, b = 30.0, 0.4
        found = self.predict(self.scene(HINGE, self.torsional(k, b, discretization="explicit")))
        w, z = math.sqrt(k / HINGE_INERTIA), b / (2 * math.sqrt(k * HINGE_INERTIA))
        mode, = found["modes"]
        self.close([mode["frequency"], mode["damping_ratio"], mode["shape"]["hinge"]], [w, z, 1], 1e-9)
        limits = {row["scheme"]: row for row in found["limits"]}
        root = math.sqrt(1 + z * z)
        for scheme, wh in (("explicit Euler", 2 * z), ("semi-implicit Euler", 2 * (root - z)),
                           ("semi-implicit Euler, damper implicit", 2 * (root + z))):
            self.close(limits[scheme]["max_stable_step"], wh / w, 1e-7)
            # At the scene's step of 1 ms: the same limit, reached by a stiffer spring.
            if scheme != "explicit Euler":
                self.close(limits[scheme]["stiffness_factor_same_zeta"] / (wh / (w * 1e-3)) ** 2, 1, 1e-6)
        self.assertIsNone(limits["spring and damper implicit"]["max_stable_step"])
        self.assertEqual([s for s, row in limits.items() if row["selected"]], ["semi-implicit Euler"])
        self.close(found["scene"]["max_stable_step"], 2 * (root - z) / w, 1e-7)
        self.assertTrue(found["scene"]["stable"])

    def test_the_scheme_of_the_scene_is_marked(self):
        for discretization, integrator, scheme in (
                ("explicit", "euler", "explicit Euler"),
                ("explicit", "rk4", "Runge-Kutta of order 4"),
                ("semi-implicit", "semi-implicit", "semi-implicit Euler, damper implicit"),
                ("implicit", "semi-implicit", "spring and damper implicit"),
                ("explicit", "verlet", None)):
            scene = self.scene(HINGE, self.torsional(discretization=discretization))
            found = self.predict(scene, "--integrator", integrator)
            marked = [row["scheme"] for row in found["limits"] if row["selected"]]
            self.assertEqual(marked, [scheme] if scheme else [], discretization)

    def test_tracking_errors_are_the_closed_forms(self):
        k, b = 1250.0, 50.0  # w = 50, z = 1
        found = self.predict(self.scene(HINGE, self.torsional(k, b)))
        mode, = found["modes"]
        v, w = math.pi, 50
        errors = mode["errors"]
        self.close(errors["start"], v / (math.e * w), 1e-6)
        self.close(errors["reversal"], 2 * v / (math.e * w), 1e-6)
        self.close(math.degrees(errors["absolute_damper_lag"]), 7.2, 1e-9)
        self.close(math.degrees(errors["mocap_weld_lag"]), 7.2, 1e-9)
        self.close(errors["quintic"] / (5.7735 * math.pi / w ** 2), 1, 0.05)
        slower = self.predict(self.scene(HINGE, self.torsional(k, b)), "--move", "90", "--time", "2")
        self.close(slower["modes"][0]["errors"]["start"], v / 4 / (math.e * w), 1e-6)

    def test_a_scene_beyond_its_stability_limit_gives_a_warning_and_diverges(self):
        scene = self.scene(HINGE, self.torsional(3e5, 300, discretization="explicit"))
        limit = self.predict(scene)["scene"]["max_stable_step"]
        bad = self.predict(scene, "--step", str(1.02 * limit))
        self.assertFalse(bad["scene"]["stable"])
        self.assertIn("stability limit", "".join(bad["warnings"]))
        self.assertTrue(self.predict(scene, "--step", str(0.98 * limit))["scene"]["stable"])
        state = self.write("off.json", '{"q": {"hinge": 1e-6}}')
        for part, runs_away in ((0.99, False), (1.01, True)):
            result = run("simulate", scene, "--duration", 2000 * part * limit, "--step", part * limit, "--json",
                         "--state", state)
            self.assertIn(result.returncode, (0, 3), result.stderr)
            end = abs(json.loads(result.stdout)["samples"][-1]["q"]["hinge"])
            self.assertEqual(result.returncode == 3 or end > 1e-5, runs_away, (part, end))

    def test_off_its_target_a_point_spring_is_softer_by_the_cosine(self):
        k, r, e = 400.0, 0.3, 0.6
        scene = self.scene(HINGE, coupling(name="pull", type="linear", link="rod", point=[r, 0, 0], stiffness=k))
        found = self.predict(scene, state={"q": {"hinge": e}})
        one, = found["couplings"]
        self.close(one["K"][0][0], k * r * r * math.cos(e), 1e-8)
        self.close(one["K_material"][0][0], k * r * r, 1e-12)
        self.close(one["offset"], 2 * r * math.sin(e / 2), 1e-12)
        arm, = one["arms"]
        h = 1e-3
        self.close([arm["radius"], arm["target_radius"], arm["largest_torque"]], [r, r, k * r * r])
        self.close(arm["largest_target_radius"], (4 * HINGE_INERTIA + 2 * r * r * h * h * k) / (h * h * k * r), 1e-9)
        # Beyond a right angle its stiffness is negative.
        over = self.predict(scene, state={"q": {"hinge": 2.0}})
        self.assertIn("push away", "".join(over["warnings"]))

    def test_static_deflection_is_torque_over_stiffness_and_null_without_coupling(self):
        k = 600.0
        scene = self.scene(PENDULUM, coupling(name="pull", type="torsional", measure="joint", link="bob", stiffness=k))
        found = self.predict(scene, state={"q": {"hinge": 0.5}})
        self.close(abs(found["static_deflection"]["hinge"]), 9.81 * math.sin(0.5) / k, 1e-9)
        both = robot('<link name="base"/>', link("a"), link("b"), joint("ja", "continuous", "base", "a", axis="0 1 0"),
                     joint("jb", "continuous", "base", "b", axis="0 1 0"))
        found = self.predict(self.scene(both, coupling(name="pull", type="torsional", link="a",
                                                       measure="joint", stiffness=k)))
        self.assertIsNone(found["static_deflection"]["jb"])
        self.assertIsNotNone(found["static_deflection"]["ja"])

    def test_a_wall_through_a_coupling_is_two_springs_in_series(self):
        scene = self.scene(HINGE, coupling(name="pull", type="linear", link="rod", point=[0.3, 0, 0], stiffness=700))
        one, = self.predict(scene, "--wall", "2000")["couplings"]
        self.close(one["through_wall"], 700 * 2000 / 2700)
        one, = self.predict(scene)["couplings"]
        self.assertIsNone(one["through_wall"])

    def test_the_table_of_the_papers_robot_has_every_part(self):
        result = self.run_it("predict", BESIDE, "--wall", "1000")
        self.assertEqual(result.returncode, 0, result.stderr)
        for words in ("K_q", "B_q", "Modes", "reversal", "bang-bang", "weld lag", "largest step",
                      "<- this scene", "Static deflection", "max R_K", "in series", "Runge-Kutta", "N/m"):
            self.assertIn(words, result.stdout)
        found = self.predict(BESIDE)
        self.assertEqual(found["rows"], ["joint1", "joint2", "joint3", "gripper_lift"])
        total = [[sum(c["K"][i][j] for c in found["couplings"]) for j in range(4)] for i in range(4)]
        self.close(total, found["K"], 1e-9)

    def test_a_robot_and_a_coupling_by_options_equal_the_scene_with_both(self):
        urdf = str(self.write("test.urdf", HINGE))
        state = {"q": {"hinge": 0.4}}
        words = ("--link", "rod", "--stiffness", "400", "--damping", "3", "--point", "0.3,0,0",
                 "--discretization", "semi-implicit")
        for more, keys in ((words, dict(type="linear", point=[0.3, 0, 0])),
                           ((*words[:6], "--type", "torsional", "--measure", "joint", *words[8:]),
                            dict(type="torsional", measure="joint"))):
            found = self.predict(urdf, *more, state=state)
            scene = self.scene(HINGE, coupling(link="rod", stiffness=400, damping=3,
                                               discretization="semi-implicit", **keys))
            wanted = self.predict(scene, state=state)
            found["couplings"][0]["name"] = wanted["couplings"][0]["name"]
            self.assertEqual(found, wanted)

    def test_along_gives_each_joint_its_share_of_the_move(self):
        found = self.predict(BESIDE, "--along", "joint1=-1,joint2=0.5")["joint_errors"]
        self.close([found["distance"][j] for j in ("joint1", "joint2", "joint3", "gripper_lift")],
                   [-math.pi, math.pi / 2, 0, 0])
        # The motion of the scene starts like this; its angles are not small, hence 2 %.
        samples = self.json_of("simulate", BESIDE, "--duration", 0.3, "--every", 0.001)["samples"]
        for name in ("joint1", "joint2"):
            peak = max(abs(next(iter(s["targets"].values()))["q"][name] - s["q"][name]) for s in samples)
            self.assertAlmostEqual(found["start"][name] / peak, 1, delta=0.02)

    def test_on_a_slide_a_joints_spring_has_newtons_per_metre(self):
        for sub in ("predict", "gains"):
            self.assertRegex(self.run_it(sub, BESIDE).stdout, r"20000 N/m")


class Gains(CouplingCommand):
    def test_solref_there_and_back(self):
        one, = self.gains("--inertia", "3", "--solref", "0.02,0.7")
        self.close([one["frequency"], one["damping_ratio"]], [1 / 0.014, 0.7], 1e-12)
        self.close(one["solref"], [0.02, 0.7], 1e-12)
        k, b = one["gains"]["stiffness"], one["gains"]["damping"]
        self.close([k, b], [3 / 0.014 ** 2, 2 * 0.7 * 3 / 0.014], 1e-12)
        self.close(one["solref_direct"], [-k / 3, -b / 3], 1e-12)
        again, = self.gains("--inertia", "3", "--solref", f"{one['solref_direct'][0]},{one['solref_direct'][1]}")
        self.close(again["gains"]["stiffness"] / k, 1, 1e-12)
        self.close([one["drive_force"]["stiffness"], one["drive_acceleration"]["stiffness"]], [k, k / 3], 1e-12)

    def test_the_gains_of_a_frequency_give_a_scene_that_frequency(self):
        one, = self.gains(self.scene(HINGE, coupling(name="pull", type="linear", link="rod", point=[0.3, 0, 0],
                                                     stiffness=100)), "--frequency", "5", "--damping-ratio", "0.4")
        self.close(one["inertia"], HINGE_INERTIA / 0.09, 1e-9)
        self.close(one["torsional"]["stiffness"], 100 * 0.09, 1e-9)
        wanted = one["wanted"]
        found = self.predict(self.scene(HINGE, coupling(name="pull", type="linear", link="rod", point=[0.3, 0, 0],
                                                        stiffness=wanted["stiffness"], damping=wanted["damping"])))
        mode, = found["modes"]
        self.close([mode["frequency"], mode["damping_ratio"]], [2 * math.pi * 5, 0.4], 1e-8)

    def test_a_weld_has_the_gains_of_a_spring_with_its_frequency(self):
        T, z, d = 0.05, 0.8, 0.7
        m = d / (1 - d) * 3 * HINGE_INERTIA  # of its couple; the centre of mass cannot move
        k, b = m / (d * T * T * z * z), 2 * m / (d * T)
        one, = self.gains(self.scene(HINGE, coupling(type="weld", link="rod", time_constant=T,
                                                     damping_ratio=z, impedance=d)))
        w = math.sqrt(k / (HINGE_INERTIA + m))
        zeta = b / (2 * math.sqrt(k * (HINGE_INERTIA + m)))
        self.close([one["frequency"], one["damping_ratio"]], [w, zeta], 1e-9)
        self.close(one["gains"]["stiffness"], HINGE_INERTIA * w * w, 1e-9)
        self.close(one["solref"], [1 / (w * zeta), zeta], 1e-9)
        self.close(one["solref_static_stiffness"], HINGE_INERTIA * w * w / (1 - d), 1e-9)

    def test_a_constraint_has_no_gains_to_convert(self):
        both = self.scene(HINGE, coupling(type="god-object") +
                          coupling(type="torsional", measure="joint", link="rod", stiffness=5))
        self.assertEqual(len(self.gains(both)), 1)


if __name__ == "__main__":
    main()
