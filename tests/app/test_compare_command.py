#!/usr/bin/env python3
"""`twinarm compare`: what it runs, what it tells, how it ends.

    test_compare_command.py PATH/TO/twinarm
"""
import json
import os
import signal
import subprocess
import sys
import time
import unittest

PROGRAM = ""


def run(*arguments, timeout=120):
    return subprocess.run([PROGRAM, "compare", *arguments], capture_output=True, text=True,
                          timeout=timeout)


class Compare(unittest.TestCase):
    def answer(self, *arguments):
        result = run(*arguments, "--json")
        self.assertEqual(result.stderr, "")
        answer = json.loads(result.stdout)
        self.assertEqual(result.returncode, 1 if answer["failed"] else 0)
        self.assertEqual(answer["passed"] + answer["failed"], len(answer["cases"]))
        self.assertEqual(sum(c["pass"] for c in answer["cases"]), answer["passed"])
        return answer

    def test_a_case_has_all_its_keys_and_passes_where_its_error_is_within_the_tolerance(self):
        answer = self.answer("D7", "E6-momentum", "E2-creep")
        self.assertEqual([c["name"] for c in answer["cases"]], ["D7", "E6-momentum", "E2-creep"])
        self.assertEqual(list(answer), ["cases", "passed", "failed", "skipped"])
        for case in answer["cases"]:
            self.assertEqual(list(case), ["name", "group", "error", "tolerance", "pass", "order",
                                          "energy_drift", "reference", "seconds"])
            self.assertEqual(case["pass"], case["error"] <= case["tolerance"])
            self.assertGreaterEqual(case["seconds"], 0)
        self.assertEqual(answer["skipped"], [])

    def test_a_short_name_means_all_that_it_begins(self):
        names = [c["name"] for c in self.answer("E6")["cases"]]
        self.assertIn("E6-two", names)
        self.assertTrue(all(name.startswith("E6-") for name in names), names)

    def test_a_group_and_names_add_up_and_energy_is_told_where_it_is_kept(self):
        asked = ["D3", "D4", "D5-springs", "D5-rods", "E6-two"]
        answer = self.answer(*asked, "--group", "robots")
        self.assertEqual([c["name"] for c in answer["cases"] if c["group"] != "robots"], asked)
        self.assertGreater(len(answer["cases"]), len(asked) + 4)
        loops = {c["name"]: c for c in answer["cases"]}
        self.assertLess(loops["D4"]["energy_drift"], 1e-8)
        self.assertLess(loops["D3"]["energy_drift"], 1e-8)  # the motor's work counted
        self.assertIsNone(loops["D5-springs"]["energy_drift"])  # dampers take it
        self.assertAlmostEqual(loops["D5-rods"]["order"], 4, delta=0.1)

    def test_people_get_a_table_with_a_row_for_each_and_the_sums(self):
        result = run("E6-two", "D7")
        rows = result.stdout.splitlines()
        self.assertEqual(rows[0].split(), ["case", "error", "tolerance", "order", "energy",
                                           "seconds"])
        self.assertEqual([row.split()[0] for row in rows[1:3]], ["D7", "E6-two"])
        self.assertEqual([row.split()[3] for row in rows[1:3]], ["pass", "pass"])
        self.assertEqual(rows[-1], "2 passed, 0 failed")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_a_letter_and_the_name_of_a_group_stand_for_all_of_it(self):
        by_letter = self.answer("A")
        self.assertEqual({c["group"] for c in by_letter["cases"]}, {"free-body"})
        self.assertEqual([c["name"] for c in by_letter["cases"]],
                         [c["name"] for c in self.answer("free-body")["cases"]])
        self.assertTrue(all(c["pass"] for c in by_letter["cases"]))

    def test_a_known_motion_tells_its_order_and_other_integrators_stand_beside(self):
        answer = self.answer("A2", "B9-free", "D7", "--integrator", "verlet,dopri5",
                             "--step", "0.002,0.001")
        rows = {c["name"]: c for c in answer["cases"]}
        self.assertAlmostEqual(rows["A2"]["order"], 4, delta=0.1)
        self.assertLess(rows["A2"]["energy_drift"], 1e-12)
        self.assertIsNone(rows["B9-free"]["order"])  # exact but for rounding
        self.assertEqual(rows["D7"]["lanes"], [])
        lanes = rows["A2"]["lanes"]
        self.assertEqual([(lane["integrator"], lane["step"], lane["tolerance"]) for lane in lanes],
                         [("verlet", 0.002, None), ("verlet", 0.001, None),
                          ("dopri5", None, 1e-10)])
        self.assertAlmostEqual(lanes[0]["error"] / lanes[1]["error"], 4, delta=0.1)
        self.assertAlmostEqual(lanes[0]["order"], 2, delta=0.1)
        table = run("A2", "D7", "--integrator", "verlet", "--step", "0.002").stdout.splitlines()
        self.assertIn("verlet 0.002", table[0])
        self.assertEqual([row.split()[-1] for row in table if row.startswith("D7")], ["-"])

    def test_the_outcome_of_a_case_does_not_depend_on_what_runs_beside_it(self):
        together = {c["name"]: c for c in self.answer("A", "B2", "D7")["cases"]}
        for name in ("A1", "A5-momentum", "B2-over"):
            alone = self.answer(name)["cases"][0]
            del alone["seconds"]
            self.assertEqual(alone, {k: together[name][k] for k in alone})

    def test_what_is_not_run_is_listed_with_the_reason_and_never_counted(self):
        answer = self.answer("F5", "D7")
        self.assertEqual([c["name"] for c in answer["cases"]], ["D7"])
        self.assertEqual([c["name"] for c in answer["skipped"]], ["F5"])
        self.assertGreater(len(answer["skipped"][0]["why"]), 10)
        self.assertEqual(run("F5", "D7").stdout.splitlines()[-1], "1 passed, 0 failed, 1 skipped")

    def test_whatever_has_no_data_or_no_model_is_skipped_and_nothing_is_passed_for_it(self):
        names = ["D8", "E14-capstan", "E15", "F5", "H1-anymal", "H2", "H3"]
        answer = self.answer(*names)
        self.assertEqual([c["name"] for c in answer["skipped"]], names)
        self.assertEqual((answer["cases"], answer["passed"], answer["failed"]), ([], 0, 0))

    def test_robots_and_couplings_are_group_f(self):
        answer = self.answer("F1", "F2", "F3-joint", "F4-euler")
        rows = {c["name"]: c for c in answer["cases"]}
        self.assertEqual({c["group"] for c in answer["cases"]}, {"robots", "couplings"})
        self.assertTrue(all(c["pass"] for c in answer["cases"]), answer["cases"])
        self.assertTrue({"F1-published", "F2-velocity", "F3-joint-mean", "F4-euler-difference"}
                        <= set(rows))
        self.assertAlmostEqual(rows["F3-joint"]["order"], 4, delta=0.2)

    def test_wrong_lanes_are_told_together_with_wrong_names(self):
        result = run("A11", "--integrator", "rk5", "--step", "0,0.1", "--json")
        errors = json.loads(result.stdout)["errors"]
        self.assertEqual((result.returncode, len(errors)), (2, 3), errors)
        self.assertIn("A1", errors[0]["remedy"])
        self.assertIn("rk4", errors[1]["remedy"])

    def test_all_unknown_names_are_told_at_once_with_the_nearest_and_nothing_runs(self):
        result = run("E6-tow", "D7", "D77", "--group", "lops", "--json")
        self.assertEqual(result.returncode, 2)
        errors = json.loads(result.stdout)["errors"]
        self.assertEqual(len(errors), 3, errors)
        self.assertIn("E6-two", errors[0]["remedy"])
        self.assertIn("loops", errors[2]["remedy"])
        self.assertEqual(len(result.stderr.splitlines()), 3)

    def test_ctrl_c_ends_it_with_130_and_no_half_answer(self):
        process = subprocess.Popen([PROGRAM, "compare", "--json"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual((process.returncode, out), (130, ""), err)
        self.assertIn("interrupted", err)


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
