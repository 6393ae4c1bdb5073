"""A scene with a control loop: the bits of simulate(), analytic tracking errors, energy, saved states, faults."""
import json

import numpy as np

from notebook import SCENES, ProgramTest, main, program, twinarm

DOUBLE = f"{SCENES}/double_pendulum.toml"


def rest(sim):
    return np.zeros(sim.model.nv)


class LikeSimulate(ProgramTest):
    def test_without_forces_it_has_the_bits_of_simulate(self):
        # contacts, limits, loops, couplings of each kind, free bodies, RK4
        for name in ("box_stack", "peg_in_hole", "robot_beside_obstacles", "study", "study_e1", "four_bar", "turntable",
                     "double_pendulum", "dzhanibekov"):
            with self.subTest(scene=name):
                sim = twinarm.SceneSimulation(f"{SCENES}/{name}.toml")
                duration, every = 64 * sim.h, 16 * sim.h
                found, wanted = sim.run(duration, rest, every=every), \
                    twinarm.simulate(f"{SCENES}/{name}.toml", duration=duration, every=every)
                for key in ("q", "qd", "kinetic_energy", "potential_energy"):
                    np.testing.assert_array_equal(getattr(found, key), getattr(wanted, key), key)
                for key in wanted:
                    np.testing.assert_array_equal(found[key], wanted[key], key)
                for row, work in wanted.energy_balance.items():
                    self.assertEqual(found.energy_balance[row], work, row)
                for coupling, q in wanted.targets.items():
                    np.testing.assert_allclose(found.targets[coupling], q, atol=1e-14)
                self.assertEqual(found.contacts, wanted.contacts)
                self.assertEqual(found.steps, wanted.steps)

    def test_constant_forces_are_those_of_a_state_file(self):
        scene = f"{SCENES}/peg_in_hole.toml"
        sim = twinarm.SceneSimulation(scene)
        joints = [joint for joint in sim.model.qd_of][:2]
        tau = dict(zip(joints, (3.0, -2.0)))
        state = self.write("state.json", json.dumps({"tau": tau}))
        wanted = twinarm.simulate(scene, duration=0.1, state=state)
        sim.tau = tau
        np.testing.assert_array_equal(sim.run(0.1).q[-1], wanted.q[-1])
        np.testing.assert_array_equal(twinarm.SceneSimulation(scene, state=state).tau, sim.tau)
        sim.reset()
        np.testing.assert_array_equal(sim.run(0.1, lambda sim: tau).q[-1], wanted.q[-1])

    def test_a_target_set_in_each_step_moves_as_the_scenes_own(self):
        scene = f"{SCENES}/tracking_map.toml"  # the paper's motion: 90 to -90 and -45 to 45 degrees in 1 s
        sim, span = twinarm.SceneSimulation(scene), np.array([-np.pi, np.pi / 2])
        begin = np.array([np.pi / 2, -np.pi / 4])
        joints = sim.target_joints()
        self.assertEqual(joints[:2], ["joint1", "joint2"])
        own = dict(zip(joints, np.zeros(3)))

        def move(sim):
            own.update(zip(joints, begin + span * sim.t))
            sim.set_target(own, dict(zip(joints, span)))

        found = sim.run(0.5, move, every=0.1)
        wanted = twinarm.simulate(scene, duration=0.5, every=0.1)
        np.testing.assert_allclose(found.q, wanted.q, atol=1e-12)
        np.testing.assert_allclose(found.targets["pull_arm1"][:-1], wanted.targets["pull_arm1"][:-1], atol=1e-12)
        for row, work in wanted.energy_balance.items():
            self.assertAlmostEqual(found.energy_balance[row], work, places=9, msg=row)

    def test_it_inspects_what_the_program_inspects_in_its_recording(self):
        for name in ("study", "peg_in_hole", "box_stack"):
            file, changes = self.folder / f"{name}.twinrec", {"gravity": [0.5, 0, -5]}
            with twinarm.SceneSimulation(f"{SCENES}/{name}.toml", record=file, set=changes) as sim:
                sim.step(30)
                found = sim.inspect(check=True)
            wanted = program("inspect", str(file), "--at", str(sim.t))
            for key in ("passes", "balance", "joint_balance", "checks"):
                self.assertEqual(found[key], wanted[key], f"{name}: {key}")
            acting = [force for force in found["forces"] if not force["source"].startswith("actuator/")]
            self.assertEqual(acting, [f for f in wanted["forces"] if not f["source"].startswith("actuator/")])
            self.assertTrue(all(check["pass"] for check in found["checks"]))


