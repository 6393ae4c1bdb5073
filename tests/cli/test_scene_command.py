"""`twinarm simulate SCENE.toml`: free flight, several robots, couplings, what is refused."""
import json
import math
import struct

from program import data, main
from robot_command import HINGE, HINGE_INERTIA, STEADY_HAND, RobotCommand, add, joint, link, robot, scale

BALL = data("ball.toml")


def torus(side):
    """Binary STL of a closed surface of 2 side^2 triangles that is not convex."""
    turn = [(math.cos(2 * math.pi * k / side), math.sin(2 * math.pi * k / side)) for k in range(side)]

    def at(y, x):
        (c, s), (cx, sx) = turn[y % side], turn[x % side]
        return (2 + c) * cx, (2 + c) * sx, s
    faces = [f for y in range(side) for x in range(side)
             for f in ((at(y, x), at(y, x + 1), at(y + 1, x)), (at(y, x + 1), at(y + 1, x + 1), at(y + 1, x)))]
    return b" " * 80 + struct.pack("<I", len(faces)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *a, *b, *c, 0) for a, b, c in faces)


def arm(name, more=""):
    return f'[[robot]]\nname = "{name}"\nmodel = "test.urdf"\n{more}\n'


def coupling(more, kind="torsional", measure='measure = "joint"'):
    return (f'[[coupling]]\nname = "pull"\ntype = "{kind}"\n{measure}\nlink = "rod"\n{more}\n')


class Scenes(RobotCommand):
    command = "simulate"

    def simulate(self, scene, *options, urdf=HINGE, state=None):
        self.write("test.urdf", urdf)
        return self.run_it(str(self.write("scene.toml", scene)), *options, "--json", state=state)

    def run_scene(self, scene, *options, **more):
        result = self.simulate(scene, *options, **more)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def refusals(self, scene, *options, **more):
        result = self.simulate(scene, *options, **more)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        return json.loads(result.stdout)["errors"]

    def refused(self, code, where, line, scene, *options, **more):
        """One fault, of that code; returns what it says."""
        (fault,) = self.refusals(scene, *options, **more)
        self.assertEqual((fault["code"], fault["where"], fault["line"]), (code, where, line), fault)
        return fault["problem"] + fault["fix"]

    def balanced(self, answer):
        first, last = answer["samples"][0], answer["samples"][-1]
        change = last["kinetic_energy"] - first["kinetic_energy"]
        self.close(sum(answer["energy_balance"].values()), change, 1e-12)
        return change


