"""`twinarm simulate`: closed-form motions, samples, CSV and table."""
import csv
import io
import math

from program import main
from robot_command import (PENDULUM, RobotCommand, add, cross, dot, from_quaternion, joint, link,
                           robot, scale, times, unit)

LEVEL = {"q": {"hinge": math.pi / 2}}
INTEGRATORS = {"euler": -1.4542586468839336, "semi-implicit": -1.4140239721507901,
               "semi-implicit-xv": -1.3960306392957011, "verlet": -1.405085873500597,
               "midpoint": -1.4052124376524113, "heun": -1.4051560758049801,
               "rk4": -1.4050273031405154, "implicit-midpoint": -1.4049687399868869,
               "trapezoid": -1.4049101749531139, "implicit-euler": -1.3557749142852238}


class Motions(RobotCommand):
    command = "simulate"

    def end(self, answer):
        return answer["samples"][-1]

    def test_a_pendulum_from_90_degrees_follows_the_elliptic_functions(self):
        exact = {1: (-1.4050273115247991, -1.7993090169070786), 2: (0.91664758966324498, 3.4552068990593298),
                 5: (1.2294518114853856, -2.5627875681926295), 10: (0.27868067356998295, -4.3431606928646831)}
        for options in (["--integrator", "rk4", "--step", "0.001"], ["--integrator", "dopri5", "--tolerance", "1e-12"]):
            answer = self.answer(PENDULUM, "--duration", 10, "--at", "1,2,5,10", *options, state=LEVEL)
            self.assertEqual([sample["t"] for sample in answer["samples"]], [1, 2, 5, 10])
            for sample in answer["samples"]:
                theta, rate = exact[sample["t"]]
                self.close([sample["q"]["hinge"], sample["qd"]["hinge"]], [theta, rate], 1e-9)
                self.close(sample["links"]["bob"]["rotation"][0], [math.cos(theta), 0, -math.sin(theta)], 1e-9)
            self.close(answer["energy_balance"]["numerical"], 0, 1e-9)

    def test_every_integrator_has_its_own_recurrence_to_rounding(self):
        for name, theta in INTEGRATORS.items():
            answer = self.answer(PENDULUM, "--duration", 1, "--step", 0.01, "--integrator", name, state=LEVEL)
            self.close(self.end(answer)["q"]["hinge"], theta, 1e-12, name)
            self.assertEqual((answer["integrator"], answer["step"], answer["steps"]), (name, 0.01, 100))
            self.assertIn(name, self.run_it("--help").stdout)

    def test_the_default_is_the_semi_implicit_method_with_a_step_of_a_millisecond(self):
        answer = self.answer(PENDULUM, "--duration", 0.1)
        self.assertEqual((answer["integrator"], answer["step"], answer["steps"]), ("semi-implicit", 0.001, 100))
        self.assertEqual([sample["t"] for sample in answer["samples"]], [0, 0.1])

    def test_a_thrown_body_flies_on_a_parabola_and_turns_evenly_about_a_principal_axis(self):
        urdf = robot(link("body", 2, (0, 0, 0), (0.1, 0, 0, 0.2, 0, 0.3)))
        v, w, turn = [1.0, -2.0, 3.0], 4.0, unit([0.9, 0.1, -0.3, 0.2])
        spin = times(from_quaternion(turn), [0, 0, w])
        state = {"base": {"position": [0, 1, 2], "orientation": turn, "linear_velocity": v, "angular_velocity": spin}}
        answer = self.answer(urdf, "--floating", "--duration", 1.5, "--integrator", "rk4", "--step", 0.01, state=state)
        self.assertEqual(answer["joints"], [])
        sample, t = self.end(answer), 1.5
        self.close(sample["base"]["position"], add([0, 1, 2], scale(t, v), [0, 0, -9.81 * t * t / 2]))
        self.close(sample["base"]["linear_velocity"], add(v, [0, 0, -9.81 * t]))
        self.close(sample["base"]["angular_velocity"], spin)
        half = w * t / 2
        a, b = turn, [math.cos(half), 0, 0, math.sin(half)]  # turns further about its own z
        turned = [a[0] * b[0] - dot(a[1:], b[1:]), *add(scale(a[0], b[1:]), scale(b[0], a[1:]), cross(a[1:], b[1:]))]
        self.close(from_quaternion(sample["base"]["orientation"]), from_quaternion(turned))
        self.close(answer["energy_balance"]["gravity"], -2 * 9.81 * (3 * t - 9.81 * t * t / 2))
        self.close(answer["energy_balance"]["numerical"], 0, 1e-12)

    def test_the_end_of_a_run_can_be_the_state_of_the_next(self):
        urdf = robot(link("body"), link("arm"), joint("ball", "spherical", "body", "arm"),
                     joint("slide", "prismatic", "arm", "tip"), link("tip"))
        options = ["--floating", "--integrator", "rk4", "--step", 0.01]
        state = {"qd": {"ball": [1, 2, 3]}, "base": {"angular_velocity": [0, 1, 0]}}
        half = self.end(self.answer(urdf, *options, "--duration", 0.5, state=state))
        again = self.answer(urdf, *options, "--duration", 0.5, state={key: half[key] for key in ("q", "qd", "base")})
        whole = self.answer(urdf, *options, "--duration", 1, state=state)
        for key in ("q", "qd", "base"):
            self.close([*self.end(again)[key].values()], [*self.end(whole)[key].values()], 1e-11)

    def test_the_energy_balance_of_an_undamped_double_pendulum_closes_and_shows_what_a_method_creates(self):
        """Two rods let go from the level, 10 s: chaotic, and nothing may take or give energy."""
        rod = lambda name: link(name, 1, (0, 0, -0.5), (1 / 12, 0, 0, 1 / 12, 0, 1e-4))
        urdf = robot('<link name="base"/>', rod("a"), rod("b"), joint("first", "continuous", "base", "a", axis="0 1 0"),
                     joint("second", "continuous", "a", "b", xyz="0 0 -1", axis="0 1 0"))
        start = {"q": {"first": math.pi / 2, "second": 0}}
        run = lambda *options: self.answer(urdf, "--duration", 10, "--every", 0.01, *options, state=start)
        exact = run("--integrator", "dopri5", "--tolerance", "1e-11")
        most = max(sample["kinetic_energy"] for sample in exact["samples"])
        self.assertGreater(most, 10)
        self.assertLess(abs(exact["energy_balance"]["numerical"]), 1e-9 * most)
        for sample in exact["samples"]:
            self.assertLess(abs(sample["kinetic_energy"] + sample["potential_energy"] -
                                exact["samples"][0]["potential_energy"]), 1e-9 * most)
        # Semi-implicit Euler's row is what its states have gained, as it is.
        rough = run("--step", "0.001")
        first, last = rough["samples"][0], rough["samples"][-1]
        gained = (last["kinetic_energy"] + last["potential_energy"] - first["kinetic_energy"] -
                  first["potential_energy"])
        self.assertLess(abs(rough["energy_balance"]["numerical"] - gained), 1e-11 * most)
        self.assertGreater(abs(gained), 1e-5)

    def test_a_mimic_joint_keeps_its_ratio_along_the_run(self):
        urdf = robot('<link name="base"/>', link("a"), link("b"),
                     joint("lead", "continuous", "base", "a", axis="0 1 0"),
                     joint("follow", "continuous", "a", "b", xyz="0.3 0 0", axis="0 1 0",
                           more='<mimic joint="lead" multiplier="-0.5" offset="0.1"/>'))
        answer = self.answer(urdf, "--duration", 1, "--every", 0.25, "--integrator", "rk4", state={"qd": {"lead": 2}})
        for sample in answer["samples"]:
            theta = 0.5 * sample["q"]["lead"] + 0.1  # of b in the world
            self.close(sample["links"]["b"]["rotation"][0], [math.cos(theta), 0, math.sin(theta)])
        self.close(answer["energy_balance"]["numerical"], 0, 1e-9)


