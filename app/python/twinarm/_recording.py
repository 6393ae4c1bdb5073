"""A recording as arrays."""
import os

from twinarm import _core
from twinarm._samples import Samples, attribute


class Recording(Samples):
    """A recording as arrays: N frames in rows (docs/use/record_and_resume.md). rec['q/j1'] is a column, rec[-1]
    a frame, rec[::10] a recording with every tenth frame."""
    _by_row = (*Samples._by_row, "step", "works", "forces")

    step = attribute("step", "(N,) numbers of the steps (integers)")
    integrator = attribute("integrator", "its name")
    h = attribute("h", "the step [s]")
    command = attribute("command", "the command that made it, as a list of words")
    alarms = attribute("alarms", "alarms of the energy balance")
    notes = attribute("notes", "missing or damaged parts")
    end = attribute("end", "how the run ended; '' if unknown")
    file = attribute("file", "its path")

    def _beginning(self, prefix):
        return self._data["values"][:, [name.startswith(prefix) for name in self.keys()]]

    @property
    def q(self):
        """(N, columns 'q/..') coordinates [rad, m], without mimic joints"""
        return self._beginning("q/")

    @property
    def qd(self):
        """(N, columns 'qd/..') velocities [rad/s, m/s]"""
        return self._beginning("qd/")

    @property
    def energy_balance(self):
        """{row: (N,) work since the start [J]}; 0 before a row appears"""
        return dict(zip(self._data["rows"], self._data["works"].T))

    @property
    def coupling_forces(self):
        """{coupling: (N, 3)}: coupling force on the link, world axes [N or N m]"""
        return {name: self._data["forces"][:, c] for c, name in enumerate(self._data["couplings"])}

    def __repr__(self):
        return self._repr(f" '{os.path.basename(self.file)}'", self.integrator, f"h = {self.h:g} s",
                          *([self.end] if self.end else []))


def open_recording(file):
    """Opens a recording of `twinarm simulate --record FILE`, or its valid part. Raises InputError for other
    files."""
    return Recording({**_core._open_recording(file), "file": os.fspath(file)})
