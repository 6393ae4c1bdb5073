#!/usr/bin/env python3
"""`bench_contact` with heaps: twinarm holds them in the container. No time is judged.

    test_contact_bench.py PATH/TO/bench_contact
"""
import json
import subprocess
import sys
import unittest

from waiting import TIMEOUT

PROGRAM = ""


class Heaps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        result = subprocess.run([PROGRAM, "--models", "spheres30,boxes30", "--engines", "twinarm double"],
                                capture_output=True, text=True, timeout=TIMEOUT)
        assert result.returncode == 0, result.stderr
        cls.rows = json.loads(result.stdout)["rows"]

    def test_all_bodies_stay_in_the_container(self):
        self.assertEqual(len(self.rows), 6)  # three configurations of the contact solver
        for row in self.rows:
            with self.subTest(row["engine"], heap=row["model"]):
                self.assertEqual((row["bodies"], row["escaped"]), (30, 0))
                self.assertLess(row["largest_penetration"], 0.02)

    def test_the_laws_of_contact_hold_to_the_accuracy_where_a_step_converged(self):
        for row in self.rows:
            if row["unconverged"] == 0:
                with self.subTest(row["engine"], heap=row["model"]):
                    accuracy = 1e-4 if row["engine"].endswith("accuracy 1e-4") else 5e-9
                    self.assertLessEqual(row["residual"], accuracy)

    def test_times_of_a_step_are_in_order(self):
        for row in self.rows:
            self.assertLessEqual(row["median_ns"], row["worst_ns"])
            self.assertLessEqual(row["ns"], row["worst_ns"])


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
