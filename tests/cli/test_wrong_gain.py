"""Gains above their stability limit: the post-mortem names the right one of two springs of the S-103, and
each coupling law of a hinge; each suggested fix is stable, and the last steps can be inspected."""
import json
import re

from program import ProgramTest, main, run
from robot_command import HINGE

SPRING = ('[[coupling]]\nname = "{name}"\ntype = "torsional"\nmeasure = "joint"\nlink = "{link}"\n'
          'stiffness = {k}\ndamping = {b}\ndiscretization = "{discretization}"\n'
          '[coupling.target]\nq = {{ {joint} = 0.2 }}\n')


class WrongGain(ProgramTest):
    def run_with(self, k, *options, step=0.001, discretization="explicit", duration=0.5):
        scene = self.write(
            "scene.toml",
            f'step = {step}\n[[robot]]\nname = "arm"\nmodel = "robots/s103/s103.urdf"\n' +
            SPRING.format(name="soft", link="arm1", joint="joint1", k=200, b=2, discretization=discretization) +
            SPRING.format(name="hard", link="arm2", joint="joint2", k=k, b=0, discretization=discretization))
        return run("simulate", scene, "--duration", duration, "--json", *options)

    def test_the_unstable_spring_is_named_and_the_suggested_fixes_are_stable(self):
        file = self.folder / "last.twinrec"
        broken = self.run_with(9e5, "--post-mortem", file, "--energy-bound", 1e6)
        self.assertEqual(broken.returncode, 3, broken.stderr)
        self.assertIn("Likely cause: coupling 'hard'", broken.stderr)
        violation = json.loads(broken.stdout)["post_mortem"]["violations"][0]
        self.assertIn("'hard'", violation["name"])
        self.assertGreater(violation["omega_h"], violation["stability_limit"])
        # The suggested values have a margin: the undamped spring keeps its energy.
        step, gain = (float(re.search(pattern, broken.stderr).group(1)) for pattern in
                      (r"step <= (\S+) ms", r"stiffness <= (\S+) N m/rad"))
        step /= 1000
        for done in (self.run_with(9e5, "--energy-bound", 5e4, step=step),
                     self.run_with(gain, "--energy-bound", 0.06 * gain),
                     self.run_with(9e5, step=0.99 * violation["max_stable_step"]),
                     self.run_with(0.99 * violation["max_stable_gain"]),
                     self.run_with(9e5, discretization="implicit")):
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_an_unstable_run_bounded_by_joint_limits_raises_an_alarm(self):
        answer = json.loads(self.run_with(9e5).stdout)  # when, depends on the last bits: the motion is chaotic
        self.assertEqual(answer["alarm"]["row"], "numerical")

    def test_a_run_that_has_raised_an_alarm_and_goes_on_diverging_is_stopped_by_the_default_bound(self):
        stopped = self.run_with(9e5, duration=5)
        self.assertEqual(stopped.returncode, 3, stopped.stderr)
        answer = json.loads(stopped.stdout)
        self.assertLess(answer["post_mortem"]["energy_bound"], 1e8)
        self.assertGreater(answer["post_mortem"]["time"], answer["alarm"]["time"])

    def test_a_recorded_robot_with_meshes_is_opened_with_its_forces(self):
        file = self.folder / "run.twinrec"
        done = self.run_with(100, "--record", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        force, = self.json_of("inspect", file, "--at", 0.03, "--force", "hard")["forces"]
        self.assertEqual([j["joint"] for j in force["joints"]], ["joint2"])


GOD = '[[coupling]]\nname = "god"\ntype = "god-object"\ntarget = { q = { hinge = 0 } }\n'
# Unstable at a step of 1 ms on an inertia of 0.5: keys of the coupling, and a second coupling.
LAWS = {
    "weld": ({"type": "weld", "time_constant": 4e-4, "damping_ratio": 0.2}, ""),
    "published-linear": ({"type": "published-linear", "stiffness": 3e7, "damping": 600}, ""),
    "published-linear, seldom": ({"type": "published-linear", "stiffness": 3e5, "damping": 2000, "rate": 100}, ""),
    "published-torsional": ({"type": "published-torsional", "stiffness": 3e6, "damping": 5}, ""),
    "stable PD": ({"type": "stable-pd", "stiffness": 3e6, "damping": 20}, ""),
    "equivalent-torsional": ({"type": "equivalent-torsional", "stiffness": 3e7, "damping": 600}, ""),
    "bushing": ({"type": "bushing", "discretization": "explicit", "stiffness": 3e7, "damping": 600,
                 "rotational_stiffness": 1e5, "rotational_damping": 2}, ""),
    "held": ({"type": "linear", "discretization": "explicit", "stiffness": 3e5, "damping": 2000, "rate": 100}, ""),
    "beside a god object": ({"type": "torsional", "measure": "joint", "discretization": "explicit",
                             "stiffness": 1e6, "damping": 20}, GOD),
    "a damper": ({"type": "linear", "discretization": "explicit", "stiffness": 0, "damping": 3e4}, "")}
POINT = ("weld", "published-linear", "equivalent-torsional", "bushing", "linear")
WORDS = {"stiffness": r"\bstiffness <= (\S+) N", "rotational_stiffness": r"rotational_stiffness <= (\S+) N m",
         "damping": r"damping <= (\S+) N", "time_constant": r"time_constant >= (\S+) s",
         "rate": r"rate >= (\S+) Hz"}


class WrongGainOfALaw(ProgramTest):
    def run_with(self, keys, beside, step=0.001):
        self.write("test.urdf", HINGE)
        lines = ["[[coupling]]", 'name = "pull"', 'link = "rod"',
                 *(f"{key} = {json.dumps(value)}" for key, value in keys.items()),
                 "target = { q = { hinge = 0 } }"]
        if keys["type"] in POINT:
            lines.append("point = [0.3, 0, 0]")
        scene = self.write("scene.toml", '[[robot]]\nname = "r"\nmodel = "test.urdf"\nq = { hinge = 1e-4 }\n'
                           'qd = { hinge = 0.01 }\n' + "\n".join(lines) + "\n" + beside)
        return run("simulate", scene, "--duration", 3, "--step", step, "--json", "--post-mortem",
                   self.folder / "last.twinrec", "--energy-bound", 100)  # a point spring has a largest pull

    def check_holds(self, keys, beside, step=0.001):
        done = self.run_with(keys, beside, step)
        self.assertEqual(done.returncode, 0, f"{keys} {step}: {done.stderr}")
        self.assertLess(abs(json.loads(done.stdout)["samples"][-1]["q"]["hinge"]), 3e-4)

    def test_every_law_is_named_with_a_stable_fix(self):
        for name, (keys, beside) in LAWS.items():
            with self.subTest(name):
                broken = self.run_with(keys, beside)
                self.assertEqual(broken.returncode, 3, broken.stderr)
                self.assertIn("Likely cause: coupling 'pull'", broken.stderr)
                violation, = json.loads(broken.stdout)["post_mortem"]["violations"]
                self.assertGreater(violation["omega_h"], violation["stability_limit"])
                if beside:
                    self.assertIn("beside the god object 'god'", violation["scheme"])
                step = re.search(r"step <= (\S+) ms", broken.stderr)
                self.assertNotEqual("rate" in keys, bool(step))
                if step:
                    self.check_holds(keys, beside, float(step[1]) / 1000)
                reported = {key: float(found[1]) for key, pattern in WORDS.items()
                            if (found := re.search(pattern, broken.stderr))}
                rate = reported.pop("rate", None)
                self.assertEqual("rate" in keys, rate is not None, broken.stderr)
                if rate:
                    self.check_holds({**keys, "rate": rate}, beside)
                self.assertTrue(reported or rate, broken.stderr)
                if reported:
                    self.check_holds({**keys, **reported}, beside)
                law = re.search(r'(?:type = "(\S+)", )?(measure = "joint", )?discretization = "implicit"',
                                broken.stderr)
                other = {**keys, "type": law[1] or keys["type"], "discretization": "implicit"}
                other.pop("rate", None)
                if law[2]:
                    other["measure"] = "joint"
                self.check_holds(other, beside)

    def test_the_stability_limit_in_the_json_is_exact(self):
        for name, (keys, beside) in LAWS.items():
            with self.subTest(name):
                violation, = json.loads(self.run_with(keys, beside).stdout)["post_mortem"]["violations"]
                gain = violation["gain"].replace(" ", "_")
                edge, inside = violation["max_stable_gain"], 0.98
                if edge == 0:  # the damper alone is beyond it
                    self.assertIn("rate", keys)
                    continue
                if gain == "time_constant":
                    inside = 1 / inside
                part = edge / keys[gain]
                turn = {"rotational_stiffness": keys.get("rotational_stiffness", 0) * part}
                for by, code in ((inside, 0), (1 / inside, 3)):
                    gains = {gain: by * edge}
                    if "rotational_stiffness" in keys:
                        gains["rotational_stiffness"] = by * turn["rotational_stiffness"]
                    done = self.run_with({**keys, **gains}, beside)
                    self.assertEqual(done.returncode, code, (by, done.stderr))


if __name__ == "__main__":
    main()
