"""model.workspace(): the names that solver/model/workspace.h states, and the numbers that `twinarm inspect` shows."""
import json
import re

import numpy as np

from notebook import DOUBLE_PENDULUM, ROOT, ProgramTest, every_joint, main, program, states, twinarm


class Workspace(ProgramTest):
    def test_its_names_meanings_units_and_equations_are_those_of_the_solver(self):
        model = twinarm.load(DOUBLE_PENDULUM)
        twinarm.aba(model, [0, 0], [0, 0], [0, 0])
        ws = model.workspace()
        text = (ROOT / "solver/model/workspace.h").read_text(encoding="utf-8")
        stated = re.findall(r'visit\(\{((?:[^{}]|\n)*?)\},\s*(?:this->)?\w+\)', text)
        self.assertGreater(len(stated), 10)
        names = [re.match(r'"(\w+)"', words).group(1) for words in stated]
        self.assertEqual(sorted(ws.keys()), sorted(names))
        self.assertEqual(list(ws), ws.keys())
        self.assertEqual(len(ws), len(names))
        words = {name: re.findall(r'"([^"]*)"', row) for name, row in zip(names, stated)}
        for row in ws.describe():
            self.assertEqual([row["name"], row["meaning"], row["unit"], row["equation"]], words[row["name"]])
            self.assertEqual(row["shape"], ws[row["name"]].shape)
            self.assertIn(row["name"], repr(ws))

    def test_its_numbers_are_those_that_the_program_shows_of_a_robot_with_every_joint(self):
        urdf = self.write("all.urdf", every_joint())
        model = twinarm.load(urdf)
        q, qd, tau = (rows[0] for rows in states(model, 1, seed=3))
        value = lambda place, all: all[place].tolist() if place.stop - place.start > 1 else all[place][0]
        state = {"q": {j: value(p, q) for j, p in model.q_of.items()},
                 "qd": {j: value(p, qd) for j, p in model.qd_of.items()},
                 "tau": {j: value(p, tau) for j, p in model.qd_of.items()}}
        reported = program("inspect", urdf, "--state", self.write("state.json", json.dumps(state)))
        twinarm.aba(model, q, qd, tau)
        ws = model.workspace()
        frames = {row["name"]: row["frame"] for row in ws.describe()}
        seen = set()
        for entry in reported["passes"]:
            body = model.bodies.index(entry["body"])
            place = model.qd_of.get(entry["joint"], slice(0, 0))
            for quantity in entry["quantities"]:
                name = quantity["name"]
                if name not in ws:
                    continue
                seen.add(name)
                found = ws[name]
                if name == "D":
                    found = found[place, place]
                elif name in ("S", "U", "u", "qdd", "tau"):
                    found = found[place]
                else:
                    found = found[body]
                wanted = np.reshape(quantity["value"], found.shape)
                np.testing.assert_allclose(found, wanted, atol=1e-10 * max(1, np.abs(wanted).max()),
                                           err_msg=f'{name} of {entry["body"]}')
                self.assertEqual(frames[name], quantity["frame"])
        self.assertEqual(seen, set(ws) - {"f_ext", "armature", "added_inertia"})  # zero here

    def test_it_is_what_aba_left_last_and_a_copy(self):
        model = twinarm.load(DOUBLE_PENDULUM)
        qdd = twinarm.aba(model, [0.3, -0.2], [1, 2], [0.5, 0])
        ws = model.workspace()
        twinarm.rnea(model, [1, 1], [0, 0], [0, 0])
        twinarm.minv(model, [1, 1])
        np.testing.assert_array_equal(model.workspace()["qdd"], qdd)
        twinarm.aba(model, [1, 1], [0, 0], [0, 0])
        np.testing.assert_array_equal(ws["qdd"], qdd)
        np.testing.assert_array_equal(ws["tau"], [0.5, 0])
        np.testing.assert_array_equal(ws["a"][0], [0, 0, 0, 0, 0, 9.81])
        with self.assertRaises(ValueError):
            ws["qdd"][0] = 1

    def test_the_articulated_inertia_of_the_last_body_is_its_own_and_d_is_what_u_says(self):
        model = twinarm.load(DOUBLE_PENDULUM)
        twinarm.aba(model, [0.3, -0.2], [1, 2], [0.5, 0])
        ws = model.workspace()
        tip = model.bodies.index("lower")
        np.testing.assert_allclose(np.diag(ws["IA"][tip])[3:], [1, 1, 1], rtol=1e-15)
        self.assertAlmostEqual(ws["IA"][tip][1, 1], 1 / 48 + 0.25 ** 2, places=14)
        for k in range(2):
            self.assertAlmostEqual(ws["D"][k, k], ws["S"][k] @ ws["U"][k], places=14)

    def test_a_name_that_is_none_is_reported_with_the_nearest(self):
        model = twinarm.load(DOUBLE_PENDULUM)
        with self.assertRaisesRegex(RuntimeError, "aba"):
            model.workspace()
        twinarm.aba(model, [0, 0], [0, 0], [0, 0])
        self.assertIn("IA", model.workspace())
        self.assertNotIn("IB", model.workspace())
        with self.assertRaisesRegex(KeyError, "qddd.*'qdd'"):
            model.workspace()["qddd"]


if __name__ == "__main__":
    main()
