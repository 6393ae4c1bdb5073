"""`twinarm hand`: a scene driven by a device, and its log."""
import json
import pathlib

from program import SCENES, ProgramTest, main

SCENE = SCENES / "hand_and_obstacles.toml"


class Hand(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def simulated(self, *more, out=None):
        return self.json_of("hand", SCENE, "--simulated", "--out", out or self.out, *more)

    def test_a_simulated_run_is_reproducible_and_re_simulated_bit_for_bit(self):
        first = self.simulated("--duration", 1.5, "--record")
        self.assertEqual(first["ticks"], 1500)
        self.assertTrue(first["finite"])
        self.assertTrue(first["same_bits"])
        self.assertTrue(pathlib.Path(first["recording"]).is_file())
        again = self.simulated("--duration", 1.5, out=self.out / "again")
        self.assertEqual((self.out / "hand.csv").read_bytes(), (self.out / "again/hand.csv").read_bytes())
        self.assertEqual(first["tracking"], again["tracking"])

    def test_the_reported_errors_are_those_of_the_log_and_the_recording(self):
        reported = self.simulated("--duration", 1, "--record")["tracking"]
        lines = (self.out / "hand.csv").read_text().splitlines()
        self.assertEqual(len(lines), 1001)
        column = lines[0].split(",").index("theta1[rad]")
        kinematic = [2 * float(line.split(",")[column]) for line in lines[1:]]
        again = self.json_of("simulate", self.out / "scene.toml", "--every", 0.001)
        dynamic = [sample["q"]["joint1"] for sample in again["samples"]]
        largest = max(abs(k - d) for k, d in zip(kinematic, dynamic))
        self.assertAlmostEqual(largest, reported["joint1"]["max"], delta=1e-9)

    def test_each_mapping_says_its_force_feedback(self):
        words = [self.twinarm("hand", SCENE, "--simulated", "--duration", 0.2, "--mapping", mapping, "--out",
                              self.out).stdout for mapping in ("paper", "arm", "cartesian")]
        self.assertIn("joint 1 only", words[0])
        self.assertEqual(len(set(line.split("\n")[2] for line in words)), 3)

    def test_low_pass_and_passivity_controller_are_options(self):
        torques = [self.simulated("--duration", 0.5, *words)["largest_torque"]
                   for words in ([], ["--low-pass", 0], ["--low-pass", 2], ["--no-passivity"])]
        self.assertEqual(torques[0], torques[1])
        self.assertNotEqual(torques[2], torques[0])
        self.assertNotEqual(torques[3], torques[0])
        self.assertIn("0 or more", self.faults("hand", SCENE, "--low-pass", -1)[0]["problem"])

    def test_ctrl_c_ends_a_run_in_real_time_with_a_complete_log(self):
        log = self.out / "hand.csv"
        reported, _ = self.interrupted("hand", SCENE, "--json", "--out", self.out, code=0,
                                       is_ready=lambda _: log.is_file() and log.stat().st_size > 20000)
        summary = json.loads(reported)
        lines = log.read_text().splitlines()
        self.assertEqual(len(lines), summary["ticks"] + 1)
        self.assertGreater(summary["timing"]["cpu"]["median"], 0)
        self.assertEqual(summary["timing"]["ticks"], summary["ticks"])

    def test_the_control_and_the_picture_of_the_timing(self):
        summary = self.json_of("hand", SCENE, "--duration", 1.2, "--empty-loop", "--timing", "--out", self.out)
        self.assertEqual(summary["timing"]["ticks"], 1200)
        self.assertEqual(summary["empty_loop"]["ticks"], 1000)
        # By the clock it was 2200 ticks: deadlines are absolute, so only the lateness of two of them is left.
        both = (summary["timing"], summary["empty_loop"])
        slipped = sum(kind["slipped"] for kind in both)
        late = max(kind["late"]["largest"] for kind in both)
        self.assertAlmostEqual(summary["span"], (2199 + slipped) * 0.001, delta=late + 0.001 * slipped + 1e-6)
        self.assertIn("<svg", (self.out / "timing.svg").read_text())

    def test_the_list_of_devices_needs_no_scene(self):
        self.assertIn("vrpn", self.twinarm("hand", "--device", "list").stdout)


if __name__ == "__main__":
    main()