class FreeFlight(Scenes):
    def test_a_thrown_ball_flies_on_its_parabola(self):
        answer = self.run_scene(BALL, "--duration", 0.5, "--integrator", "rk4")
        self.assertEqual((answer["joints"], answer["step"], answer["contacts"]), ([], 0.001, 0))
        ball, t = answer["samples"][-1]["links"]["ball"], 0.5
        self.close(ball["position"], add([0, 0, 1], scale(t, [1, 2, 3]), [0, 0, -9.81 * t * t / 2]), 1e-12)
        self.close(ball["angular_velocity"], [0, 0, 4], 1e-12)
        self.close(ball["rotation"][0], [math.cos(2), -math.sin(2), 0], 1e-12)
        self.assertEqual(answer["samples"][0]["q"], {})
        self.balanced(answer)
        self.close(answer["energy_balance"]["numerical"], 0, 1e-12)

    def test_the_scene_gives_duration_step_and_integrator_and_options_outrank_it(self):
        head = 'duration = 0.25\nstep = 0.05\nintegrator = "verlet"\ngravity = [0, 0, -1]\n'
        answer = self.run_scene(head + BALL)
        self.assertEqual((answer["integrator"], answer["step"], answer["steps"]), ("verlet", 0.05, 5))
        self.close(answer["samples"][-1]["links"]["ball"]["linear_velocity"], [1, 2, 2.75])
        answer = self.run_scene(head + BALL, "--duration", 1, "--step", 0.1, "--integrator", "rk4",
                                "--gravity", "0,0,-2")
        self.assertEqual((answer["integrator"], answer["step"], answer["steps"]), ("rk4", 0.1, 10))
        self.close(answer["samples"][-1]["links"]["ball"]["linear_velocity"], [1, 2, 1])

    def test_a_moved_body_goes_its_way_and_weighs_nothing(self):
        answer = self.run_scene(BALL.replace("mass = 2", "motion = { linear = [1, 0, 0], angular = [0, 0, 2] }")
                                .replace("linear_velocity = [1, 2, 3]", "")
                                .replace("angular_velocity = [0, 0, 4]", ""), "--duration", 0.5)
        ball = answer["samples"][-1]["links"]["ball"]
        self.close(ball["position"], [0.5, 0, 1], 1e-12)
        self.close(ball["rotation"][0], [math.cos(1), -math.sin(1), 0], 1e-12)
        self.assertEqual(answer["samples"][-1]["kinetic_energy"], 0)

    def test_a_pendulum_on_a_shaken_base_follows_the_equation_of_kapitza(self):
        """theta'' = m r (g + y'') sin theta / I from the upright, y = a sin w t; integrated here by Runge-Kutta."""
        m, r, inertia = 2, 0.3, 0.05 + 2 * 0.3 ** 2
        a, f, start = 0.02, 40, 0.3
        w = 2 * math.pi * f

        def rate(t, x):
            return x[1], m * r * (9.81 - a * w * w * math.sin(w * t)) * math.sin(x[0]) / inertia

        x, steps, end = (start, 0.0), 20000, 0.5
        for n in range(steps):
            h, t = end / steps, n * end / steps
            k1 = rate(t, x)
            k2 = rate(t + h / 2, (x[0] + h / 2 * k1[0], x[1] + h / 2 * k1[1]))
            k3 = rate(t + h / 2, (x[0] + h / 2 * k2[0], x[1] + h / 2 * k2[1]))
            k4 = rate(t + h, (x[0] + h * k3[0], x[1] + h * k3[1]))
            x = tuple(x[i] + h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]) for i in range(2))
        urdf = robot('<link name="base"/>', link("rod", mass=m, com=(0, 0, r), inertia=(0.05, 0, 0, 0.05, 0, 0.01)),
                     joint("hinge", "continuous", "base", "rod", axis="0 1 0"))
        shaken = f"motion = {{ amplitude = [0, 0, {a}], frequency = {f} }}\n"
        answer = self.run_scene(arm("arm", f"q = {{ hinge = {start} }}\n{shaken}"), "--duration", end, "--step", 1e-4,
                                "--integrator", "rk4", urdf=urdf)
        self.assertAlmostEqual(answer["samples"][-1]["q"]["hinge"], x[0], delta=1e-7)
        self.assertLess(abs(x[0]), 0.4)  # it stays upright: a w > sqrt(2 g I / (m r))

    def test_an_oscillating_motion_is_a_sine_with_its_velocity(self):
        f, angle = 1.5, 0.4
        answer = self.run_scene(
            BALL.replace("mass = 2", f"motion = {{ linear = [1, 0, 0], amplitude = [0, 0.1, 0], "
                                     f"swing = [0, 0, {angle}], frequency = {f} }}")
            .replace("linear_velocity = [1, 2, 3]", "").replace("angular_velocity = [0, 0, 4]", ""),
            "--duration", 0.3, "--at", "0,0.1,0.25")
        w = 2 * math.pi * f
        start = answer["samples"][0]["links"]["ball"]["position"]
        for sample in answer["samples"]:
            t, ball = sample["t"], sample["links"]["ball"]
            self.close(ball["position"], add(start, [t, 0.1 * math.sin(w * t), 0]))
            self.close(ball["linear_velocity"], [1, 0.1 * w * math.cos(w * t), 0])
            turned = angle * math.sin(w * t)
            self.close(ball["rotation"][0], [math.cos(turned), -math.sin(turned), 0])
            self.close(ball["angular_velocity"], [0, 0, angle * w * math.cos(w * t)])

    def test_a_motion_that_oscillates_needs_its_frequency_and_one_kind_of_rotation(self):
        for law, where in (("amplitude = [0, 0, 1]", "frequency"), ("frequency = 2", "frequency"),
                           ("swing = [1, 0, 0], angular = [1, 0, 0], frequency = 2", "swing")):
            faults = self.refusals(arm("arm", f"motion = {{ {law} }}"), "--duration", 1)
            self.assertEqual([fault["where"] for fault in faults], [f"robot 'arm', motion, {where}"])

    def test_each_of_several_robots_moves_as_it_would_alone(self):
        swing = robot('<link name="base"/>', link("rod"), joint("hinge", "continuous", "base", "rod", axis="0 1 0"))
        off = "collide = false"
        both = self.run_scene(arm("a", off + "\nq = { hinge = 0.3 }") +
                              arm("b", off + "\nposition = [0, 5, 0]\nqd = { hinge = -2 }") + BALL,
                              "--duration", 0.3, urdf=swing)
        self.assertEqual(both["joints"], ["a/hinge", "b/hinge"])
        for name, state in (("a", {"q": {"hinge": 0.3}}), ("b", {"qd": {"hinge": -2}})):
            alone = self.answer(swing, "--duration", 0.3, state=state)["samples"][-1]
            sample = both["samples"][-1]
            self.close(sample["q"][name + "/hinge"], alone["q"]["hinge"], 1e-12)
            self.close(sample["qd"][name + "/hinge"], alone["qd"]["hinge"], 1e-12)
            self.close(sample["links"][name + "/rod"]["rotation"], alone["links"]["rod"]["rotation"], 1e-12)
        self.assertEqual(sorted(both["samples"][0]["links"]), ["a/base", "a/rod", "b/base", "b/rod", "ball"])

    def test_a_floating_robot_alone_has_its_base_as_in_a_state_file(self):
        urdf = robot(link("body", 2, (0, 0, 0), (1, 0, 0, 1, 0, 1)))
        answer = self.run_scene(arm("r", 'base = "floating"\nposition = [1, 0, 0]\nlinear_velocity = [0, 3, 0]'),
                                "--duration", 1, "--integrator", "rk4", urdf=urdf)
        self.close(answer["samples"][-1]["base"]["position"], [1, 3, -9.81 / 2], 1e-12)

    def test_a_state_file_changes_the_start_and_pushes_bodies(self):
        state = {"q": {"hinge": 0.7}, "wrenches": [{"link": "ball", "point": [0, 0, 1], "force": [4, 0, 0]}]}
        answer = self.run_scene(arm("r", "qd = { hinge = 0.5 }") + BALL, "--duration", 1,
                                "--integrator", "rk4", state=state)
        self.close(answer["samples"][0]["q"]["hinge"], 0.7)
        self.close(answer["samples"][-1]["q"]["hinge"], 1.2, 1e-12)
        self.close(answer["samples"][-1]["links"]["ball"]["linear_velocity"][0], 3, 1e-12)
        self.close(answer["energy_balance"]["wrench/0"], 4 * 2, 1e-10)

    def test_the_table_shows_where_the_bodies_are(self):
        table = self.twinarm("simulate", self.write("scene.toml", BALL), "--duration", 1).stdout
        self.assertIn("ball/x [m]", table)


