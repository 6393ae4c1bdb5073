"""`twinarm trial`: a user study, with a trace as the operator."""
import csv
import math
import subprocess

from program import ProgramTest, main
from robot_command import HAND_COLUMNS

L1, L2 = 0.25, 0.35  # of the S-103's arms [m]
OBJECT, GOAL = (0.42, 0.28), (0.42, -0.28)


def angles_at(place):
    """Angles of joints 1 and 2, elbow to the left."""
    x, y = place
    cosine = (x * x + y * y - L1 * L1 - L2 * L2) / (2 * L1 * L2)
    q2 = -math.acos(cosine)
    return math.atan2(y, x) - math.atan2(L2 * math.sin(q2), L1 + L2 * math.cos(q2)), q2


def trace_of(stops):
    """CSV trace of [(time, robot angles, button)] with minimum-jerk motions in between."""
    lines = [HAND_COLUMNS.strip() + ",button"]
    n = 0
    for (t0, a, _), (t1, b, _) in zip(stops, stops[1:]):
        while n * 0.005 < t1:
            s = (n * 0.005 - t0) / (t1 - t0)
            s = s**3 * (10 - 15 * s + 6 * s * s)
            q1, q2 = (a[i] + s * (b[i] - a[i]) for i in range(2))
            button = [pressed for t, _, pressed in stops if t <= n * 0.005][-1]
            lines.append(f"{n * 0.005:.4f},{q1 / 2:.6f},0.9,0.2,{q2:.6f},0.3,0,{button}")
            n += 1
    return "\n".join(lines) + "\n"


class Trial(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out, self.hand = self.folder / "trial", self.folder / "hand.csv"

    def trial(self, *more):
        return self.json_of("trial", "--device", f"virtual:trace:{self.hand}", "--simulated", "--out", self.out, *more,
                            stdin=subprocess.DEVNULL)

    def carries(self, to=GOAL, rest=1.5):
        there, away = angles_at(OBJECT), angles_at(to)
        self.hand.write_text(trace_of([(0, (0, 0), 0), (1.5, there, 0), (1.5 + rest, there, 1),
                                       (4.5 + rest, away, 1), (6 + rest, away, 0),
                                       (8 + rest, away, 0)]))

    def test_the_task_is_done_when_the_object_is_released_at_the_goal(self):
        self.carries()
        reported = self.trial("--tasks", "pick-and-place", "--time-limit", 20)
        self.assertEqual([r["condition"] for r in reported["results"]], ["torsional", "linear", "kinematic"])
        for result in reported["results"]:
            self.assertTrue(result["done"], result)
            self.assertEqual((result["picks"], result["drops"]), (1, 0))
            self.assertLess(abs(result["seconds"] - 7.5), 0.1)  # the button is released at 7.5 s
            self.assertLess(abs(result["picked_at"] - 3.0), 0.1)
            self.assertLess(result["placement_error_mm"], 30)
        self.assertEqual(reported["results"][2]["max_deg"], [])  # no tracking error of the target robot
        self.assertGreater(reported["results"][0]["max_deg"][0], 0.1)

    def test_an_object_released_elsewhere_is_a_drop_and_no_success(self):
        self.carries(to=(0.45, -0.15))
        reported = self.trial("--tasks", "pick-and-place", "--time-limit", 12, "--conditions", "kinematic")
        result = reported["results"][0]
        self.assertFalse(result["done"])
        self.assertEqual((result["picks"], result["drops"]), (1, 1))
        self.assertAlmostEqual(result["seconds"], 12, delta=0.01)
        self.assertAlmostEqual(result["placement_error_mm"], 1e3 * math.hypot(0.03, 0.13), delta=10)

    def test_the_table_of_all_subjects_grows_and_has_no_names(self):
        self.carries()
        first = self.trial("--tasks", "free", "--seconds", 1)
        self.assertEqual(first["participant"], "S1")
        second = self.trial("--tasks", "free", "--seconds", 1, "--seed", 2)
        self.assertEqual(second["participant"], "S2")
        rows = list(csv.DictReader((self.out / "results.csv").read_text().splitlines()))
        self.assertEqual([row["participant"] for row in rows], ["S1"] * 3 + ["S2"] * 3)
        self.assertEqual({row["condition"] for row in rows[3:]}, {"torsional", "linear", "kinematic"})
        self.assertAlmostEqual(float(rows[0]["joint1_max[deg]"]), first["results"][0]["max_deg"][0], delta=1e-4)

    def test_the_log_of_a_task_repeats_the_run(self):
        self.carries()
        reported = self.trial("--tasks", "free", "--seconds", 3, "--conditions", "linear")
        scene = self.out / "S1/linear.toml"
        log = reported["results"][0]["log"]
        scene.write_text(scene.read_text().replace('"device"', f'"{log}"'))
        sample = self.json_of("simulate", scene, "--duration", 3)["samples"][-1]
        # At the object after 1.5 s.
        for joint, angle in zip(("joint1", "joint2"), angles_at(OBJECT)):
            self.assertAlmostEqual(sample["q"][joint], angle, delta=0.05)

    def test_a_task_or_condition_that_is_given_twice_is_refused(self):
        for words in (["--tasks", "free,free"], ["--conditions", "linear,kinematic,linear"]):
            (fault,) = self.faults("trial", "--device", "virtual", "--out", self.out, *words)
            self.assertEqual(fault["where"], words[0])
            self.assertIn("given twice", fault["problem"])
        self.assertFalse(self.out.exists())

    def test_no_cell_of_the_table_is_a_formula_for_a_spreadsheet(self):
        self.carries()
        self.trial("--tasks", "free", "--seconds", 0.1, "--conditions", "linear", "--participant=-1")
        self.assertTrue((self.out / "results.csv").read_text().splitlines()[1].startswith("'-1,1,linear,free,"))
        for name in ("=1+1", "@x", "../S2"):
            self.assertIn("letters, digits", self.faults("trial", "--participant", name)[0]["problem"])

    def test_a_file_with_another_header_is_not_changed(self):
        self.out.mkdir()
        (self.out / "results.csv").write_text("something else\n")
        for words in ((), ("--participant", "S1", "--tasks", "free", "--seconds", "0.1")):
            done = self.twinarm("trial", "--device", "virtual", *words, "--simulated", "--out", self.out, code=2)
            self.assertIn("another folder", done.stderr)
        self.assertEqual((self.out / "results.csv").read_text(), "something else\n")

    def test_results_of_finished_tasks_are_kept_when_a_later_task_fails(self):
        self.twinarm("trial", "--device", "virtual", "--tasks", "free", "--seconds", 0.2, "--out", self.out,
                     input="\n", code=2)  # no second line
        rows = list(csv.DictReader((self.out / "results.csv").read_text().splitlines()))
        self.assertEqual([(row["order"], row["condition"]) for row in rows], [("1", "torsional")])

    def test_without_a_terminal_yes_is_required(self):
        done = self.twinarm("trial", "--device", "virtual", "--tasks", "free", "--out", self.out, code=2,
                            stdin=subprocess.DEVNULL)
        self.assertIn("--yes", done.stderr)


if __name__ == "__main__":
    main()