class Control(ProgramTest):
    def computed_torque(self, h):
        """Largest error against e0 (1 + w t) exp(-w t): the error of q'' = -w^2 e - 2 w e'."""
        sim, w = twinarm.SceneSimulation(DOUBLE, step=h, friction=False), 8.0
        goal = sim.q + 0.3

        def control(sim):
            qdd = -w * w * (sim.q - goal) - 2 * w * sim.qd
            return twinarm.rnea(sim.model, sim.q, sim.qd, qdd)

        run = sim.run(1, control, every=0.1)
        exact = goal - 0.3 * ((1 + w * run.t) * np.exp(-w * run.t))[:, None]
        return np.abs(run.q - exact).max()

    def test_computed_torque_tracks_to_the_analytic_error_at_first_order_in_the_step(self):
        coarse, fine = self.computed_torque(0.001), self.computed_torque(0.0005)
        self.assertLess(coarse, 2e-3)
        self.assertAlmostEqual(coarse / fine, 2, delta=0.05)  # of the force that is held over a step

    def test_the_work_of_the_control_is_in_the_energy_balance(self):
        sim = twinarm.SceneSimulation(DOUBLE, step=0.0005)
        run = sim.run(0.5, lambda sim: 2 * np.sin(9 * sim.t + np.arange(sim.model.nv)))
        work = (run.tau[1:] * np.diff(run.q, axis=0)).sum(axis=0)  # constant over each step
        for joint, place in sim.model.qd_of.items():
            self.assertAlmostEqual(run.energy_balance[f"actuator/{joint}"], work[place][0], places=8)
        gained = run.kinetic_energy[-1] - run.kinetic_energy[0]
        self.assertAlmostEqual(sum(run.energy_balance.values()), gained, places=12)
        self.assertLess(abs(run.energy_balance["numerical"]), 1e-7)

    def test_readings_obey_the_laws_of_the_scene(self):
        sim = twinarm.SceneSimulation(f"{SCENES}/box_stack.toml")
        sim.step(100)
        on_floor = [c for c in sim.contacts if "floor" in (c["a"], c["b"])]
        lifted = sum(c["force"][2] if c["a"] == "floor" else -c["force"][2] for c in on_floor)
        self.assertAlmostEqual(lifted, 10 * 9.81, delta=1e-5)
        sim = twinarm.SceneSimulation(f"{SCENES}/tracking_map.toml", integrator="rk4")
        sim.step(50)
        seen = sim.observation()
        before = sim.save()
        for name, (k, b) in {"pull_arm1": (22000, 400), "pull_arm2": (22000, 400)}.items():
            error = seen["couplings"][name]["error"]
            sim.set_target(seen["couplings"][name]["target_q"][:len(sim.target_joints())])
            force = sim.inspect().force(f"coupling/{name}")["on"][0]["force"]
            point = {"arm1": [0.25, 0, 0.365], "arm2": [0.35, 0, 0.1]}[f"arm{name[-1]}"]
            J = twinarm.jacobian(sim.model, sim.q, f"arm{name[-1]}", point)[3:]
            np.testing.assert_allclose(force, k * error - b * J @ sim.qd, atol=1e-6 * k)
            sim.reset(before)
        np.testing.assert_array_equal(seen["poses"], twinarm.poses(sim.model, sim.q))
        self.assertEqual(seen["kinetic_energy"], twinarm.energy(sim.model, sim.q, sim.qd)[0])