class Couplings(Scenes):
    def test_an_implicit_spring_on_one_joint_is_backward_euler(self):
        k, b, h = 3e4, 20.0, 0.01
        answer = self.run_scene(arm("r", "q = { hinge = 0.1 }") +
                                coupling(f"stiffness = {k}\ndamping = {b}\n" "target = { q = { hinge = -0.2 } }"),
                                "--duration", 0.2, "--step", h, "--every", h)
        x, v = 0.1, 0.0
        for sample in answer["samples"][1:]:
            v = (v + h * k / HINGE_INERTIA * (-0.2 - x)) / (1 + h * b / HINGE_INERTIA + h * h * k / HINGE_INERTIA)
            x += h * v
            self.close([sample["q"]["hinge"], sample["qd"]["hinge"]], [x, v], 1e-12)
            self.assertEqual(sample["targets"]["pull"]["q"], {"hinge": -0.2})

    def test_the_energy_balance_separates_spring_damper_and_discretization(self):
        text = (arm("r", "q = { hinge = 0.1 }") +
                coupling("stiffness = 800\ndamping = 3\ntarget = { q = { hinge = 0 } }\n"
                         'discretization = "TREATMENT"'))
        exact = self.run_scene(text.replace("TREATMENT", "explicit"), "--duration", 0.3,
                               "--integrator", "dopri5", "--tolerance", 1e-12)
        change = self.balanced(exact)
        rows, end = exact["energy_balance"], exact["samples"][-1]
        self.close(rows["coupling/pull/spring"], 400 * (0.1 ** 2 - end["q"]["hinge"] ** 2), 1e-10)
        self.close(rows["numerical"], 0, 1e-9)
        self.assertLess(rows["coupling/pull/damper"], 0)
        self.assertNotIn("coupling/pull/implicit", rows)
        self.assertEqual(exact["input_work"], {"pull": 0})
        self.assertGreater(abs(change), 0.01)
        for discretization in ("implicit", "semi-implicit"):
            answer = self.run_scene(text.replace("TREATMENT", discretization), "--duration", 0.3)
            self.balanced(answer)
            rows, end = answer["energy_balance"], answer["samples"][-1]
            # On one joint without other forces all that happens is the coupling's doing.
            self.close(rows["numerical"], 0, 1e-12)
            self.close(rows["coupling/pull/spring"], 400 * (0.1 ** 2 - end["q"]["hinge"] ** 2), 1e-10)
            if discretization == "implicit":  # both at the end of the step: backward Euler only takes
                lost, x, v, h = 0.0, 0.1, 0.0, 0.001
                for _ in range(300):
                    dv = -h * (800 * x + (3 + 800 * h) * v) / (HINGE_INERTIA + 3 * h + 800 * h * h)
                    v += dv
                    x += h * v
                    lost += HINGE_INERTIA * dv * dv / 2 + 800 * (h * v) ** 2 / 2
                self.close(rows["coupling/pull/implicit"], -lost - 3 * h * v * v / 2, 1e-12)

    def test_the_hand_puts_in_what_spring_and_damper_and_robot_take(self):
        # At an even speed of the target: hand = the robot's and the spring's energy and the losses.
        self.write("hand.csv", STEADY_HAND)
        answer = self.run_scene(arm("r") + coupling('stiffness = 50\ndamping = 1\n'
                                                    'discretization = "explicit"\ntarget = "hand.csv"'),
                                "--duration", 0.7, "--integrator", "rk4")
        last = answer["samples"][-1]
        self.close(last["targets"]["pull"]["q"]["hinge"], 0.7, 1e-12)  # gain 2 of theta1
        e, de = 0.7 - last["q"]["hinge"], 1 - last["qd"]["hinge"]
        a = 1 / HINGE_INERTIA  # e'' + a e' + 50 a e = 0, e(0) = 0, e'(0) = 1
        w = math.sqrt(50 * a - a * a / 4)
        self.close(e, math.exp(-a * 0.35) * math.sin(w * 0.7) / w, 1e-8)
        rows = answer["energy_balance"]
        work = rows["coupling/pull/spring"] + rows["coupling/pull/damper"]
        self.close(rows["numerical"], 0, 1e-8)
        # Power of hand + power on the robot = -(d/dt) of the spring's energy - b de^2.
        lost = answer["input_work"]["pull"] - work - 25 * e * e
        n = 20000
        times = [(i + 0.5) * 0.7 / n for i in range(n)]
        rates = [math.exp(-a * t / 2) * (math.cos(w * t) - a / (2 * w) * math.sin(w * t)) for t in times]
        self.close(lost, sum(r * r for r in rates) * 0.7 / n, 1e-6)
        self.close(de, math.exp(-a * 0.35) * (math.cos(w * 0.7) - a / (2 * w) * math.sin(w * 0.7)), 1e-8)

    def test_samples_between_the_steps_do_not_change_a_run_with_a_held_force(self):
        text = (arm("r", "q = { hinge = 0.5 }") +
                coupling('stiffness = 40\ndamping = 2\nrate = 100\ntarget = { q = { hinge = 0 } }'))
        plain = self.run_scene(text, "--duration", 0.5)
        asked = self.run_scene(text, "--duration", 0.5, "--at", "0.00123,0.0155,0.25004,0.5")
        self.assertEqual(asked["samples"][-1], plain["samples"][-1])
        self.assertEqual(asked["energy_balance"], plain["energy_balance"])

    def test_the_papers_motion_moves_the_target_of_the_s103(self):
        answer = self.run_scene(data("s103_paper.toml"), "--duration", 1, "--at", "0.25,1")
        sample = answer["samples"][0]
        target = sample["targets"]["coupling1"]
        self.close([target["q"]["joint1"], target["q"]["joint2"]], [math.pi / 4, -math.pi / 8])
        self.close([target["qd"]["joint1"], target["qd"]["joint2"]], [-math.pi, math.pi / 2])
        # The arm is not far behind.
        self.assertLess(abs(sample["q"]["joint1"] - math.pi / 4), 0.05)
        a, b = math.pi / 4, math.pi / 4 - math.pi / 8
        self.close(target["position"][:2], [0.25 * math.cos(a) + 0.35 * math.cos(b),
                                            0.25 * math.sin(a) + 0.35 * math.sin(b)], 1e-12)
        self.assertGreater(answer["input_work"]["coupling0"], 0)


