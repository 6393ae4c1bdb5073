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
        file = self.write("scene.toml", text)
        return self.json_of("simulate", file, "--duration", duration, "--every", 0.5, *options)

    def test_a_stack_at_rest_keeps_its_bits_and_has_no_velocity(self):
        samples = self.run_of(SLEEP + FLOOR % "0, 0, 1" + BOXES, 3)["samples"]
        after = [sample["links"] for sample in samples if sample["t"] > 0.9]
        self.assertGreater(len(after), 2)
        for links in after:
            self.assertEqual(links, after[0])
            for link in links.values():
                self.assertEqual(set(link["linear_velocity"] + link["angular_velocity"]), {0.0})

    def test_it_stands_where_it_would_stand_awake(self):
        scene = FLOOR % "0, 0, 1" + BOXES
        asleep, awake = (self.run_of(head + scene, 3)["samples"][-1]["links"] for head in (SLEEP, ""))
        for body in ("low", "high"):
            for a, b in zip(asleep[body]["position"], awake[body]["position"]):
                self.assertAlmostEqual(a, b, delta=1e-9)

    def test_a_ball_wakes_it_as_it_would_push_it_awake(self):
        scene = FLOOR % "0, 0, 1" + BOXES + BALL
        asleep, awake = (self.run_of(head + scene, 3)["samples"] for head in (SLEEP, ""))
        self.assertEqual(asleep[2]["links"]["high"]["linear_velocity"], [0, 0, 0])
        x = [run[-1]["links"]["high"]["position"][0] for run in (asleep, awake)]
        self.assertGreater(x[0] - 0.01, 0.005)
        self.assertAlmostEqual(x[0], x[1], delta=1e-6)

    def test_a_box_that_slides_ever_so_slowly_does_not_fall_asleep(self):
        # Slope 1:2, friction 2e-4 below it: it reaches the speed in 0.6 s.
        slope = FLOOR % "-0.4472135954999579, 0, 0.8944271909999159"
        box = """friction = 0.4998
[[body]]
name = "box"
shape = { box = { size = [0.2, 0.2, 0.1] } }
mass = 1
friction = 0.4998
position = [-0.022360679774997897, 0, 0.044721359549995794]
orientation = [0.9732489894677301, 0, -0.22975292054736118, 0]
"""
        scene = slope + box
        asleep, awake = (self.run_of(head + scene, 2)["samples"][-1]["links"] for head in (SLEEP, ""))
        self.assertEqual(asleep, awake)
        self.assertGreater(max(map(abs, asleep["box"]["linear_velocity"])), 1e-4)

    def test_the_energy_taken_is_a_row_and_the_balance_closes(self):
        box = """friction = 0
[[body]]
name = "box"
shape = { box = { size = [0.2, 0.2, 0.1] } }
mass = 2
position = [0, 0, 0.05]
linear_velocity = [0.005, 0, 0]
"""
        answer = self.run_of("sleep = 0.01\n" + FLOOR % "0, 0, 1" + box, 2)
        works = answer["energy_balance"]
        self.assertAlmostEqual(works["sleep"], -0.5 * 2 * 0.005**2, delta=1e-12)
        self.assertAlmostEqual(works["numerical"], 0, delta=1e-10)
        self.assertAlmostEqual(answer["momentum"]["sleep"]["linear"][0], -2 * 0.005, delta=1e-12)
        self.assertAlmostEqual(answer["momentum"]["numerical"]["linear"][0], 0, delta=1e-12)

    def test_located_events_refuse_it(self):
        scene = SLEEP + 'contact = "event"\n' + FLOOR % "0, 0, 1" + BOXES
        result = self.twinarm("simulate", self.write("scene.toml", scene), code=2)
        self.assertIn("sleep", result.stderr)


if __name__ == "__main__":
    main()
