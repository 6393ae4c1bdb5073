#!/usr/bin/env python3
"""`twinarm hand`: a scene under a device; its log makes the run again.

    test_hand_command.py PROGRAM
"""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

from waiting import TIMEOUT, wait_while_running  # noqa: E402

PROGRAM = None
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = ROOT / "assets/scenes/hand_and_obstacles.toml"


def run(*arguments, code=0):
    done = subprocess.run([PROGRAM, "hand", *map(str, arguments)], capture_output=True, text=True,
                          timeout=TIMEOUT)
    assert done.returncode == code, f"{done.returncode}: {done.stdout}{done.stderr}"
    return done


class Hand(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.out = pathlib.Path(self.folder.name) / "out"

    def tearDown(self):
        self.folder.cleanup()

    def simulated(self, *more, out=None):
        done = run(SCENE, "--simulated", "--json", "--out", out or self.out, *more)
        return json.loads(done.stdout)

    def test_a_simulated_run_is_the_same_twice_and_is_recorded_again_with_the_same_bits(self):
        first = self.simulated("--duration", 1.5, "--record")
        self.assertEqual(first["ticks"], 1500)
        self.assertTrue(first["finite"])
        self.assertTrue(first["same_bits"])
        self.assertTrue(pathlib.Path(first["recording"]).is_file())
        again = self.simulated("--duration", 1.5, out=self.out / "again")
        self.assertEqual((self.out / "hand.csv").read_bytes(),
                         (self.out / "again/hand.csv").read_bytes())
        self.assertEqual(first["tracking"], again["tracking"])

    def test_the_errors_told_are_those_of_the_log_and_the_recording(self):
        told = self.simulated("--duration", 1, "--record")["tracking"]
        lines = (self.out / "hand.csv").read_text().splitlines()
        self.assertEqual(len(lines), 1001)
        column = lines[0].split(",").index("theta1[rad]")
        kinematic = [2 * float(line.split(",")[column]) for line in lines[1:]]
        done = subprocess.run([PROGRAM, "simulate", str(self.out / "scene.toml"), "--every", "0.001",
                               "--json"], capture_output=True, text=True, check=True, timeout=TIMEOUT)
        dynamic = [sample["q"]["joint1"] for sample in json.loads(done.stdout)["samples"]]
        largest = max(abs(k - d) for k, d in zip(kinematic, dynamic))
        self.assertAlmostEqual(largest, told["joint1"]["max"], delta=1e-9)

    def test_each_mapping_says_what_can_be_felt(self):
        words = [run(SCENE, "--simulated", "--duration", 0.2, "--mapping", mapping, "--out",
                     self.out).stdout for mapping in ("paper", "arm", "cartesian")]
        self.assertIn("joint 1 alone", words[0])
        self.assertEqual(len(set(line.split("\n")[2] for line in words)), 3)

    def test_ctrl_c_ends_a_run_in_real_time_with_its_log_whole(self):
        process = subprocess.Popen([PROGRAM, "hand", str(SCENE), "--json", "--out", str(self.out)],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        log = self.out / "hand.csv"
        wait_while_running(process, lambda: log.is_file() and log.stat().st_size > 20000, "20 kB of the log")
        process.send_signal(signal.SIGINT)
        told, errors = process.communicate(timeout=TIMEOUT)
        self.assertEqual(process.returncode, 0, errors)
        summary = json.loads(told)
        lines = log.read_text().splitlines()
        self.assertEqual(len(lines), summary["ticks"] + 1)
        self.assertGreater(summary["timing"]["cpu"]["median"], 0)
        self.assertEqual(summary["timing"]["ticks"], summary["ticks"])

    def test_the_control_and_the_picture_of_the_timing(self):
        done = run(SCENE, "--duration", 1.2, "--control", "--timing", "--json", "--out", self.out)
        summary = json.loads(done.stdout)
        self.assertEqual(summary["timing"]["ticks"], 1200)
        self.assertEqual(summary["empty_loop"]["ticks"], 1000)
        # By the clock it was 2200 ticks: deadlines are absolute, so only the lateness of two of them is left.
        both = (summary["timing"], summary["empty_loop"])
        slipped = sum(kind["slipped"] for kind in both)
        late = max(kind["late"]["largest"] for kind in both)
        self.assertAlmostEqual(summary["span"], (2199 + slipped) * 0.001, delta=late + 0.001 * slipped + 1e-6)
        self.assertIn("<svg", (self.out / "timing.svg").read_text())

    def test_bad_input_is_told_with_its_remedy(self):
        for arguments, words in ((("assets/nothing.toml",), "nothing.toml"),
                                 ((SCENE, "--device", "omni"), "omni"),
                                 ((SCENE, "--mapping", "mirror"), "paper, arm or cartesian"),
                                 ((SCENE, "--duration", "-1"), "positive number of seconds"),
                                 ((SCENE, "--simulated", "--control"), "leave --simulated out"),
                                 ((ROOT / "assets/scenes/four_bar.toml",), 'target = "device"'),
                                 ((ROOT / "assets/robots/s103/s103.urdf",), "it is no scene")):
            done = run(*arguments, "--out", self.out, code=2)
            self.assertIn(words, done.stderr)
            self.assertFalse(self.out.exists(), arguments)

    def test_a_step_beyond_its_range_is_refused_by_its_name(self):
        for step in (3, 0.11, 1e-12):
            error = run(SCENE, "--simulated", "--step", step, "--out", self.out, code=2).stderr
            self.assertIn("--step: with a hand device the step is from 1e-6 to 0.1 s", error)
            self.assertNotIn("delay", error)
        scene = pathlib.Path(self.folder.name) / "slow.toml"
        scene.write_text(f"step = 0.5\n{re.sub('(?m)^step *=.*', '', SCENE.read_text())}")
        error = run(scene, "--simulated", "--out", self.out, code=2).stderr
        self.assertIn("slow.toml: step: with a hand device", error)

    def test_the_list_of_devices_needs_no_scene(self):
        self.assertIn("vrpn", run("--device", "list").stdout)


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
