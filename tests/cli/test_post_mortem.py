"""`twinarm inspect RECORDING --at T`, and the post-mortem of a diverged run."""
import json
import math
import re

from program import main, run
from recording_command import BOXES, DOUBLE, RecordingCommand, held
from robot_command import PENDULUM, slider


class Instants(RecordingCommand):
    def test_an_instant_is_inspected_like_its_state_file(self):
        state = {"q": {"shoulder": 1.0}, "tau": {"elbow": 0.2}}
        file = self.record(DOUBLE, "--duration", 0.1, state=state)
        recorded = self.json_of("inspect", file, "--at", 0.05)
        printed = self.json_of("simulate", "test.urdf", "--state", "state.json", "--duration", 0.1, "--at",
                               0.05)["samples"][0]
        self.write("then.json", json.dumps({"q": printed["q"], "qd": printed["qd"], "tau": state["tau"]}))
        wanted = self.json_of("inspect", "test.urdf", "--state", "then.json")
        self.assertEqual(recorded["passes"], wanted["passes"])
        self.assertEqual(recorded["balance"], wanted["balance"])

    def test_the_forces_on_a_box_at_an_instant_of_a_scene_balance(self):
        file = self.record(BOXES, "--duration", 0.4)
        answer = self.json_of("inspect", file, "--at", 0.3)
        by_body = {b["body"]: b for b in answer["balance"]}
        self.assertLess(by_body["low"]["residual"], 1e-10)
        self.assertTrue(any(w["source"].startswith("contact/") for w in by_body["low"]["wrenches"]))

    def test_an_instant_has_the_energy_balance_up_to_it(self):
        file = self.record(BOXES, "--duration", 0.4)
        frame = [f for f in self.exported(file)["frames"] if f["t"] <= 0.3 + 1e-9][-1]
        answer = self.json_of("inspect", file, "--at", 0.3)
        self.assertEqual(answer["energy_balance"], frame["energy_balance"])
        page = self.twinarm("inspect", file, "--at", 0.3).stdout
        self.assertIn("ENERGY BALANCE", page)
        self.assertIn("contact/floor-low/friction", page)
        self.assertLessEqual(max(map(len, page.splitlines())), 100)

    def test_times_outside_the_recording_are_rejected(self):
        file = self.record(PENDULUM, "--duration", 0.1)
        self.assertIn("--at", self.refused("inspect", file, "--at", 3))


