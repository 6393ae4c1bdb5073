"""What a Run and a Recording have in common: a table with a row for each time, a column for each quantity."""
from twinarm import _core


def unknown(what, name, names, kind):
    """Message for a name that does not exist, with the nearest one that does."""
    return f"there is no {what} '{name}'; {_core._remedy(str(name), list(names), kind)}"


def attribute(name, doc):
    """A read-only property that returns self._data[name]."""
    return property(lambda self: self._data[name], doc=doc)


class Samples:
    """N samples in rows. Columns by name: 'q/elbow', 'qd/elbow', 'links/hand/x', 'kinetic_energy'."""
    _by_row = ("t", "q", "qd", "values")

    def __init__(self, data):
        self._data = data

    t = attribute("t", "(N,) times [s]")
    units = attribute("units", "{column: unit}")

    def keys(self):
        """Names of the columns, in their order: coordinates and velocities of the robots' joints, positions
        of the links' origins, energies."""
        return list(self.units)

    def __len__(self):
        """N, the number of samples."""
        return len(self.t)

    def __contains__(self, name):
        """Whether there is a column of this name."""
        return name in self.units

    def __iter__(self):
        """Over the names of the columns."""
        return iter(self.keys())

    def __getitem__(self, key):
        """samples['q/elbow']: a column (N,), its unit is in units. samples[10], samples[-1]: one sample as
        {column: number}, with 't'. samples[10:20], samples[::5]: the same with fewer rows. Raises KeyError
        for another name, IndexError for another row."""
        if isinstance(key, str):
            names = self.keys()
            if key not in self.units:
                raise KeyError(unknown("column", key, names, "columns"))
            return self._data["values"][:, names.index(key)]
        if isinstance(key, slice):
            return type(self)({name: self._rows(name, value, key) for name, value in self._data.items()})
        row = range(len(self))[key]  # IndexError, or TypeError for what is no index
        return {"t": float(self.t[row]), **dict(zip(self.keys(), self._data["values"][row].tolist()))}

    def _rows(self, name, value, rows):
        if name not in self._by_row or value is None:
            return value
        if isinstance(value, dict):
            return {key: one[rows] for key, one in value.items()}
        return value[rows]

    def to_dataframe(self):
        """A pandas.DataFrame: index t [s], the columns of keys(); units in its attrs['units']. Needs pandas."""
        try:
            import pandas
        except ImportError:
            raise ImportError("to_dataframe() needs pandas: install python3-pandas") from None
        frame = pandas.DataFrame(self._data["values"], index=pandas.Index(self.t, name="t"), columns=self.keys())
        frame.attrs["units"] = dict(self.units)
        return frame

    def _repr(self, what, *more):
        span = f"t = {self.t[0]:g} .. {self.t[-1]:g} s" if len(self) else "no samples"
        return f"<twinarm.{type(self).__name__}{what}: {', '.join([f'{len(self)} samples', span, *more])}>"
