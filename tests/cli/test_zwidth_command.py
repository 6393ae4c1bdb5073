"""`twinarm zwidth`: figures against closed forms, pictures, faults."""
import json
import math
import pathlib
import tempfile
import unittest

from program import main, run

ANSWERS = {}


def answer():
    """One run for all tests: it takes seconds."""
    if "it" not in ANSWERS:
        with tempfile.TemporaryDirectory() as folder:
            done = run("zwidth", "--json", "--svg", f"{folder}/plane.svg")
            assert done.returncode == 0, done.stderr
            ANSWERS["it"] = json.loads(done.stdout)
            ANSWERS["svg"] = pathlib.Path(folder, "plane.svg").read_text(encoding="utf-8")
    return ANSWERS["it"]


class Zwidth(unittest.TestCase):
    def test_stability_limits_of_the_published_device(self):
        rows = {(row["rate"], row["delay_ticks"], row["damping"]): row for row in answer()["walls"]}
        for delay, exact, law in ((0, 2152.5, 2200), (1, 715.7, 2200 / 3)):
            row = rows[1000, delay, 0.1]
            self.assertLess(abs(row["stable_stiffness"] / exact - 1), 0.02)
            self.assertAlmostEqual(row["stable_stiffness_law"], law, 6)

    def test_a_wall_is_passive_up_to_colgates_limit(self):
        for row in answer()["walls"]:
            law = row["damping"] * row["rate"] / (row["delay_ticks"] + 0.5)
            self.assertLess(abs(row["passive_stiffness"] / law - 1), 0.01)
        plane = answer()["plane"]
        for B, K in zip(plane["passive_B"], plane["passive_K"]):
            self.assertLess(abs(K - 2000 * (0.1 - B)), 0.01 * K)
        self.assertEqual(len(plane["stable_B"]), len(plane["stable_K"]))

    def test_quantisation_reduces_stiffness_as_abbott_and_okamura_predict(self):
        seen = 0
        for row in answer()["walls"]:
            if row["delay_ticks"]:
                self.assertIsNone(row["stepped_stiffness"])
                continue
            law = min(2 * row["damping"] * row["rate"], 2 * 0.26 / 5.5e-5)
            self.assertLess(abs(row["stepped_stiffness"] / law - 1), 0.02)
            seen += law < 2 * row["damping"] * row["rate"]
        self.assertGreater(seen, 0)

    def test_a_wall_through_a_coupling_acts_like_both_springs_in_series(self):
        self.assertEqual(len(answer()["series"]), 9)
        for row in answer()["series"]:
            law = row["coupling"] * row["wall"] / (row["coupling"] + row["wall"])
            self.assertLess(abs(row["rendered_stiffness"] / law - 1), 0.005)

    def test_a_delay_of_100_ms_is_passive_only_with_the_controller(self):
        rows = {(row["name"], row["control"]): row for row in answer()["delays"]}
        for (name, control), row in rows.items():
            # Its observed energy is late by at most the work of a tick.
            if control:
                self.assertTrue(row["passive"], name)
                self.assertGreaterEqual(row["lowest_energy"], -row["tick_work"], name)
        self.assertFalse(rows["100 ms", False]["passive"])
        self.assertLess(rows["100 ms", False]["lowest_energy"], -0.01)
        self.assertLess(rows["100 ms", True]["swing"], rows["100 ms", False]["swing"])
        # Without delay the controller does not act.
        self.assertLess(abs(rows["none", True]["force"] - rows["none", False]["force"]), 0.05)

    def test_tracking_errors_of_the_puma_with_six_couplings(self):
        rows = [row for row in answer()["following"] if row["robot"] == "PUMA 560"]
        self.assertEqual({row["joint"] for row in rows}, {f"j{n}" for n in range(1, 7)})
        self.assertEqual(len(rows), 12)
        for row in rows:
            self.assertLess(row["max"], math.radians(30))
            self.assertLessEqual(row["mean"], row["max"])

    def test_rates_without_an_end_to_the_computation_are_refused(self):
        for rate in "1e-300", "0.5", "1e9":
            done = run("zwidth", "--rate", rate)
            self.assertEqual((done.returncode, "1 to 20000" in done.stderr), (2, True), rate)

    def test_the_picture_is_drawn_with_labels(self):
        answer()
        self.assertIn("Virtual walls of a haptic device", ANSWERS["svg"])
        self.assertIn("Colgate", ANSWERS["svg"])


if __name__ == "__main__":
    main()