class Touching(Scenes):
    def test_a_stack_stands_and_its_forces_are_its_weight(self):
        answer = self.answer("assets/scenes/box_stack.toml")
        self.assertEqual(answer["contacts"], 40)
        first, last = answer["samples"][0]["links"], answer["samples"][-1]["links"]
        for name, start in first.items():
            for before, after in zip(start["position"], last[name]["position"]):
                self.assertLess(abs(after - before), 1e-6)

    def test_a_linkage_of_seven_hinges_keeps_its_energy(self):
        answer = self.answer("assets/scenes/four_bar.toml", "--duration", 2)
        energy = [s["kinetic_energy"] + s["potential_energy"] for s in answer["samples"]]
        self.assertLess(abs(energy[-1] - energy[0]), 1e-8 * energy[0])


# Side by side on one floor of 3e5 N/m: springs in series by hand, k = 1 / (1/3e5 + 1/k_ball).
SOFT = data("soft_floor.toml")


class Compliance(Scenes):
    def depth(self, answer, name):
        return 0.1 - answer["samples"][-1]["links"][name]["position"][2]

    def test_each_ball_rests_m_g_over_the_stiffness_of_its_pair_deep(self):
        answer = self.run_scene(SOFT)
        for name, mass, k in (("tyre", 2, 5e4), ("steel", 3, 3e7 / 101), ("paired", 1, 1e4)):
            expected = mass * 9.81 / k
            self.close(self.depth(answer, name), expected, 1e-6 * expected, name)

    def test_the_command_line_outranks_the_response_of_the_scene(self):
        rigid = self.run_scene(SOFT, "--contact", "rigid")
        for name in ("tyre", "steel", "paired"):
            self.close(self.depth(rigid, name), 0, 1e-9, name)
        soft = self.run_scene(SOFT.replace('"compliant"', '"rigid"'), "--contact", "compliant")
        self.assertEqual(soft["samples"], self.run_scene(SOFT)["samples"])


