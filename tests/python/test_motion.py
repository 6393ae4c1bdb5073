"""Simulation, simulate(), recordings and couplings, against theory and the program."""
import csv
import io
import math

import numpy as np

from notebook import DOUBLE_PENDULUM, PUMA, ROOT, ProgramTest, main, program, states, twinarm
from program import data


def spring(h, k, b):
    return data("spring_pendulum.toml", step=h, stiffness=k, damping=b)


class Steps(ProgramTest):
    def end(self, h, integrator):
        model = twinarm.load(DOUBLE_PENDULUM)
        sim = twinarm.Simulation(model, [1.0, 0.5], [0, 0], integrator=integrator, h=h)
        sim.step(round(0.8 / h))
        return sim

    def test_rk4_loses_energy_and_place_with_the_fourth_power_of_the_step(self):
        ends = [self.end(0.01 / 2 ** n, "rk4") for n in range(5)]
        start = sum(twinarm.energy(twinarm.load(DOUBLE_PENDULUM), [1.0, 0.5], [0, 0]))
        drift = [abs(sum(sim.energy()) - start) for sim in ends[:3]]
        place = [np.abs(sim.q - ends[4].q).max() for sim in ends[:3]]
        for n in range(2):
            self.assertGreater(math.log2(drift[n] / drift[n + 1]), 3.8)
            self.assertAlmostEqual(math.log2(place[n] / place[n + 1]), 4, delta=0.3)
        self.assertEqual(ends[0].steps, 80)
        self.assertAlmostEqual(ends[0].t, 0.8, places=12)

    def test_each_integrator_has_the_order_that_it_states(self):
        exact = self.end(0.0003125, "rk4")
        for facts in twinarm.integrators():
            if facts["name"] == "dopri5":
                continue
            a, b = (np.abs(self.end(h, facts["name"]).q - exact.q).max() for h in (0.005, 0.0025))
            self.assertAlmostEqual(math.log2(a / b), facts["order"], delta=0.35, msg=facts["name"])

    def test_run_gives_the_states_that_single_steps_go_through(self):
        model = twinarm.load(DOUBLE_PENDULUM)
        together = twinarm.Simulation(model, [1.0, 0.5], integrator="heun", h=0.01)
        single = twinarm.Simulation(model, [1.0, 0.5], integrator="heun", h=0.01)
        together.tau = single.tau = [0.2, -0.1]
        t, q, qd = together.run(12, every=4)
        self.assertEqual((t.shape, q.shape, qd.shape), ((4,), (4, 2), (4, 2)))
        for row in range(4):
            np.testing.assert_array_equal(q[row], single.q)
            np.testing.assert_array_equal(qd[row], single.qd)
            self.assertEqual(t[row], single.t)
            single.step(4)

    def test_a_force_that_holds_the_weight_lets_a_robot_stand(self):
        model = twinarm.load(PUMA)
        q = states(model, 1)[0][0]
        sim = twinarm.Simulation(model, q)
        sim.tau = twinarm.rnea(model, q, np.zeros(6), np.zeros(6))
        sim.step(100)
        np.testing.assert_allclose(sim.q, q, atol=1e-12)
        sim.set_state(qd=np.ones(6), t=3)
        np.testing.assert_array_equal(sim.qd, np.ones(6))
        self.assertEqual(sim.t, 3)

    def test_a_run_that_diverges_says_where(self):
        model = twinarm.load(DOUBLE_PENDULUM)
        sim = twinarm.Simulation(model, [1.0, 0.5], [1e200, 0])
        with self.assertRaisesRegex(FloatingPointError, "step 1, .*'[a-zA-Z]+' of body '\\w+'"):
            sim.step(10)