class SavedStates(ProgramTest):
    def swing(self, sim):
        sim.set_target(0.3 * np.sin(20 * sim.t + np.arange(len(sim.target_joints()))))
        return 0.5 * np.cos(30 * sim.t + np.arange(sim.model.nv)) * (np.arange(sim.model.nv) < 2)

    def assert_same(self, a, b):
        for key in ("t", "q", "qd", "tau"):
            np.testing.assert_array_equal(getattr(a, key), getattr(b, key), key)
        self.assertEqual(a.energy_balance, b.energy_balance)

    def test_reset_repeats_bit_for_bit(self):
        for name in ("study", "hand_and_obstacles", "tracking_map"):
            with self.subTest(scene=name):
                sim = twinarm.SceneSimulation(f"{SCENES}/{name}.toml")
                first = sim.run(0.04, self.swing)
                saved, seen = sim.save(), sim.inspect()
                later = sim.run(0.04, self.swing)
                sim.step(7)
                sim.reset(saved)
                self.assertEqual(sim.t, saved.t)
                self.assertEqual(sim.inspect(), seen)
                self.assert_same(sim.run(0.04, self.swing), later)
                sim.reset()
                self.assertEqual((sim.t, sim.steps), (0, 0))
                self.assert_same(sim.run(0.04, self.swing), first)
                other = twinarm.SceneSimulation(f"{SCENES}/{name}.toml")
                other.reset(saved)  # of the same scene
                self.assert_same(other.run(0.04, self.swing), later)

    def test_a_delayed_coupling_repeats_its_target_too(self):
        text = (SCENES / "study.toml").read_text(encoding="utf-8").replace(
            'target = "device"', 'target = "device"\ndelay = 0.02').replace("robots/", f"{SCENES.parent}/robots/")
        sim = twinarm.SceneSimulation(self.write("delayed.toml", text))
        sim.step(5)
        start = sim.observation()["couplings"]["pull_arm1"]["target_q"]
        goal = start[:3] + 0.2
        sim.set_target(goal)
        sim.step(19)
        np.testing.assert_array_equal(sim.observation()["couplings"]["pull_arm1"]["target_q"], start)
        saved = sim.save()
        sim.step(2)
        np.testing.assert_allclose(sim.observation()["couplings"]["pull_arm1"]["target_q"][:3], goal, atol=1e-12)
        q = sim.q
        sim.reset(saved)
        sim.step(2)
        np.testing.assert_array_equal(sim.q, q)

    def test_reset_begins_with_other_coordinates(self):
        sim = twinarm.SceneSimulation(DOUBLE)
        sim.step(10)
        sim.reset(q={"left/elbow": 0.5}, qd=[1, 2, 3, 4])
        self.assertEqual(sim.t, 0)
        np.testing.assert_array_equal(sim.qd, [1, 2, 3, 4])
        self.assertEqual(sim.q[sim.model.q_of["left/elbow"]], [0.5])
        sim.reset()
        np.testing.assert_array_equal(sim.q, sim.model.q)
        sim = twinarm.SceneSimulation(f"{SCENES}/four_bar.toml")
        q = sim.q
        with self.assertRaisesRegex(twinarm.InputError, "constraint|loop"):
            sim.reset(q=np.concatenate([[9], q[1:]]))
        np.testing.assert_array_equal(sim.q, q)
        sim.step(3)


