"""`twinarm simulate`: the energy balance, runs that stop, faults."""
import json
import math
import sys

from program import main
from robot_command import (COM, MASS, PENDULUM, RobotCommand, add, cross, dot, from_quaternion, link, robot, scale,
                           slider, times)

LEVEL = {"q": {"hinge": math.pi / 2}}


class Joules(RobotCommand):
    command = "simulate"

    def test_work_of_a_motor_and_of_damping_is_that_of_the_closed_form(self):
        m, c, F, T = 2.0, 0.8, 3.0, 1.7
        tau = m / c
        v = F / c * (1 - math.exp(-T / tau))
        x = F / c * (T - tau * (1 - math.exp(-T / tau)))
        for integrator, tolerance in (("rk4", 1e-11), ("dopri5", 1e-8), ("verlet", 1e-6)):
            answer = self.answer(slider(damping=c), "--duration", T, "--integrator", integrator,
                                 state={"tau": {"slide": F}})
            sample, energy_balance = answer["samples"][-1], answer["energy_balance"]
            self.close([sample["q"]["slide"], sample["qd"]["slide"]], [x, v], tolerance)
            self.assertEqual(list(energy_balance), ["gravity", "actuator/slide", "joint/slide/damping", "numerical"])
            self.close(energy_balance["actuator/slide"], F * x, tolerance)
            self.close(energy_balance["joint/slide/damping"], m * v * v / 2 - F * x, tolerance)
            self.close(energy_balance["numerical"], 0, tolerance, integrator)
            self.close(sum(energy_balance.values()), sample["kinetic_energy"], 1e-12)

    def test_friction_takes_all_that_a_sliding_block_has_and_holds_it_then(self):
        m, f, v = 2.0, 1.5, 3.0
        for integrator in ("rk4", "semi-implicit", "dopri5"):
            answer = self.answer(slider(friction=f), "--duration", 6, "--integrator", integrator,
                                 state={"qd": {"slide": v}})
            sample = answer["samples"][-1]
            self.assertEqual(sample["qd"]["slide"], 0, integrator)
            tolerance = 1e-9 if integrator == "rk4" else 2e-3
            self.close(sample["q"]["slide"], m * v * v / 2 / f, tolerance, integrator)
            self.close(sum(answer["energy_balance"].values()), -m * v * v / 2, 1e-12, integrator)
        kept = self.answer(slider(friction=f), "--no-friction", "--duration", 1, state={"qd": {"slide": v}})
        self.assertEqual(kept["samples"][-1]["qd"]["slide"], v)
        self.assertNotIn("joint/slide/friction", kept["energy_balance"])

    def test_a_world_wrench_keeps_its_direction_and_stays_with_its_point_of_the_link(self):
        urdf = robot(link("body"))
        force, torque, at = [1.0, 2.0, -0.5], [0.3, 0, 0.2], [0.4, 0.1, 0.2]
        wrench = {"link": "body", "point": at, "force": force}
        state = {"base": {"angular_velocity": [1, -2, 0.5]}, "wrenches": [wrench]}
        options = ["--floating", "--gravity", "0,0,0", "--duration", 1, "--integrator", "rk4"]
        answer = self.answer(urdf, *options, state=state)
        base = answer["samples"][-1]["base"]
        point = add(base["position"], times(from_quaternion(base["orientation"]), at))
        self.close(answer["energy_balance"]["wrench/0"], dot(force, add(point, scale(-1, at))), 1e-10)
        self.close(answer["energy_balance"]["numerical"], 0, 1e-10)

        # Momentum grows by force times time.
        com = answer["samples"][-1]["links"]["body"]
        v = add(com["linear_velocity"], cross(com["angular_velocity"], times(com["rotation"], list(COM))))
        first = answer["samples"][0]["links"]["body"]
        v0 = cross(first["angular_velocity"], list(COM))
        self.close(scale(MASS, add(v, scale(-1, v0))), force, 1e-10)

        state["wrenches"] = [{"link": "body", "frame": "link", "point": at, "force": force, "torque": torque}]
        turning = self.answer(urdf, *options, state=state)
        self.close(turning["energy_balance"]["numerical"], 0, 1e-9)
        self.assertGreater(abs(turning["energy_balance"]["wrench/0"] - answer["energy_balance"]["wrench/0"]), 0.1)

    def test_the_remainder_is_the_error_of_the_integrator(self):
        for name, sign in (("euler", 1), ("implicit-euler", -1)):
            answer = self.answer(PENDULUM, "--duration", 2, "--step", 0.01, "--integrator", name, state=LEVEL)
            first, last = answer["samples"][0], answer["samples"][-1]

            def energy(sample):
                return sample["kinetic_energy"] + sample["potential_energy"]
            self.close(answer["energy_balance"]["numerical"], energy(last) - energy(first))
            self.assertGreater(sign * answer["energy_balance"]["numerical"], 0.1)