class Scenes(ProgramTest):
    def test_a_scene_has_the_bits_of_twinarm_simulate(self):
        for scene in ("assets/scenes/double_pendulum.toml", "assets/scenes/box_stack.toml"):
            reported = program("simulate", scene, "--duration", 0.2, "--every", 0.05)
            run = twinarm.simulate(scene, duration=0.2, every=0.05)
            np.testing.assert_array_equal(run.t, [s["t"] for s in reported["samples"]])
            for key in ("kinetic_energy", "potential_energy"):
                np.testing.assert_array_equal(getattr(run, key), [s[key] for s in reported["samples"]])
            self.assertEqual(run.energy_balance, reported["energy_balance"])
            self.assertEqual(run.contacts, reported["contacts"])
            self.assertEqual(run.steps, reported["steps"])
            self.assertEqual(run.warnings, reported["warnings"])
            self.assertIsNone(run.stopped)
            for row, six in run.momentum.items():
                np.testing.assert_array_equal(six[:3], reported["momentum"][row]["angular"])
                np.testing.assert_array_equal(six[3:], reported["momentum"][row]["linear"])
            for n, sample in enumerate(reported["samples"]):
                for joint, value in sample["q"].items():
                    np.testing.assert_array_equal(np.ravel(run.q[n, run.model.q_of[joint]]), np.ravel(value))

    def test_a_spring_swings_with_the_frequency_of_theory_and_diverges_beyond_its_limit(self):
        I, k = 1.00144, 4000.0  # about the hinge
        omega = math.sqrt((k + 9.81) / I)  # the weight is a spring too, of m g l
        limit = twinarm.largest_omega_h("semi-implicit Euler", 0)
        self.assertAlmostEqual(limit, 2, places=6)
        for part, stops in ((0.98, False), (1.02, True)):
            text = spring(h=part * limit / omega, k=k, b=0)
            run = twinarm.simulate(self.write("spring.toml", text), duration=6)
            self.assertEqual(run.stopped is not None, stops, part)
        self.assertTrue(run.stopped["reason"])
        self.assertLess(run.end, 6)

    def test_predictions_are_those_of_the_program_and_of_one_degree_of_freedom(self):
        scene = self.write("spring.toml", spring(h=0.001, k=400.0, b=3.0))
        found = twinarm.predict_couplings(scene)
        self.assertEqual(found, program("coupling", "predict", scene))
        self.assertAlmostEqual(found["K"][0][0], 400, places=9)
        step = twinarm.largest_stable_step(found["mass_matrix"], found["K"], found["B"], "semi-implicit Euler")
        reported = {row["scheme"]: row["max_stable_step"] for row in found["limits"]}
        self.assertEqual(step, reported["semi-implicit Euler"])
        omega = math.sqrt(400 / 1.00144)
        zeta = 3 / (2 * math.sqrt(400 * 1.00144))
        self.assertAlmostEqual(step * omega, twinarm.largest_omega_h("semi-implicit Euler", zeta), places=6)
        self.assertEqual(set(reported), set(twinarm.schemes()))
        self.assertEqual(twinarm.largest_omega_h("spring and damper implicit", 0.1), math.inf)

    def test_what_is_set_in_a_scene_is_as_if_its_file_said_so(self):
        of_file = self.write("written.toml", spring(h=0.002, k=300.0, b=3.0).replace('"explicit"', '"implicit"') + "\n")
        other = self.write("spring.toml", spring(h=0.001, k=5.0, b=0.0))
        change = {"step": 0.002, "coupling.hold.stiffness": 300, "coupling.damping": np.float64(3.0),
                  "coupling.discretization": "implicit"}
        expected, run = twinarm.simulate(of_file), twinarm.simulate(other, set=change)
        np.testing.assert_array_equal(run.q, expected.q)
        self.assertEqual(run.energy_balance, expected.energy_balance)
        self.assertEqual(twinarm.predict_couplings(other, set=change), twinarm.predict_couplings(of_file))
        level = twinarm.simulate(other, set={"gravity": [0, 0, 0], "robot.limits": False}, duration=0.1)
        self.assertEqual(level.potential_energy[0], 0)

    def test_what_cannot_be_set_is_reported(self):
        scene = self.write("spring.toml", spring(h=0.001, k=5.0, b=0.0))
        for change, kind, words in (({"coupling.pull.stiffness": 1}, twinarm.InputError, "there is no coupling 'pull'"),
                                    ({"coupling.hold.stifness": 1}, twinarm.InputError, "stifness"),
                                    ({"no.such": 1}, twinarm.InputError, "^set\\['no.such'\\]: "),
                                    ({"step": float("nan")}, ValueError, "set\\['step'\\]"),
                                    ({"gravity": [[0, 0, 0]]}, ValueError, "set\\['gravity'\\]"),
                                    ({"step": object()}, TypeError, "set\\['step'\\]")):
            with self.assertRaisesRegex(kind, words):
                twinarm.simulate(scene, set=change)
        with self.assertRaisesRegex(ValueError, "set= changes a scene"):
            twinarm.simulate(DOUBLE_PENDULUM, duration=1, set={"step": 0.01})

    def test_targets_are_where_the_program_has_them(self):
        scene = ROOT / "docs" / "learn" / "lessons" / "04_torsional_or_linear" / "arm_linear.toml"
        reported = program("simulate", scene, "--duration", 0.4, "--every", 0.1)
        run = twinarm.simulate(scene, duration=0.4, every=0.1)
        self.assertEqual(list(run.targets), ["pull1", "pull2"])
        for n, sample in enumerate(reported["samples"]):
            for pull, q in run.targets.items():
                for joint, value in sample["targets"][pull]["q"].items():
                    np.testing.assert_array_equal(np.ravel(q[n, run.model.q_of[joint]]), np.ravel(value))
        self.assertEqual(twinarm.simulate("assets/scenes/pendulum.toml", duration=0.1).targets, {})

    def test_each_type_of_coupling_is_known_to_scenes(self):
        text = (ROOT / "docs" / "reference" / "scene_file.md").read_text(encoding="utf-8")
        types = twinarm.coupling_types()
        self.assertGreater(len(types), 5)
        for row in types:
            self.assertIn(row["name"], text)

    def test_a_scene_is_one_model_whose_start_is_the_scenes(self):
        model = twinarm.load("assets/scenes/pendulum.toml")
        np.testing.assert_array_equal(model.q, [2.61799387799149])
        self.assertEqual(twinarm.poses(model, model.q)[model.bodies.index("hook"), 2, 3], 1.2)