class DeepStart(Scenes):
    """Bodies that overlap at the start: a warning; they are separated slowly."""
    BALLS = data("deep_start.toml")

    def test_the_deepest_pair_is_named_on_stderr_with_its_depth(self):
        result = self.simulate(self.BALLS)
        self.assertEqual(result.returncode, 0)
        warning = [line for line in result.stderr.splitlines() if "warning" in line]
        self.assertEqual(len(warning), 1, result.stderr)
        self.assertIn("initial penetration of 'one' and 'two': 0.05 m", warning[0])
        self.assertIn("at 0.5 m/s or less", warning[0])
        self.assertIn("'one' and 'two'", json.loads(result.stdout)["warnings"][0])
        self.assertEqual(self.simulate(self.BALLS.replace("0.15", "0.2001").replace("-0.09", "-1")).stderr, "")

    def test_bodies_part_slowly(self):
        for gravity in ("[0, 0, 0]", "[0, 0, -9.81]"):
            answer = self.run_scene(self.BALLS.replace("[0, 0, 0]", gravity, 1), "--every", 0.001)
            samples = answer["samples"]

            def speed(sample):
                return max(math.hypot(*sample["links"][name]["linear_velocity"]) for name in ("one", "two"))
            self.assertLess(max(map(speed, samples)), 0.02)
            self.assertLess(max(s["kinetic_energy"] for s in samples), 1e-3)
            last = samples[-1]["links"]
            apart = last["two"]["position"][0] - last["one"]["position"][0]
            self.assertGreater(apart, 0.2 - 1e-4)
            self.assertLess(apart, 0.2 + 1e-3)
            for name in ("one", "two"):
                self.assertGreater(last[name]["position"][2], 0.01 - 1e-4)
                self.assertLess(last[name]["position"][2], 0.01 + 1e-3)