class Samples(RobotCommand):
    command = "simulate"

    def test_samples_between_the_steps_do_not_change_the_run(self):
        for integrator in [*INTEGRATORS, "dopri5"]:
            options = ["--duration", 1, "--integrator", integrator]
            options += [] if integrator == "dopri5" else ["--step", 0.01]
            urdf = PENDULUM.replace("</joint>", '<dynamics damping="0.1" friction="0.2"/></joint>')
            plain = self.answer(urdf, *options, state=LEVEL)
            asked = self.answer(urdf, *options, "--at", "0,0.0123,0.3,0.30001,0.9999,1", state=LEVEL)
            self.assertEqual([s["t"] for s in asked["samples"]], [0, 0.0123, 0.3, 0.30001, 0.9999, 1])
            self.assertEqual(asked["samples"][0], plain["samples"][0], integrator)
            self.assertEqual(asked["samples"][-1], plain["samples"][-1], integrator)
            self.assertEqual(asked["energy_balance"], plain["energy_balance"], integrator)
            if integrator != "dopri5":
                on_grid = self.answer(urdf, *options, "--every", 0.1, state=LEVEL)["samples"]
                self.assertEqual(asked["samples"][2]["q"], on_grid[3]["q"], integrator)

    def test_every_includes_the_start_and_the_end_and_a_last_step_may_be_shorter(self):
        answer = self.answer(PENDULUM, "--duration", 0.0105, "--every", 0.004, state=LEVEL)
        self.assertEqual([s["t"] for s in answer["samples"]], [0, 0.004, 0.008, 0.0105])
        self.assertEqual(answer["steps"], 11)
        answer = self.answer(PENDULUM, "--duration", 0.3, "--every", 0.1, state=LEVEL)
        self.assertEqual(len(answer["samples"]), 4)
        self.assertEqual(answer["steps"], 300)

    def test_csv_has_a_header_with_units_and_a_row_a_sample(self):
        result = self.run_it(PENDULUM, "--duration", 0.2, "--every", 0.1, "--csv", "--floating", "--gravity", "0,0,0",
                             state={"base": {"linear_velocity": [1, 0, 0]}, "qd": {"hinge": 0}})
        self.assertEqual(result.returncode, 2)  # a base without mass cannot float
        urdf = robot(link("body", 1, (0, 0, 0)), link("arm"), joint("j,1", "continuous", "body", "arm"))
        result = self.run_it(urdf, "--duration", 0.2, "--every", 0.1, "--csv", "--floating",
                             "--gravity", "0,0,0", state={"base": {"linear_velocity": [1, 0, 0]}})
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = list(csv.DictReader(io.StringIO(result.stdout)))
        self.assertEqual([float(row["t[s]"]) for row in rows], [0, 0.1, 0.2])
        self.close(float(rows[2]["q/base/x[m]"]), 0.2)
        self.close(float(rows[2]["links/arm/x[m]"]), 0.2)
        self.assertEqual(float(rows[2]["qd/base/x[m/s]"]), 1)
        self.assertEqual(float(rows[0]["q/base/turn_w[1]"]), 1)
        self.assertEqual(float(rows[0]["q/j,1[rad]"]), 0)
        self.assertTrue(all(None not in row and None not in row.values() for row in rows))

    def test_without_json_or_csv_there_is_a_table_with_units(self):
        out = self.run_it(PENDULUM, "--duration", 0.2, "--every", 0.1, state=LEVEL).stdout
        for word in ("t [s]", "hinge [rad]", "kinetic [J]", "gravity", "numerical"):
            self.assertIn(word, out)

    def test_the_table_says_what_it_leaves_out(self):
        out = self.run_it("assets/scenes/box_stack.toml", "--duration", 0.001).stdout
        self.assertIn(" 1 step of ", out)
        self.assertIn("(7 of 10 bodies are not shown: --csv and --json have them all)", out)
        # Boxes push only their neighbours and the floor: nothing else has a row of momentum.
        for line in out.split("momentum, 0 to")[1].splitlines():
            if line.startswith("contact/"):
                self.assertTrue(any(float(n) for n in line.split()[1:]), line)


if __name__ == "__main__":
    main()
