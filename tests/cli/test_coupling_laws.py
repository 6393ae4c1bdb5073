#!/usr/bin/env python3
"""`twinarm coupling predict` of every law: its limit beside runs on both sides of it and beside closed
forms, and its errors beside runs behind a target that moves.

    test_coupling_laws.py PATH/TO/twinarm
"""
import json
import math
import pathlib
import subprocess
import sys
import unittest

import robot_command
from robot_command import RobotCommand, joint, link, robot
from waiting import TIMEOUT

INERTIA = 0.5
# The centre of mass on the axis: a weld then holds the orientation alone.
HINGE = robot('<link name="base"/>', link("rod", 1, (0, 0, 0), (1, 0, 0, 1, 0, INERTIA)),
              joint("hinge", "continuous", "base", "rod",
                    more='<dynamics damping="{damping}" friction="0"/>'))
TWO = robot('<link name="base"/>', link("upper", 2, (0.2, 0, 0), (0.01, 0, 0, 0.04, 0, 0.04)),
            link("lower", 1, (0.15, 0, 0), (0.01, 0, 0, 0.02, 0, 0.02)),
            joint("shoulder", "continuous", "base", "upper"),
            joint("elbow", "continuous", "upper", "lower", xyz="0.4 0 0"))
R = 0.3


def coupling(kind, treatment="", **keys):
    lines = ["[[coupling]]", 'name = "pull"', f'type = "{kind}"']
    if kind != "god-object":
        keys.setdefault("link", "rod")
    if treatment:
        keys["treatment"] = treatment
    return "\n".join(lines + [f"{key} = {json.dumps(value)}" for key, value in keys.items()]) + "\n"


def alpha_beta(k, b, h, inertia=INERTIA):
    return k * h * h / inertia, b * h / inertia


def edge(is_stable, longest=1.0):
    """The largest h of a closed form in alpha and beta, by bisection."""
    low, high = 0.0, longest
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if is_stable(middle) else (low, middle)
    return low


class CouplingLaws(RobotCommand):
    def scene(self, text, urdf=HINGE, start="", head="", name="scene.toml", damping=0):
        (self.folder / "test.urdf").write_text(urdf.replace("{damping}", str(damping)))
        file = self.folder / name
        file.write_text(f'{head}\n[[robot]]\nname = "r"\nmodel = "test.urdf"\n{start}\n{text}')
        return file

    def twinarm(self, *arguments, codes=(0,)):
        done = subprocess.run([robot_command.PROGRAM, *map(str, arguments), "--json"],
                              capture_output=True, text=True, timeout=TIMEOUT, cwd=self.folder)
        self.assertIn(done.returncode, codes, done.stderr)
        return done.returncode, json.loads(done.stdout)

    def predict(self, scene, *options):
        return self.twinarm("coupling", "predict", scene, *options)[1]

    def grows(self, text, h, integrator, steps=4000):
        """A run of the hinge, a millionth of a radian off its target."""
        if "target" not in text:
            text += "target = { q = { hinge = 0 } }\n"
        scene = self.scene(text, start="q = { hinge = 1e-6 }", name="run.toml")
        code, answer = self.twinarm("simulate", scene, "--duration", steps * h, "--step", h,
                                    "--integrator", integrator, codes=(0, 3))
        return code == 3 or abs(answer["samples"][-1]["q"]["hinge"]) > 3e-5

    def check_limit(self, of_step, closed=None, integrator="semi-implicit", start=0.01,
                    steps=4000):
        """`of_step`: the text of the coupling in steps of h; where no rate is in it they are alike.
        The limit is where runs begin to grow, to half a percent, and the closed form's."""
        found = self.predict(self.scene(of_step(start)), "--step", start, "--integrator",
                             integrator)
        limit = found["scene"]["largest_step"]
        self.assertIsNotNone(limit)
        self.assertGreater(limit, 0)
        if closed:
            self.close(limit / edge(closed), 1, 1e-6)
        self.assertFalse(self.grows(of_step(0.995 * limit), 0.995 * limit, integrator, steps))
        self.assertTrue(self.grows(of_step(1.005 * limit), 1.005 * limit, integrator, steps))
        return found


