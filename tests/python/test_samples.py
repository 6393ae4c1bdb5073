"""Run and Recording as tables: columns, samples, slices, data frames; the page that replays a recording."""
import sys
import types
import unittest.mock

import numpy as np

from notebook import SCENES, ProgramTest, command, main, twinarm

PEG = f"{SCENES}/peg_in_hole.toml"


class Tables(ProgramTest):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "peg.twinrec"
        self.run_ = twinarm.simulate(PEG, duration=0.05, every=0.001, record=self.file)
        self.recording = twinarm.open_recording(self.file)

    def test_run_and_recording_of_a_run_have_the_same_columns_and_numbers_as_the_csv(self):
        csv = command.twinarm("simulate", PEG, "--duration", "0.05", "--every", "0.001", "--csv").stdout.splitlines()
        names = [cell.split("[")[0] for cell in csv[0].split(",")]
        numbers = np.array([[float(cell) for cell in line.split(",")] for line in csv[1:]])
        self.assertEqual(self.run_.keys(), self.recording.keys())
        np.testing.assert_array_equal(numbers[:, 0], self.run_.t)
        compared = 0
        for name in self.run_:
            np.testing.assert_array_equal(self.run_[name], self.recording[name], name)
            if name in names:
                np.testing.assert_array_equal(self.run_[name], numbers[:, names.index(name)], name)
                compared += 1
        self.assertGreater(compared, 10)
        self.assertEqual(self.run_.units, self.recording.units)
        np.testing.assert_array_equal(self.recording.step, range(51))
        np.testing.assert_array_equal(self.run_.kinetic_energy, self.recording["kinetic_energy"])
        self.assertEqual(self.recording.energy_balance["numerical"][-1], self.run_.energy_balance["numerical"])
        self.assertEqual({force.shape for force in self.recording.coupling_forces.values()}, {(51, 3)})

    def test_forces_are_the_columns_of_the_csv(self):
        run = twinarm.simulate(PEG, duration=0.05, every=0.01, forces=True)
        csv = command.twinarm("simulate", PEG, "--duration", "0.05", "--every", "0.01", "--csv",
                              "--forces").stdout.splitlines()
        names = [cell.split("[")[0] for cell in csv[0].split(",")]
        numbers = np.array([[float(cell) for cell in line.split(",")] for line in csv[1:]])
        self.assertEqual([*run], names[1:])
        for column, name in enumerate(names[1:], 1):
            np.testing.assert_array_equal(run[name], numbers[:, column], name)
        self.assertEqual(run.units[next(name for name in names if name.endswith("/alpha_x"))], "rad/s^2")

    def test_an_index_is_a_sample_and_a_slice_a_table(self):
        for table in (self.run_, self.recording):
            name = table.keys()[0]
            self.assertEqual(len(table), 51)
            self.assertEqual(table[-1]["t"], table.t[50])
            self.assertEqual(table[7][name], table[name][7])
            tenth = table[::10]
            self.assertIs(type(tenth), type(table))
            np.testing.assert_array_equal(tenth.t, table.t[::10])
            for key in (name, "kinetic_energy"):
                np.testing.assert_array_equal(tenth[key], table[key][::10])
            np.testing.assert_array_equal(tenth.q, table.q[::10])
            self.assertEqual(len(table[20:30]), 10)
            self.assertIn(name, table)
            self.assertRaises(IndexError, table.__getitem__, 51)
            with self.assertRaisesRegex(KeyError, "no column 'kinetic_enrgy'; did you mean 'kinetic_energy'"):
                table["kinetic_enrgy"]
        self.assertEqual(self.run_[::10].targets.keys(), self.run_.targets.keys())
        np.testing.assert_array_equal(self.recording[::10].energy_balance["gravity"],
                                      self.recording.energy_balance["gravity"][::10])

    def test_they_name_themselves(self):
        self.assertRegex(repr(self.run_), r"<twinarm.Run 'peg_in_hole': 51 samples, t = 0 .. 0.05 s, 50 steps, nq = 5>")
        self.assertRegex(repr(self.recording), r"<twinarm.Recording 'peg.twinrec': 51 samples, t = 0 .. 0.05 s, "
                                               r"semi-implicit, h = 0.001 s, done>")
        self.assertRegex(repr(twinarm.SceneSimulation(PEG)),
                         r"<twinarm.SceneSimulation 'peg_in_hole': t = 0 s, 0 steps")

    def test_a_data_frame_has_time_as_index_and_units(self):
        made = {}

        def frame(values, index, columns):
            made.update(values=values, index=index, columns=columns)
            return types.SimpleNamespace(attrs={})

        pandas = types.SimpleNamespace(DataFrame=frame, Index=lambda t, name: (name, t))
        with unittest.mock.patch.dict(sys.modules, pandas=pandas):
            found = self.run_.to_dataframe()
        self.assertEqual(made["columns"], self.run_.keys())
        self.assertEqual(made["index"][0], "t")
        np.testing.assert_array_equal(made["values"][:, 3], self.run_[made["columns"][3]])
        self.assertEqual(found.attrs["units"], self.run_.units)
        with unittest.mock.patch.dict(sys.modules, pandas=None):
            with self.assertRaisesRegex(ImportError, "needs pandas"):
                self.recording.to_dataframe()


class Viewer(ProgramTest):
    def test_it_writes_the_page_of_the_program_and_opens_it(self):
        with twinarm.SceneSimulation(PEG, record=self.folder / "run.twinrec") as sim:
            sim.run(0.02)
            with unittest.mock.patch("webbrowser.open") as browser:
                page = sim.view()
        self.assertEqual(page, self.folder / "run.html")
        browser.assert_called_once_with(page.as_uri())
        self.assertEqual(len(twinarm.open_recording(self.folder / "run.twinrec")), 21)
        command.twinarm("export", self.folder / "run.twinrec", self.folder / "other.html")
        with unittest.mock.patch("webbrowser.open") as browser:
            again = twinarm.view(twinarm.open_recording(self.folder / "run.twinrec"),
                                 self.folder / "a.html", open=False)
        browser.assert_not_called()
        self.assertEqual(again.read_bytes(), (self.folder / "run.html").read_bytes())
        self.assertEqual(len(again.read_bytes()), len((self.folder / "other.html").read_bytes()))

    def test_it_refuses_what_is_not_recorded(self):
        with self.assertRaisesRegex(twinarm.InputError, "give a recording"):
            twinarm.view(PEG, self.folder / "a.html", open=False)
        with self.assertRaisesRegex(ValueError, "record="):
            twinarm.SceneSimulation(PEG).view()


if __name__ == "__main__":
    main()
