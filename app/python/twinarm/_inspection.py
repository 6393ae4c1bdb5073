"""The quantities of ABA and the forces of one instant."""
import numpy as np

from twinarm._samples import unknown


class Inspection(dict):
    """What `twinarm inspect --json` prints, of the present instant of a SceneSimulation: 'passes', 'forces',
    'balances', 'joints', 'checks', .. (docs/use/inspect_a_state.md)."""

    def quantity(self, name, body):
        """A quantity of ABA of one body, by its name in RBDA: quantity('IA', 'arm1'), link axes, as an array."""
        rows = [row for row in self["passes"] if row["body"] == body]
        if not rows:
            bodies = list(dict.fromkeys(row["body"] for row in self["passes"]))
            raise KeyError(unknown("body", body, bodies, "bodies"))
        values = {one["name"]: one["value"] for row in rows for one in row["quantities"]}
        if name not in values:
            raise KeyError(unknown("quantity", name, values, "quantities"))
        return np.array(values[name], dtype=float)

    def force(self, source):
        """A named force, such as 'coupling/pull': a dict with point, 'on' (body, force [N], torque [N m]), .."""
        for force in self["forces"]:
            if force["source"] == source:
                return force
        raise KeyError(unknown("force", source, [force["source"] for force in self["forces"]], "forces"))