class Limits(CouplingLaws):
    def test_a_weld_counts_its_own_inertia(self):
        """m_R = d/(1 - d) 3 I about the hinge, k = m_R k_ref, b = m_R b_ref; alpha < 4 - 2 beta."""
        T, z, d = 0.05, 0.8, 0.7
        m = d / (1 - d) * 3 * INERTIA
        k, b = m / (d * T * T * z * z), 2 * m / (d * T)

        def of(treatment):
            return lambda h: coupling("weld", treatment, time_constant=T, damping_ratio=z,
                                      impedance=d)

        def weld(h):
            return alpha_beta(k, b, h, INERTIA + m)
        found = self.check_limit(of("explicit"), lambda h: weld(h)[0] < 4 - 2 * weld(h)[1])
        marked = [row["scheme"] for row in found["limits"] if row["is_the_scenes"]]
        self.assertEqual(marked, ["semi-implicit Euler"])
        self.check_limit(of("semi-implicit"), lambda h: weld(h)[0] < 4 + 2 * weld(h)[1])
        self.assertIsNone(self.predict(self.scene(of("implicit")(0)))["scene"]["largest_step"])

    def test_stable_pd_has_a_third_of_the_room(self):
        k, b = 300, 2

        def pd(h):
            alpha, beta = alpha_beta(k, b, h)
            return 3 * alpha < 4 + 2 * beta
        found = self.check_limit(lambda h: coupling("stable-pd", stiffness=k, damping=b), pd)
        self.assertEqual([row for row in found["limits"] if row["is_the_scenes"]], [])
        self.assertEqual(found["couplings"][0]["treatment"], "own")
        self.assertIn("stable-pd", found["scene"]["stepped"])

    def test_the_matched_law_is_the_torsional_spring_k_r2(self):
        k, b = 4000, 20

        def matched(h):
            alpha, beta = alpha_beta(k * R * R, b * R * R, h)
            return alpha < 4 - 2 * beta
        found = self.check_limit(
            lambda h: coupling("matched", stiffness=k, damping=b, point=[R, 0, 0]), matched)
        self.assertEqual(found["couplings"][0]["arms"], [], "it has no sine")

    def test_the_linear_law_as_printed_sees_differences(self):
        k, b = 4000, 150

        def of(h):
            return coupling("printed-linear", stiffness=k, damping=b, point=[R, 0, 0])
        ab = lambda h: alpha_beta(k * R * R, b * R * R, h)
        rows = (("semi-implicit", "semi-implicit Euler, backward difference",
                 lambda a, b: a < 4 - 2 * b),
                ("euler", "explicit Euler, backward difference", lambda a, b: a < b * (1 - b)),
                ("semi-implicit-xv", "semi-implicit Euler, backward difference",
                 lambda a, b: a < 4 - 2 * b),
                ("verlet", "zero-order hold, backward difference",
                 lambda a, b: a < 2 * b * (2 - b) / (2 + b)),
                ("rk4", "zero-order hold, backward difference",
                 lambda a, b: a < 2 * b * (2 - b) / (2 + b)))
        for integrator, scheme, stable in rows:
            with self.subTest(integrator):
                found = self.check_limit(of, lambda h: stable(*ab(h)), integrator, start=1e-3)
                marked = [row["scheme"] for row in found["limits"] if row["is_the_scenes"]]
                self.assertEqual(marked, [scheme])

    def test_a_force_as_printed_that_is_held_over_three_steps_grows_where_it_is_said_to(self):
        for integrator in ("semi-implicit", "rk4"):
            self.check_limit(
                lambda h: coupling("printed-linear", stiffness=4000, damping=150, point=[R, 0, 0],
                                   rate=1 / (3 * h)), integrator=integrator, steps=15000)

    def test_the_torsional_damper_as_printed_does_nothing_about_a_target_at_rest(self):
        k = 300
        found = self.check_limit(lambda h: coupling("printed-torsional", stiffness=k, damping=5),
                                 lambda h: k * h * h / INERTIA < 4)
        self.assertIn("no linear part", "".join(found["warnings"]))
        self.assertEqual(found["B"], [[0]])

    def test_a_bushing_is_its_point_and_its_couple_together(self):
        k, b, k_turn, b_turn = 2000, 8, 100, 0.5

        def of(treatment):
            return lambda h: coupling("bushing", treatment, stiffness=k, damping=b,
                                      turn_stiffness=k_turn, turn_damping=b_turn, point=[R, 0, 0])
        ab = lambda h: alpha_beta(k * R * R + k_turn, b * R * R + b_turn, h)
        self.check_limit(of("explicit"), lambda h: ab(h)[0] < 4 - 2 * ab(h)[1])
        self.check_limit(of("semi-implicit"), lambda h: ab(h)[0] < 4 + 2 * ab(h)[1])
        self.assertIsNone(self.predict(self.scene(of("implicit")(0)))["scene"]["largest_step"])

    def test_a_god_object_has_no_limit_and_is_said_to_have_no_spring(self):
        text = coupling("god-object")
        found = self.predict(self.scene(text))
        self.assertIsNone(found["scene"]["largest_step"])
        self.assertEqual([found["modes"], found["K"]], [[], [[0]]])
        self.assertEqual([row for row in found["limits"] if row["is_the_scenes"]], [])
        self.assertIn("is a constraint, not a spring", "".join(found["warnings"]))
        self.assertEqual(found["joint_errors"]["start"], {"hinge": 0})
        for h in (0.001, 0.2):
            self.assertFalse(self.grows(text, h, "semi-implicit"))

    def test_beside_a_god_object_a_spring_has_a_limit_of_its_own(self):
        """e' = -alpha e - beta (e - e_before): alpha < 1 - 2 beta (Jury)."""
        k, b = 300, 1

        def of(h):
            return (coupling("god-object") + "target = { q = { hinge = 0 } }\n" +
                    coupling("torsional", "explicit", measure="joint", stiffness=k,
                             damping=b).replace("pull", "spring") +
                    "target = { q = { hinge = 0 } }\n")

        def stable(h):
            alpha, beta = alpha_beta(k, b, h)
            return alpha < 1 - 2 * beta
        self.check_limit(of, stable)

    def test_a_delay_leaves_the_limit_as_it_is(self):
        keys = dict(measure="joint", stiffness=300, damping=2)
        now = self.predict(self.scene(coupling("torsional", "explicit", **keys)))
        late = self.predict(self.scene(coupling("torsional", "explicit", target="paper", delay=0.03,
                                                **keys)))
        self.assertEqual(late["scene"]["largest_step"], now["scene"]["largest_step"])
        self.assertIn("0.03 s late", "".join(late["warnings"]))

    def test_the_matched_law_has_the_stiffness_of_its_targets_pose(self):
        """J at the KVR: a point of the lower link, 0.25 m from the elbow."""
        k, elbow = 700.0, 1.1
        scene = self.scene(
            coupling("matched", link="lower", stiffness=k, damping=0, point=[0.25, 0, 0]) +
            f"target = {{ q = {{ elbow = {elbow} }} }}\n", urdf=TWO)
        found = self.predict(scene)
        J = [[-0.25 * math.sin(elbow), -0.25 * math.sin(elbow)],
             [0.4 + 0.25 * math.cos(elbow), 0.25 * math.cos(elbow)]]
        K = [[k * sum(J[r][i] * J[r][j] for r in range(2)) for j in range(2)] for i in range(2)]
        self.close(found["K"], K, 1e-9)

    def test_stops_alone_are_refused(self):
        scene = self.scene(coupling("torsional", "implicit", measure="joint", stiffness=10,
                                    outside=[-1, 1]))
        done = subprocess.run([robot_command.PROGRAM, "coupling", "predict", scene],
                              capture_output=True, text=True, timeout=TIMEOUT)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("stops", done.stderr)


