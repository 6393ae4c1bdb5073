"""Every type of coupling in a scene, as a run books it, and a spring that passes its geometric limit."""
import math
import re

from program import main
from robot_command import HINGE, STEADY_HAND, RobotCommand, joint, link, robot

STEP = 0.001
GAINS = "stiffness = 80\ndamping = 3\n"
TYPES = {  # keys of its own
    "linear": GAINS + "point = [0.6, 0, 0]\n", "torsional": GAINS,
    "bushing": GAINS + "point = [0.6, 0, 0]\nrotational_stiffness = 20\nrotational_damping = 1\n",
    "weld": "point = [0.6, 0, 0]\ntime_constant = 0.1\n", "equivalent-torsional": GAINS + "point = [0.6, 0, 0]\n",
    "stable-pd": GAINS, "god-object": "", "published-linear": GAINS + "point = [0.6, 0, 0]\n",
    "published-torsional": GAINS}


def chain(links, length=0.05, mass=0.1):
    """A metre of rods in a plane."""
    along = mass * length ** 2 / 12
    parts = ['<link name="base"/>']
    for i in range(1, links + 1):
        parts.append(link(f"rod{i}", mass, (length / 2, 0, 0), (0.1 * along, 0, 0, along, 0, along)))
        parts.append(joint(f"joint{i}", "continuous", f"rod{i - 1}" if i > 1 else "base",
                           f"rod{i}", xyz=f"{length if i > 1 else 0} 0 0"))
    return robot(*parts)


class CouplingTypes(RobotCommand):
    def run_scene(self, urdf, text, *options, code=0):
        self.write("robot.urdf", urdf)
        scene = self.write("scene.toml", '[[robot]]\nname = "r"\nmodel = "robot.urdf"\n' + text)
        return self.json_of("simulate", scene, *options, code=code)

    def scene(self, kind):
        self.write("hand.csv", STEADY_HAND)
        linked = "" if kind == "god-object" else 'link = "rod"\n'
        return (f'[[coupling]]\nname = "pull"\ntype = "{kind}"\n{linked}{TYPES[kind]}target = "hand.csv"\n')

    def test_on_one_hinge_all_that_happens_is_the_couplings_work(self):
        for kind in TYPES:
            with self.subTest(kind):
                answer = self.run_scene(HINGE, self.scene(kind), "--duration", 0.4)
                rows, end = answer["energy_balance"], answer["samples"][-1]
                self.assertGreater(end["kinetic_energy"], 0.01)
                self.assertAlmostEqual(sum(rows.values()), end["kinetic_energy"], delta=1e-12)
                names = {name.rsplit("/", 1)[0] for name in rows if name.startswith("coupling/")}
                self.assertEqual(names, {
                    "bushing": {"coupling/pull/force", "coupling/pull/couple"},
                    "weld": {"coupling/pull/force", "coupling/pull/couple"},
                    "god-object": {"coupling/pull/hinge"}}.get(kind, {"coupling/pull"}))
                # Exact where each step is booked as it was taken; else to the order of the step.
                taken = kind in ("stable-pd", "god-object", "published-torsional", "weld")
                self.assertLess(abs(rows["numerical"]), 1e-12 if taken else 1e-2)

    def test_at_an_even_speed_each_follows_as_its_law_says(self):
        """The target turns at 1 rad/s. A weld lags 2 v T; a god object does not."""
        lags = {"weld": 0.2, "god-object": 0}
        for kind in TYPES:
            with self.subTest(kind):
                end = self.run_scene(HINGE, self.scene(kind), "--duration", 6)["samples"][-1]
                target = end["targets"]
                q = next(iter(target.values()))["q"]["hinge"]
                self.assertAlmostEqual(q, 6, delta=1e-9)
                if kind != "published-torsional":  # its damper does not damp
                    self.assertAlmostEqual(q - end["q"]["hinge"], lags.get(kind, 0), delta=2e-3)

    def test_a_tip_held_stiffly_comes_in_from_7_mm_and_is_told_to_be_lost_from_71_mm(self):
        """w h = 100 on the stiffest mode, without damper: docs/understand/stability_of_spring_dampers.md."""
        stiffness = 2.887e8

        def tip(off, *options, code=0):
            return self.run_scene(
                chain(20),
                f'[[coupling]]\nname = "tip"\ntype = "linear"\nlink = "rod20"\npoint = [0.05, 0, 0]\n'
                f'stiffness = {stiffness}\ntarget = {{ q = {{ joint1 = {off} }} }}\n',
                "--duration", 0.6, "--step", STEP, "--every", 0.02, *options, code=code)
        first = 0.5 * stiffness * (2 * math.sin(0.007 / 2)) ** 2
        offsets = []
        for sample in tip(0.007)["samples"]:
            x, y, angle = -math.cos(0.007), -math.sin(0.007), 0
            for i in range(1, 21):
                angle += sample["q"][f"joint{i}"]
                x += 0.05 * math.cos(angle)
                y += 0.05 * math.sin(angle)
            offsets.append(math.hypot(x, y))
            energy = sample["kinetic_energy"] + 0.5 * stiffness * offsets[-1] ** 2
            self.assertLess(energy, 1.5 * first)
        self.assertAlmostEqual(offsets[0], 0.007, delta=1e-6)
        self.assertLess(offsets[-1], 1e-3)
        far = tip(0.071, "--post-mortem", self.folder / "last.twinrec", code=3)
        words = " ".join(far["post_mortem"]["words"])
        found = re.search(r"coupling 'tip', .* exceeded its geometric limit at step (\d+), .* axis of "
                          r"joint '(joint\d+)'", words)
        self.assertTrue(found, words)
        self.assertLess(int(found.group(1)), 10)


if __name__ == "__main__":
    main()
