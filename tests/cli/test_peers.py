#!/usr/bin/env python3
"""`bench_peers`: the same scenes in the engines that are there, and that our row is what `twinarm
compare` says. No time is judged.

    test_peers.py PATH/TO/bench_peers PATH/TO/twinarm
"""
import json
import math
import statistics
import subprocess
import sys
import unittest

from waiting import TIMEOUT

PEERS = TWINARM = ""
ORDERS = {"verlet": 2, "midpoint": 2, "heun": 2, "implicit-midpoint": 2, "trapezoid": 2, "rk4": 4,
          "RK4": 4, "Verlet": 2}  # all others 1; of adaptive schemes the power of the tolerance
ENGINES = {"twinarm", "mujoco", "bullet", "dart", "simbody", "ode"}


def run(*arguments, timeout=TIMEOUT):
    return subprocess.run([PEERS, *arguments], capture_output=True, text=True, timeout=timeout)


class Peers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        result = run("--quick", "--cases", "C2,E2-slide,E1")
        assert result.returncode == 0, result.stderr
        cls.answer = json.loads(result.stdout)

    def rows(self, case):
        return [row for row in self.answer["rows"] if row["case"] == case]

    def test_every_engine_has_rows_or_is_said_to_be_missing(self):
        there = {row["engine"] for row in self.rows("C2")}
        self.assertEqual(there | set(self.answer["missing"]), ENGINES)
        self.assertFalse(there & set(self.answer["missing"]))

    def test_every_case_has_rows_of_an_engine_or_why_it_has_none(self):
        refused = {(r["case"], r["engine"]) for r in self.answer["refused"]}
        for case in ("C2", "E2-slide", "E1"):
            there = {(case, row["engine"]) for row in self.rows(case)}
            self.assertFalse(there & refused)
            for engine in ENGINES - set(self.answer["missing"]):
                self.assertIn((case, engine), there | refused)
        self.assertTrue(all(r["why"] for r in self.answer["refused"]))

    def test_our_error_is_the_one_that_compare_finds_with_the_same_scheme_and_step(self):
        schemes = ["verlet", "heun", "rk4"]
        result = subprocess.run([TWINARM, "compare", "C2", "--integrator", ",".join(schemes),
                                 "--json"], capture_output=True, text=True, timeout=TIMEOUT)
        lanes = {lane["integrator"]: lane["error"] for lane in json.loads(result.stdout)["cases"][0]["configurations"]}
        ours = {row["scheme"]: row["error"] for row in self.rows("C2") if row["engine"] == "twinarm"}
        for scheme in schemes:  # the model is built again: another rounding
            self.assertAlmostEqual(ours[scheme] / lanes[scheme], 1, delta=1e-3, msg=scheme)

    def test_every_engine_moves_the_double_pendulum_as_it_moves(self):
        for row in self.rows("C2"):
            self.assertIsNone(row["stopped"], row)
            self.assertLess(row["error"], 0.5, row)  # rad, rad/s, of 13 rad/s; first order, 1 ms
            self.assertGreater(row["seconds"], 0)

    def test_every_engine_slides_the_block_as_far_as_it_slides(self):
        for row in self.rows("E2-slide"):
            if row["stopped"] is None:
                self.assertLess(row["error"], 0.05, row)  # of 0.33 m

    def test_every_scheme_nears_the_same_motion_of_the_arm_at_its_order(self):
        result = run("--quick", "--cases", "PUMA", "--work-precision", "--budget", "1000")
        curves = {}
        for row in json.loads(result.stdout)["work_precision"]:
            if row["stopped"] is None and 1e-10 < row["error"] < 0.3:
                curves.setdefault((row["engine"], row["scheme"]), []).append(
                    (math.log(row["step"] or row["tolerance"]), math.log(row["error"])))
        self.assertLessEqual({engine for engine, _ in curves}, ENGINES)
        for name, points in curves.items():
            slope = statistics.median((b[1] - a[1]) / (b[0] - a[0]) for a, b in zip(points, points[1:]))
            self.assertAlmostEqual(slope, ORDERS.get(name[1], 1), delta=0.2, msg=str(name))
        for engine in ENGINES - set(self.answer["missing"]):  # else it nears another motion
            self.assertIn(engine, {name[0] for name in curves})

    def test_a_run_above_the_budget_is_stopped_and_reported(self):
        result = run("--cases", "E11", "--engines", "twinarm", "--repetitions", "1", "--budget", "1e-3")
        rows = json.loads(result.stdout)["rows"]
        self.assertTrue(all("budget" in row["stopped"] for row in rows))

    def test_bad_options_end_with_2_and_say_which(self):
        for arguments in (["--cases", "C99"], ["--engines", "havok"], ["--budget", "-1"], ["--nonsense"]):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn(arguments[-1], result.stderr)


if __name__ == "__main__":
    PEERS, TWINARM = sys.argv.pop(1), sys.argv.pop(1)
    unittest.main()