SPEED = 1.0  # [rad/s] of the hinge's target
S103 = """[[robot]]
name = "arm"
model = "MODEL"
lock = ["gripper_lift"]
"""


def trace(way, duration, dt=5e-4):
    """Joints 1, 2 and 3 along way(t): theta1 turns joint 1 twice, theta4 and theta6 once."""
    rows = ["t[s],theta1[rad],theta2[rad],theta3[rad],theta4[rad],theta5[rad],theta6[rad]"]
    for n in range(round(duration / dt) + 1):
        x = way(n * dt)
        rows.append(f"{n * dt:.6f},{x / 2:.17g},0,0,{x:.17g},0,{x:.17g}")
    return "\n".join(rows) + "\n"


class Errors(CouplingLaws):
    def behind(self, scene, duration, step, every):
        """The errors of all joints at all samples."""
        samples = self.twinarm("simulate", scene, "--duration", duration, "--step", step, "--every",
                               every)[1]["samples"]
        found = []
        for sample in samples:
            target = next(iter(sample["targets"].values()))["q"]
            found.append({name: target[name] - q for name, q in sample["q"].items()})
        return found

    def test_at_an_even_speed_every_law_lags_as_predicted(self):
        T, z = 0.05, 0.8
        point = {"stiffness": 4000, "damping": 60, "point": [R, 0, 0]}
        turn = {"measure": "joint", "stiffness": 300, "damping": 5}
        gains = {"stiffness": 300, "damping": 5}
        laws = {  # text of the coupling, damping of the joint, lag in seconds of the motion
            "linear": (coupling("linear", **point), 0, 0),
            "absolute": (coupling("torsional", damper="absolute", **turn), 0, 5 / 300),
            "late": (coupling("torsional", delay=0.07, **turn), 0, 0.07),
            "late and absolute": (coupling("torsional", delay=0.07, damper="absolute", **turn), 0,
                                  0.07 + 5 / 300),
            "rusty": (coupling("torsional", **turn), 2, 2 / 300),
            "weld": (coupling("weld", time_constant=T, damping_ratio=z), 0, 2 * T * z * z),
            "matched": (coupling("matched", **point), 0, 0),
            "bushing": (coupling("bushing", turn_stiffness=20, turn_damping=1, damper="absolute",
                                 **point), 0, (60 * R * R + 1) / (4000 * R * R + 20)),
            "stable PD": (coupling("stable-pd", **gains), 1, 1 / 300),
            "printed": (coupling("printed-linear", **point), 0, 0),
            "god object": (coupling("god-object"), 2, 0)}
        (self.folder / "hand.csv").write_text(trace(lambda t: SPEED * t, 5, 5))
        for name, (text, damping, seconds) in laws.items():
            with self.subTest(name):
                scene = self.scene(text + 'target = "hand.csv"\n', damping=damping)
                found = self.predict(scene, "--turn", math.degrees(SPEED), "--time", 1)
                lag = found["joint_errors"]["lag"]["hinge"]
                self.close(lag, seconds * SPEED, 1e-9)
                # Behind the hand itself: what a coupling sees of it may be late.
                end = self.twinarm("simulate", scene, "--duration", 3)[1]["samples"][-1]
                self.assertAlmostEqual(3 * SPEED - end["q"]["hinge"], lag, delta=1e-3 * lag + 1e-6)

    def test_behind_a_start_every_law_peaks_as_predicted(self):
        """Small gains, for the error of a step is of the order of w h."""
        point = {"stiffness": 400, "damping": 6, "point": [R, 0, 0]}
        laws = {"linear": coupling("linear", **point), "matched": coupling("matched", **point),
                "weld": coupling("weld", time_constant=0.1, damping_ratio=0.6),
                "bushing": coupling("bushing", turn_stiffness=20, turn_damping=1,
                                    damper="absolute", **point),
                "stable PD": coupling("stable-pd", stiffness=30, damping=0.5),
                "printed": coupling("printed-linear", **point),
                "absolute": coupling("torsional", measure="joint", damper="absolute", stiffness=30,
                                     damping=2)}
        (self.folder / "hand.csv").write_text(trace(lambda t: 0.1 * t, 5, 5))
        for name, text in laws.items():
            with self.subTest(name):
                scene = self.scene(text + 'target = "hand.csv"\n', damping=0.3)
                found = self.predict(scene, "--turn", math.degrees(0.1), "--time", 1)
                peak = max(abs(e["hinge"]) for e in self.behind(scene, 1, 1e-4, 1e-3))
                self.assertAlmostEqual(found["joint_errors"]["start"]["hinge"] / peak, 1, delta=0.01)

    def s103(self, way, more=""):
        (self.folder / "hand.csv").write_text(trace(way, 0.5))
        scene = self.folder / "s103.toml"
        scene.write_text(
            S103.replace("MODEL", str(robot_command.ROOT / "assets/robots/s103/s103.urdf")) +
            coupling("linear", link="arm1", point=[0.25, 0, 0.365], stiffness=4000,
                            damping=200, target="hand.csv") +
            coupling("linear", link="arm2", point=[0.35, 0, 0.1], stiffness=2000, damping=100,
                     target="hand.csv").replace("pull", "outer") +
            coupling("torsional", link="quill", measure="joint", stiffness=20, damping=1,
                     target="hand.csv").replace("pull", "hold") + more)
        return scene

    def test_each_joint_of_the_papers_robot_lags_as_predicted_to_2_percent(self):
        """Half a degree of all three joints in 0.2 s: small, for the theory is linear."""
        degrees, T = 0.5, 0.2
        D = math.radians(degrees)

        def quintic(t):
            s = min(t / T, 1)
            return D * s ** 3 * (10 - 15 * s + 6 * s * s)

        def there_and_back(t):
            return D * (1 - abs(1 - t / T))
        task = ("--turn", degrees, "--time", T)
        scene = self.s103(quintic)
        found = self.predict(scene, *task)["joint_errors"]
        errors = self.behind(scene, 0.5, 1e-4, 2e-4)
        for name in ("joint1", "joint2", "joint3"):
            peak = max(abs(e[name]) for e in errors)
            self.assertAlmostEqual(found["quintic"][name] / peak, 1, delta=0.02, msg=name)
            self.close(found["distance"][name], D)
            self.close(found["lag"][name], 0)
        scene = self.s103(there_and_back)
        found = self.predict(scene, *task)["joint_errors"]
        errors = self.behind(scene, 0.4, 1e-4, 2e-4)
        for name in ("joint1", "joint2", "joint3"):
            start = max(abs(e[name]) for e in errors[:1000])
            self.assertAlmostEqual(found["start"][name] / start, 1, delta=0.02, msg=name)
            if abs(errors[999][name]) < 0.01 * start:  # all is still at the turn
                turn = max(abs(e[name]) for e in errors[1000:])
                self.assertAlmostEqual(found["reversal"][name] / turn, 1, delta=0.02, msg=name)

    def test_what_nothing_holds_has_no_error_in_table_and_json(self):
        text = coupling("torsional", link="upper", measure="joint", stiffness=300, damping=5)
        scene = self.scene(text, urdf=TWO)
        found = self.predict(scene)["joint_errors"]
        self.assertIsNone(found["start"]["elbow"])
        self.assertGreater(found["start"]["shoulder"], 0)
        table = subprocess.run([robot_command.PROGRAM, "coupling", "predict", scene],
                               capture_output=True, text=True, timeout=TIMEOUT).stdout
        self.assertRegex(table, r"elbow +deg +- +-")


if __name__ == "__main__":
    robot_command.PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