class Recordings(ProgramTest):
    def test_a_recording_has_the_numbers_of_the_export(self):
        file = self.folder / "run.twinrec"
        self.twinarm("simulate", "assets/scenes/tracking_map.toml", "--duration", 0.05, "--record", file)
        exported = self.twinarm("export", file, "--csv").stdout
        rows = list(csv.DictReader(io.StringIO(exported)))
        rec = twinarm.open_recording(file)
        self.assertEqual(len(rec.t), len(rows))
        checked = 0
        columns = {key.split("[")[0]: key for key in rows[0]}
        np.testing.assert_array_equal(rec.t, [float(row[columns["t"]]) for row in rows])
        for name in rec.keys():
            if name in columns:
                np.testing.assert_array_equal(rec[name], [float(r[columns[name]]) for r in rows], name)
                checked += 1
        self.assertGreater(checked, 5)
        self.assertEqual(rec.q.shape, (len(rec.t), sum(n.startswith("q/") for n in rec.keys())))
        np.testing.assert_array_equal(rec.q[:, 0], rec[rec.keys()[0]])
        np.testing.assert_array_equal(rec.qd[:, 0], rec[next(n for n in rec.keys() if n.startswith("qd/"))])
        self.assertEqual(list(rec.coupling_forces), ["pull_arm1", "pull_arm2"])
        self.assertEqual(rec.units["kinetic_energy"], "J")
        self.assertEqual(rec.step[-1], 50)
        self.assertIn("numerical", rec.energy_balance)
        self.assertEqual(rec.end, "done")
        energy = rec["kinetic_energy"] + rec["potential_energy"]
        sum_of_rows = sum(work for row, work in rec.energy_balance.items() if row != "gravity")
        np.testing.assert_allclose(energy - energy[0], sum_of_rows, atol=1e-9 * np.abs(energy).max())


if __name__ == "__main__":
    main()
