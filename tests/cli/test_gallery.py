"""The scenes that the lab offers: each runs with its books in balance, and against closed forms."""
import json
import math
import struct
import tomllib

from program import ROOT, SCENES, ProgramTest, main

GALLERY = tomllib.loads((SCENES / "gallery/gallery.toml").read_text())["scene"]
G = 9.81


def quarter_period(m):
    """The complete elliptic integral K(m), by the arithmetic-geometric mean."""
    a, b = 1.0, math.sqrt(1 - m)
    for _ in range(40):
        a, b = (a + b) / 2, math.sqrt(a * b)
    return math.pi / (2 * a)


class Gallery(ProgramTest):
    def simulate(self, scene, *options):
        return self.json_of("simulate", SCENES / f"{scene}.toml", *options)

    def test_each_scene_runs_five_seconds_with_its_energy_in_balance(self):
        names = [scene["file"] for scene in GALLERY]
        for name in names + [f"study_e{i}.toml" for i in (1, 2, 3, 4)]:
            with self.subTest(name):
                # The 200 links of the chain take seven seconds of computing for one.
                duration = 1 if name == "falling_chain.toml" else 5
                answer = self.simulate(name.removesuffix(".toml"), "--duration", duration)
                self.assertNotIn("post_mortem", answer)
                first, last = answer["samples"][0], answer["samples"][-1]
                self.assertEqual(last["t"], duration)
                most = max(map(abs, answer["energy_balance"].values()), default=0)
                self.assertAlmostEqual(last["kinetic_energy"] - first["kinetic_energy"],
                                       sum(answer["energy_balance"].values()), delta=1e-9 * max(1, most))

    def test_each_scene_has_three_lines_and_a_picture_and_all_are_small(self):
        total = 0
        for scene in GALLERY:
            with self.subTest(scene["name"]):
                self.assertEqual(len(scene["look"]), 3)
                self.assertTrue(all(20 < len(line) < 120 for line in scene["look"]))
                picture = (SCENES / "gallery" / (scene["name"] + ".png")).read_bytes()
                self.assertEqual(struct.unpack(">II", picture[16:24]), (480, 300))
                total += len(picture)
        self.assertLess(total, 1e6)

    def test_the_pendulum_is_back_after_its_period_of_large_swings(self):
        start, inertia = math.radians(150), 1 + 0.4 * 0.06 ** 2
        period = 4 * math.sqrt(inertia / G) * quarter_period(math.sin(start / 2) ** 2)
        self.assertIn(f"{period:.5f} s", (SCENES / "pendulum.toml").read_text())
        answer = self.simulate("pendulum", "--integrator", "rk4", "--step", 0.001, "--duration", 4,
                               "--at", f"{period / 4},{period / 2},{period}")
        quarter, half, whole = [s["q"]["hinge"] for s in answer["samples"]]
        self.assertAlmostEqual(quarter, 0, delta=1e-8)
        self.assertAlmostEqual(half, -start, delta=1e-8)
        self.assertAlmostEqual(whole, start, delta=1e-8)

    def test_the_end_of_the_falling_chain_moves_as_that_of_a_thin_chain_that_keeps_its_energy(self):
        # Calkin and March 1989: speed^2 = 2 g x (1 - x / 2 L) / (1 - x / L) after a fall of x.
        length, step, x, t = 2.0, 1e-5, 0.0, 0.0
        root = 0.0  # x = L root^2
        while t < 0.5:
            root += step * math.sqrt(G / (2 * length) * (1 - root ** 2 / 2) / (1 - root ** 2))
            x, t = length * root ** 2, t + step
        start, end = self.simulate("falling_chain", "--no-friction", "--duration", 0.5)["samples"]

        def height(sample):
            angle = height = 0
            for i in range(200):
                angle += sample["q"][f"joint{i + 1}"]
                height -= 0.01 * math.cos(angle)
            return height
        self.assertAlmostEqual(height(start) - height(end), x, delta=1e-3)
        self.assertGreater(height(start) - height(end), 1.2 * 0.5 * G * 0.5 ** 2)  # the ball

    def test_the_integrators_do_to_the_pendulum_what_the_gallery_says(self):
        def late(integrator):
            answer = self.simulate("pendulum", "--integrator", integrator, "--duration", 20, "--every", 0.02)
            return max(abs(s["q"]["hinge"]) for s in answer["samples"][-200:])
        start = math.radians(150)
        self.assertGreater(late("euler"), math.pi)  # over the top
        self.assertLess(late("implicit-euler"), start / 2)
        for kept in ("rk4", "implicit-midpoint", "verlet"):
            self.assertAlmostEqual(late(kept), start, delta=1e-3)

    def test_the_gyroscope_precesses_with_torque_over_spin_and_stays_level(self):
        omega = G * (0.5 * 0.1 + 0.05 * 0.05) / (0.5 * 0.5 * 0.06 ** 2 * 150)
        times = [0.3, 1.0, 2 * math.pi / omega]
        answer = self.simulate("gyroscope", "--at", ",".join(map(str, times)))
        for t, sample in zip(times, answer["samples"]):
            wheel = sample["links"]["wheel"]["position"]
            for found, expected in zip(wheel, (0.1 * math.cos(omega * t), 0.1 * math.sin(omega * t), 0.18)):
                self.assertAlmostEqual(found, expected, delta=1e-9)

    def test_the_t_handle_turns_over_with_the_period_of_eulers_equations(self):
        small, middle, large = 0.000178, 0.000441066666666667, 0.000597466666666667
        spin, aside = 10.0, 0.01  # about the stem; about the z of the world is about the stem
        twice_energy = middle * spin ** 2 + large * 0 + small * aside ** 2
        square = (middle * spin) ** 2 + (small * aside) ** 2
        # Landau and Lifshitz, Mechanics, section 37: here L^2 < 2 T middle, roles of the ends swapped.
        rate = math.sqrt((middle - small) * (large * twice_energy - square) / (small * middle * large))
        m = ((large - middle) * (square - small * twice_energy) / ((middle - small) * (large * twice_energy - square)))
        half = 2 * quarter_period(m) / rate
        self.assertIn(f"{half:.6f} s", (SCENES / "dzhanibekov.toml").read_text())
        answer = self.simulate("dzhanibekov", "--at", f"0,{half / 2},{half},{2 * half}")
        stem = [sum(a * b for a, b in zip([row[0] for row in s["links"]["handle"]["rotation"]],
                                          s["links"]["handle"]["angular_velocity"])) for s in answer["samples"]]
        for found, expected in zip(stem, (spin, 0, -spin, spin)):
            self.assertAlmostEqual(found, expected, delta=2e-4 * spin)

    def test_small_swings_of_the_double_pendulum_have_the_frequencies_of_two_rods(self):
        answer = self.json_of("modes", "assets/robots/teaching/double_pendulum.urdf")
        found = [mode["frequency"] for mode in answer["modes"]]
        for omega, sign in zip(found, (-1, 1)):
            self.assertAlmostEqual(omega, math.sqrt((3 + sign * 6 / math.sqrt(7)) * G / 0.5), delta=1e-6 * omega)

    def test_two_double_pendulums_part_and_keep_their_energy(self):
        answer = self.simulate("double_pendulum", "--duration", 5, "--every", 1)
        apart = [max(abs(s["q"]["left/" + j] - s["q"]["right/" + j])
                     for j in ("shoulder", "elbow")) for s in answer["samples"]]
        self.assertLess(apart[1], 0.01)
        self.assertGreater(apart[5], 1)
        self.assertLess(abs(answer["energy_balance"]["numerical"]), 1e-5)

    def test_the_papers_experiments_have_the_gains_that_the_study_found(self):
        entries = {e["name"]: e for e in json.loads((ROOT / "assets/study/calibration.json").read_text())["entries"]}
        settings = tomllib.loads((ROOT / "assets/study/settings.toml").read_text())["robot"]
        chosen = entries["chosen"]
        rate = f'{chosen["rate_hz"]:g}'

        def values(name):
            return {p["name"]: p["value"] for p in entries[name]["parameters"]}
        turn, pull = values(f"E3/{rate}/world-"), values(f"E4/{rate}")
        for name in ("e1", "e2", "e3", "e4"):
            with self.subTest(name):
                scene = tomllib.loads((SCENES / f"study_{name}.toml").read_text())
                linear = name in ("e2", "e4")
                self.assertAlmostEqual(scene["step"], 1 / chosen["rate_hz"], delta=1e-15)
                robot, springs = scene["robot"][0], scene["coupling"][:2]
                scale = chosen["numbers"]["arm2_mass_scale"]
                self.assertEqual(set(robot["mass_scale"].values()), {scale})
                payload = [(p["link"], p["point"], p["mass"]) for p in robot.get("payload", [])]
                self.assertEqual(payload, [(m["link"], m["point"], settings["added_mass"])
                                           for m in settings["mount"]] if linear else [])
                gains = [(s["stiffness"], s["damping"]) for s in springs]
                self.assertEqual(gains, [(pull["k1"], pull["b1"]), (pull["k2"], pull["b2"])]
                                 if linear else [(turn["k"], turn["b"])] * 2)
                self.assertEqual({s["type"] for s in springs},
                                 {"published-linear" if linear else "published-torsional"})
                self.assertEqual({s["target"] for s in scene["coupling"][:4]},
                                 {"paper" if name in ("e3", "e4") else "device"})

    def test_the_papers_automatic_runs_miss_as_the_study_says(self):
        for name, published, apart in (("study_e3", (16.6, 23.5), 0.15), ("study_e4", (3.4, 6.0), 0.01)):
            with self.subTest(name):
                answer = self.simulate(name, "--duration", 3, "--every", 1 / 150)
                for joint, most in zip(("joint1", "joint2"), published):
                    miss = max(abs(s["q"][joint] - s["targets"]["pull_joint1"]["q"][joint]) for s in answer["samples"])
                    self.assertAlmostEqual(math.degrees(miss), most, delta=apart * most)


if __name__ == "__main__":
    main()