class PostMortems(RecordingCommand):
    def test_a_spring_above_its_limit_is_named_and_the_fix_is_stable(self):
        """One spring on I = 0.5 without damper: semi-implicit Euler is stable up to omega h = 2."""
        inertia, h, k = 0.5, 0.001, 4e6
        file = self.folder / "last.twinrec"
        self.record(held(k, 0), "--duration", 1, "--step", h, "--post-mortem", file, code=3)
        found = json.loads(self.simulated.stdout)["post_mortem"]
        violation = found["violations"][0]
        self.assertIn("'pull'", violation["name"])
        self.close(violation["omega_h"], math.sqrt(k / inertia) * h, 1e-9)
        self.close(violation["stability_limit"], 2, 1e-4)
        self.close(violation["max_stable_step"], 2 / math.sqrt(k / inertia), 1e-4)
        self.close(violation["max_stable_gain"], 4 * inertia / h ** 2, 1e-3)
        self.assertEqual(found["joint"], "hinge")
        self.assertIn("'pull'", self.simulated.stderr)
        self.assertTrue(found["energy_row"])
        self.assertGreater(found["energy_row_growth"], 1)
        # Stable below the reported limit, unstable above it.
        for step, code in ((0.9 * violation["max_stable_step"], 0), (1.2 * violation["max_stable_step"], 3)):
            self.record(held(k, 0), "--duration", 1, "--step", step, "--post-mortem", file, code=code)
        self.record(held(0.9 * violation["max_stable_gain"], 0), "--duration", 1, "--step", h)

    def test_the_last_thousand_steps_are_those_of_the_run(self):
        """A spring 1e-5 above its limit: the full recording ends with the same steps."""
        k = 4 * 0.5 / 0.001 ** 2 * 1.00002
        last = self.folder / "last.twinrec"
        full = self.record(held(k, 0), "--duration", 60, "--energy-bound", 1e25, "--post-mortem", last, code=3)
        found = json.loads(self.simulated.stdout)["post_mortem"]
        self.assertIn("kinetic energy", found["reason"])
        ours, all_frames = self.exported(last)["frames"], self.exported(full)["frames"]
        self.assertEqual(len(ours), 1000)
        self.assertGreater(len(all_frames), 1500)
        self.assertEqual([f["hash"] for f in ours], [f["hash"] for f in all_frames[-1000:]])
        self.assertEqual(ours[-1]["step"], found["step"])
        # It opens; at such speeds a cross-check may fail, which the return code reports.
        opened = run("inspect", last, "--at", ours[500]["t"], "--json")
        self.assertIn(opened.returncode, (0, 1), opened.stderr)
        self.assertTrue(json.loads(opened.stdout)["balance"])

    def test_energy_growth_raises_one_alarm_before_the_run_stops(self):
        """A spring 1e-5 above its limit; below it there is no alarm."""
        limit = 4 * 0.5 / 0.001 ** 2
        file = self.record(held(limit * 1.00002, 0), "--duration", 60,
                           "--post-mortem", self.folder / "last.twinrec", code=3)
        answer = json.loads(self.simulated.stdout)
        alarm = answer["alarm"]
        self.assertEqual(alarm["row"], "numerical")
        self.assertLess(alarm["time"], answer["post_mortem"]["time"])
        for word in ("'pull'", "numerical", "stiffness", "implicit"):
            self.assertIn(word, alarm["words"])
        self.assertEqual(self.simulated.stderr.count("twinarm: alarm: "), 1)
        self.assertEqual(self.exported(file)["alarms"], [alarm["words"]])
        self.assertTrue(any("alarm" in words for words in answer["post_mortem"]["words"]))
        for part in (0.9, 0.99):
            self.record(held(limit * part, 0), "--duration", 5)
            self.assertNotIn("alarm", json.loads(self.simulated.stdout))

    def test_a_spring_near_its_limit_is_named_if_none_exceeds_it(self):
        """Two springs at one joint, each at 0.8 of the limit: only both together are unstable."""
        limit = 4 * 0.5 / 0.001 ** 2
        other = (held(limit * 0.8, 0)).split("[[coupling]]")[1].replace('"pull"', '"other"')
        self.record(held(limit * 0.8, 0) + "[[coupling]]" + other, "--duration", 60,
                    "--post-mortem", self.folder / "last.twinrec", code=3)
        answer = json.loads(self.simulated.stdout)
        words = "\n".join(answer["post_mortem"]["words"])
        self.assertIn("Near its limit", words)
        self.assertIn("coupling 'pull'", words)
        steps = int(re.search(r"last (\d+) steps: ", words)[1])
        self.assertLessEqual(steps, answer["post_mortem"]["step"])

    def test_an_always_unstable_method_raises_an_alarm(self):
        """Explicit Euler on a spring: energy grows by 1 + (omega h)^2 in each step."""
        self.record(held(100, 0), "--duration", 20, "--integrator", "euler")
        answer = json.loads(self.simulated.stdout)
        self.assertNotIn("post_mortem", answer)
        self.assertIn("'pull'", answer["alarm"]["words"])
        # By then it has at least doubled: (1 + (w h)^2)^n, w^2 = 100 / 0.5.
        self.assertGreater(1.0002 ** (answer["alarm"]["time"] / 0.001), 2)

    def test_an_explicit_joint_damper_beyond_its_limit_is_named(self):
        self.record(slider(damping=1e5), "--duration", 1, "--integrator", "euler", "--energy-bound", "inf",
                    "--post-mortem", self.folder / "last.twinrec", state={"qd": {"slide": 1}}, code=3)
        found = json.loads(self.simulated.stdout)["post_mortem"]
        self.assertIn("'slide'", found["violations"][0]["name"])
        self.close(found["violations"][0]["omega_h"], 1e5 / 2.0 * 0.001)
        self.assertEqual(found["violations"][0]["stability_limit"], 2)


if __name__ == "__main__":
    main()