class Faults(ProgramTest):
    def reported(self, kind, words, function, *arguments, **named):
        with self.assertRaisesRegex(kind, words):
            function(*arguments, **named)

    def test_wrong_arguments_are_refused_with_the_nearest_name(self):
        sim = twinarm.SceneSimulation(f"{SCENES}/study.toml")
        self.reported(ValueError, r"tau has shape \(3,\), must have \(4,\): nv = 4", setattr, sim, "tau", [1, 2, 3])
        self.reported(ValueError, r"tau\[1\] is nan", sim.step, 1, lambda sim: [0, np.nan, 0, 0])
        self.reported(TypeError, "tau must be an array of real numbers, is a str", sim.step, 1, lambda sim: "hold")
        self.reported(KeyError, "no joint 'joint11'; did you mean 'joint1'", setattr, sim, "tau", {"joint11": 1})
        self.reported(ValueError, r"target q has shape \(2,\), must have \(3,\)", sim.set_target, [0, 0])
        self.reported(ValueError, r"target qd\[2\] is inf", sim.set_target, [0, 0, 0], [0, 0, np.inf])
        self.reported(KeyError, "no coupling 'pull_arm'; did you mean 'pull_arm1'", sim.set_target, [0, 0, 0],
                      coupling="pull_arm")
        self.reported(KeyError, "no joint 'joint9'", sim.set_target, {"joint9": 0})
        self.reported(ValueError, "no coupling with a target", twinarm.SceneSimulation(DOUBLE).set_target, [0])
        self.reported(TypeError, "control must be a function", sim.step, 1, 3)
        self.reported(ValueError, "count must not be negative, is -1", sim.step, -1)
        self.reported(ValueError, "every must be a whole number of steps of 0.001 s, is 0.0015 s", sim.run, 0.1,
                      every=0.0015)
        self.reported(ValueError, "duration must be a whole number", sim.run, float("nan"))
        self.reported(TypeError, "SavedState, of save", sim.reset, {"q": 1})
        self.reported(ValueError, r"q has shape \(2,\)", sim.reset, q=[0, 0])
        self.reported(ValueError, "another coupling|other couplings", sim.reset, twinarm.SceneSimulation(DOUBLE).save())
        self.reported(KeyError, "no body 'arm3'; did you mean 'arm", sim.inspect().quantity, "IA", "arm3")
        self.reported(KeyError, "no quantity 'IAA'; did you mean 'IA'", sim.inspect().quantity, "IAA", "arm1")
        self.reported(KeyError, "no force 'coupling/pul'", sim.inspect().force, "coupling/pul")
        self.assertEqual(sim.steps, 0)
        free = twinarm.SceneSimulation(f"{SCENES}/box_stack.toml")
        self.reported(ValueError, r"tau\[2\] is 1, must be 0", setattr, free, "tau", np.eye(free.model.nv)[2])

    def test_scenes_that_cannot_be_stepped_are_refused(self):
        self.reported(ValueError, "not a scene.*Simulation", twinarm.SceneSimulation,
                      "assets/robots/puma560/puma560.urdf")
        self.reported(twinarm.InputError, "nowhere.toml", twinarm.SceneSimulation, "nowhere.toml")
        self.reported(ValueError, "fixed step", twinarm.SceneSimulation, DOUBLE, integrator="dopri5")
        self.reported(twinarm.InputError, "rk5.*'?rk4", twinarm.SceneSimulation, DOUBLE, integrator="rk5")
        self.reported(twinarm.InputError, r"set\['gravityy'\]", twinarm.SceneSimulation, DOUBLE, set={"gravityy": 1})

    def test_a_callback_that_raises_ends_before_its_step(self):
        sim, steps = twinarm.SceneSimulation(f"{SCENES}/study.toml"), []

        def third(sim):
            steps.append(sim.steps)
            if len(steps) == 3:
                raise RuntimeError("enough")

        self.reported(RuntimeError, "enough", sim.step, 10, third)
        self.assertEqual((steps, sim.steps), ([0, 1, 2], 2))
        q = sim.q
        other = twinarm.SceneSimulation(f"{SCENES}/study.toml")
        other.step(2)
        np.testing.assert_array_equal(q, other.q)
        sim.step(10)
        other.step(10)
        np.testing.assert_array_equal(sim.q, other.q)

    def test_a_run_that_diverges_names_the_body_and_can_begin_again(self):
        sim = twinarm.SceneSimulation(DOUBLE)
        self.reported(FloatingPointError, "step .*body '.*shorter step", sim.step, 4000, lambda sim: 1e9 * sim.qd + 1)
        self.reported(FloatingPointError, "reset", sim.step)
        sim.reset()
        run = sim.run(1, lambda sim: 1e9 * sim.qd + 1)
        self.assertIn("body", run.stopped["reason"])
        self.assertLess(len(run), 1001)
        sim.reset()
        sim.step()


if __name__ == "__main__":
    main()
