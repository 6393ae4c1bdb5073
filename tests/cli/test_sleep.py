"""Bodies at rest fall asleep: they keep their bits, wake when anything reaches them, and the balance tells."""
from program import ProgramTest, main

FLOOR = """step = 0.002
[[body]]
name = "floor"
fixed = true
shape = { halfspace = { normal = [%s], offset = 0 } }
"""
BOXES = """[[body]]
name = "low"
shape = { box = { size = [0.2, 0.2, 0.1] } }
mass = 1
position = [0, 0, 0.0505]
[[body]]
name = "high"
shape = { box = { size = [0.2, 0.2, 0.1] } }
mass = 1
position = [0.01, 0.02, 0.152]
"""
BALL = """[[body]]
name = "ball"
shape = { sphere = { radius = 0.05 } }
mass = 1
position = [-3, 0, 0.15]
linear_velocity = [2, 0, 7]
"""
SLEEP = "sleep = 1e-3\n"


class Sleep(ProgramTest):
    def run_of(self, text, duration, *options):
        return self.json_of("simulate", self.write("scene.toml", text), "--duration", duration, "--every", 0.5, *options)

    def heights(self, samples, body):
        return [sample["links"][body]["position"] for sample in samples]

    def test_a_stack_at_rest_keeps_its_bits_and_has_no_velocity(self):
        samples = self.run_of(SLEEP + FLOOR % "0, 0, 1" + BOXES, 3)["samples"]
        after = [sample for sample in samples if sample["t"] > 1.4]
        self.assertGreater(len(after), 2)
        for sample in after:
            self.assertEqual(sample["q"], after[0]["q"])
            self.assertEqual(set(sample["qd"]), {0.0})

    def test_it_stands_where_it_would_stand_awake(self):
        scene = FLOOR % "0, 0, 1" + BOXES
        asleep, awake = (self.run_of(head + scene, 3)["samples"][-1]["q"] for head in (SLEEP, ""))
        for a, b in zip(asleep, awake):
            self.assertAlmostEqual(a, b, delta=1e-5)

    def test_a_ball_wakes_it(self):
        answer = self.run_of(SLEEP + FLOOR % "0, 0, 1" + BOXES + BALL, 3)
        start, end = answer["samples"][2], answer["samples"][-1]
        moved = max(abs(a - b) for a, b in zip(start["q"][:14], end["q"][:14]))
        self.assertGreater(moved, 0.01)

    def test_a_box_that_slides_ever_so_slowly_does_not_fall_asleep(self):
        # Slope 1:2, friction 1e-5 below it: acceleration 1e-5 g cos.
        slope = FLOOR % "-0.4472135954999579, 0, 0.8944271909999159"
        box = """friction = 0.49999
[[body]]
name = "box"
shape = { box = { size = [0.2, 0.2, 0.1] } }
mass = 1
friction = 0.49999
position = [-0.022360679774997897, 0, 0.044721359549995794]
orientation = [0.9732489894677301, 0, -0.22975292054736118, 0]
"""
        scene = slope + box
        asleep, awake = (self.run_of(head + scene, 2)["samples"][-1]["q"] for head in (SLEEP, ""))
        self.assertEqual(asleep, awake)

    def test_the_energy_taken_is_a_row_and_the_balance_closes(self):
        answer = self.run_of(SLEEP + FLOOR % "0, 0, 1" + BOXES + BALL, 3)
        rows = {row["name"]: row["work"] for row in answer["energy_balance"]}
        self.assertLess(rows["sleep"], 0)
        self.assertGreater(rows["sleep"], -1e-5)

    def test_located_events_refuse_it(self):
        result = self.twinarm("simulate", self.write("scene.toml", SLEEP + 'contact = "event"\n' + FLOOR % "0, 0, 1" + BOXES),
                              code=2)
        self.assertIn("sleep", result.stderr)


if __name__ == "__main__":
    main()