class Located(Scenes):
    FALL = data("bouncing_ball.toml")

    def test_a_bouncing_ball_is_where_it_should_be_whatever_the_step(self):
        speed, t = math.sqrt(2 * 9.81), 1.0  # after the first impact, before the second
        first = speed / 9.81
        height = 0.8 * speed * (t - first) - 9.81 * (t - first) ** 2 / 2
        for step in (0.001, 0.3):
            answer = self.run_scene('contact = "event"\n' + self.FALL, "--duration", 4.5,
                                    "--step", step, "--at", "1,4.5")
            ball = answer["samples"][0]["links"]["ball"]
            self.assertAlmostEqual(ball["position"][2], 0.1 + height, delta=1e-9)
            self.assertAlmostEqual(ball["position"][0], 1, delta=1e-9)
            rest = answer["samples"][1]["links"]["ball"]
            self.assertAlmostEqual(rest["position"][2], 0.1, delta=1e-9)
            energy_balance = answer["energy_balance"]
            self.assertAlmostEqual(energy_balance["gravity"], 2 * 9.81, delta=1e-8)
            self.assertAlmostEqual(energy_balance["contact/ball-floor/impact"], -2 * 9.81, delta=1e-6)
            self.assertAlmostEqual(energy_balance["numerical"], 0, delta=1e-8)

    def test_the_command_line_outranks_the_file(self):
        answer = self.run_scene(self.FALL, "--duration", 1, "--step", 0.5, "--contact", "event")
        speed, first = math.sqrt(2 * 9.81), math.sqrt(2 / 9.81)
        velocity = answer["samples"][-1]["links"]["ball"]["linear_velocity"]
        self.assertAlmostEqual(velocity[2], 0.8 * speed - 9.81 * (1 - first), delta=1e-7)

    def test_bodies_in_one_another_are_refused(self):
        words = self.refused("scene.deep", "contact", 0, 'contact = "event"\n' +
                             self.FALL.replace("1.1", "0.09"), "--duration", 1)
        for part in ("'ball'", "'floor'", "0.01 m"):
            self.assertIn(part, words)


class Flight(Scenes):
    def test_a_body_alone_in_its_scene_keeps_its_energy_and_angular_momentum_however_fast_it_spins(self):
        spin, floor = data("spinning_rod.toml"), data("floor.toml", offset=-100)
        samples = self.run_scene(spin, "--duration", 5, "--every", 1)["samples"]
        beside = self.run_scene(spin + floor, "--duration", 5, "--every", 1)["samples"]
        for alone, other in zip(samples, beside):
            self.assertAlmostEqual(alone["kinetic_energy"], 1.27875, delta=1e-9)
            self.assertEqual(alone["links"]["rod"], other["links"]["rod"])


class Refused(Scenes):
    def test_meshes_that_may_touch_have_a_bound_on_their_triangles(self):
        (self.folder / "torus.stl").write_bytes(torus(276))  # two of them have more than 300,000
        mesh = '[[body]]\nname = "{0}"\nfixed = true\nposition = [{0}0, 0, 0]\n' \
               'shape = {{ mesh = {{ file = "torus.stl", convex = false }} }}\n'
        once = "--duration", 0.001
        scene = BALL + mesh.format(1)
        self.run_scene(scene, *once)
        problem = self.refused("scene.too-many", "", 0, scene + mesh.format(2), *once)
        self.assertIn("convex = true", problem)

    def test_a_step_of_the_scene_without_end_is_reported_by_its_key(self):
        self.refused("run.too-many-steps", "step", 0, f"step = 1e-11\n{BALL}", "--duration", "1")

    def test_an_implicit_coupling_takes_both_semi_implicit_integrators(self):
        for name in ("semi-implicit", "semi-implicit-xv"):
            self.run_scene(arm("r") + coupling("stiffness = 1"), "--duration", 0.1, "--integrator", name)


if __name__ == "__main__":
    main()
