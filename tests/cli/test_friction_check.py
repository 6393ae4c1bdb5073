"""Frictional contact problems of files: solutions that are known, and input that is refused.

    test_friction_check.py PATH/TO/friction_check
"""
import json

from program import ProgramTest, main, run

UNIT = "0 0 1\n1 1 1\n2 2 1\n"  # W of one contact


class FrictionCheck(ProgramTest):
    def run_it(self, text):
        return run(self.write("problem.txt", text))

    def answer(self, text):
        result = self.run_it(text)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return json.loads(result.stdout)

    def test_one_contact_that_opens_sticks_or_slips_is_solved_to_rounding(self):
        for q in ("1 0 0", "-1 0.2 0.1", "-1 3 -4"):
            found = self.answer(f"1\n0.5\n{q}\n{UNIT}")
            self.assertEqual(list(found), ["contacts", "error", "law", "converged", "ms", "newton", "interior", "path"])
            self.assertEqual((found["contacts"], found["converged"]), (1, True), q)
            self.assertLess(found["error"], 1e-9, q)
            self.assertGreaterEqual(found["ms"], 0)

    def test_contacts_that_share_a_body_and_redundant_ones_are_solved(self):
        # A block of 1 kg on four points of one body: W = J J^T of rank 6, contacts 0 and 4 apart.
        points = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
        rows = []
        for x, y in points:  # (normal, tangent, tangent) of v + w x (x, y, -1)
            rows += [[0, 0, 1, y, -x, 0], [1, 0, 0, 0, -1, -y], [0, 1, 0, 1, 0, x]]
        size = len(rows)
        W = [[sum(a * b for a, b in zip(rows[i], rows[j])) for j in range(i + 1)] for i in range(size)]
        lines = [f"{i} {j} {W[i][j]}" for i in range(size) for j in range(i + 1)]
        lines += [f"{size + k} {size + k} 2.5" for k in range(3)]
        q = [-1, 0.1, 0.05] * 4 + [-2, 7, 0]
        found = self.answer(f"5\n{'0.4 ' * 5}\n{' '.join(map(str, q))}\n" + "\n".join(lines))
        self.assertEqual((found["contacts"], found["converged"]), (5, True))
        self.assertLess(found["error"], 1e-8)

    def test_a_small_budget_ends_with_a_larger_error(self):
        # Twelve blocks of 1 kg in a tower: each contact moves the block above it and that below.
        lines = [f"{3 * a + r} {3 * b + r} {2 if a == b and a > 0 else 1 if a == b else -1}"
                 for a in range(12) for b in (a - 1, a) if b >= 0 for r in range(3)]
        text = f"12\n{'0.5 ' * 12}\n{'-1 0.3 0 ' + '0 0 0 ' * 11}\n" + "\n".join(lines)
        exact = self.answer(text)
        early = json.loads(run(self.write("problem.txt", text), "2e4").stdout)
        self.assertEqual((exact["converged"], early["converged"]), (True, False))
        self.assertGreater(early["error"], 100 * exact["error"])
        self.assertLess(early["error"], 1)
        for bad in ("none", "1e5x", "-1", "0"):
            self.assertEqual(run(self.write("problem.txt", text), bad).returncode, 2, bad)

    def test_bad_input_is_refused_with_the_place_and_code_2(self):
        good = f"1\n0.5\n-1 0 0\n{UNIT}"
        self.answer(good)
        for text, words in (("", "no number of contacts"), ("0\n", "no number of contacts"),
                            ("99999999\n", "no number of contacts"),
                            (good.replace("0.5", "-0.5"), "friction coefficient 0"),
                            ("2\n0.5", "friction coefficient 1"),
                            ("1\n0.5\n-1 0", "q[2]"), ("1\n0.5\n-1 x 0", "q[1]"),
                            ("1\n0.5\n0 0 0\n" + UNIT, "q is zero"),
                            (good + "3 0 1", "entry 3 of W"), (good + "0 1 1", "entry 3 of W"),
                            (good + "2 1", "entry 3 of W"), (good + "2 1 x", "entry 3 of W")):
            result = self.run_it(text)
            self.assertEqual((result.returncode, result.stdout), (2, ""), text)
            self.assertIn(words, result.stderr, text)
            self.assertIn("problem.txt", result.stderr)

    def test_help_goes_to_stdout_and_a_missing_file_is_an_error(self):
        self.assertIn("usage: friction_check PROBLEM", self.twinarm("--help").stdout)
        for arguments in ([], ["a", "b"], ["no/such/file"]):
            result = run(*arguments)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertTrue(result.stderr)


if __name__ == "__main__":
    main()