class Ends(RobotCommand):
    command = "simulate"

    def test_a_run_that_diverges_ends_with_3_and_tells_where_it_began(self):
        m, c, h = 2.0, 1e5, 0.001
        growth = abs(1 - c * h / m)  # of the velocity in a step of explicit Euler
        steps = math.log(sys.float_info.max) / math.log(growth)
        options = ["--duration", 1, "--integrator", "euler", "--step", h, "--energy-bound", "inf",
                   "--post-mortem", self.folder / "last.twinrec"]
        for more in (["--json"], []):
            result = self.run_it(slider(damping=c), *options, *more, state={"qd": {"slide": 1}})
            self.assertEqual(result.returncode, 3, result.stderr)
            self.assertIn("'slide'", result.stderr)
            if not more:
                continue
            answer = json.loads(result.stdout, parse_constant=self.fail)
            post_mortem = answer["post_mortem"]
            self.close(post_mortem["time"], h * steps, 0.02)
            self.close(post_mortem["step"], steps, 0.02)
            self.assertEqual(post_mortem["fastest_joint"], "slide")
            self.assertTrue(post_mortem["body"])
            self.assertTrue(post_mortem["field"])
            self.assertEqual([sample["t"] for sample in answer["samples"]], [0])
        for integrator in ("semi-implicit", "implicit-euler", "dopri5"):
            still = self.answer(slider(damping=c), "--duration", 0.01, "--integrator", integrator,
                                state={"qd": {"slide": 1}})
            self.assertLess(abs(still["samples"][-1]["qd"]["slide"]), 1)

    def test_a_joint_beyond_its_limits_is_warned_of_once(self):
        urdf = slider(more='<limit lower="-1" upper="1" effort="1" velocity="1"/>')
        answer = self.answer(urdf, "--duration", 2, state={"qd": {"slide": 1}})
        self.assertEqual(len([w for w in answer["warnings"] if "limits" in w]), 1)
        self.close(answer["samples"][-1]["q"]["slide"], 2)

    def test_energies_beyond_the_range_of_numbers_are_warned_of(self):
        """At 1e308 m/s^2 the state is finite, m g z is not."""
        scene = self.write("falls.toml", 'duration = 0.01\ngravity = [0, 0, -1e308]\n[[body]]\nname = "ball"\n'
                           'shape = { sphere = { radius = 0.1 } }\nmass = 1\nposition = [0, 0, 10]\n')
        answer = self.json_of("simulate", scene)
        self.assertIsNone(answer["energy_balance"]["gravity"])
        self.assertEqual([w.split(":")[0] for w in answer["warnings"]],
                         ["energies are too large for floating-point numbers (inf or nan, null in JSON)"])

    def test_ctrl_c_ends_with_130_and_prints_no_half_of_an_object(self):
        out, err = self.interrupted("simulate", self.write("test.urdf", PENDULUM), "--json", "--duration", 1e5,
                                    "--every", 1000)
        self.assertEqual(out, "")
        self.assertIn("interrupted", err)


if __name__ == "__main__":
    main()
