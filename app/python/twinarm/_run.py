"""simulate() and its result."""
from twinarm import _core
from twinarm._samples import Samples, attribute


class Run(Samples):
    """Result of simulate() or SceneSimulation.run(): N samples in rows, energy and momentum balance of the
    run. run['q/elbow'] is a column, run[-1] a sample, run[::10] a run with every tenth sample."""
    _by_row = (*Samples._by_row, "targets", "tau")

    q = attribute("q", "(N, nq) coordinates [rad, m]; model.q_of says which is which")
    qd = attribute("qd", "(N, nv) velocities [rad/s, m/s]; model.qd_of says which is which")
    tau = attribute("tau", "(N, nv) joint forces that the control has set [N m, N]; None for simulate()")
    targets = attribute("targets", "{coupling: (N, nq)}: coordinates of its target robot, as q [rad, m]; joints "
                                   "of other robots are at their start")
    model = attribute("model", "all bodies of the scene, as one Model")
    steps = attribute("steps", "number of steps")
    end = attribute("end", "end of the run; if it diverged the last valid time [s]")
    stopped = attribute("stopped", "None, or why it diverged: time [s], step, reason, body, joint, field")
    energy_balance = attribute("energy_balance", "{row: work [J]}: energy balance; 'numerical' is the residual of "
                                                 "the integrator")
    momentum = attribute("momentum", "{row: (6,)}: balance of angular momentum (about the world's origin) and "
                                     "linear momentum, world axes [N m s, N s]")
    input_work = attribute("input_work", "{coupling: work of its target [J]}")
    contacts = attribute("contacts", "number of active contact points in the last step")
    warnings = attribute("warnings", "warnings of the files and of the run")

    @property
    def kinetic_energy(self):
        """(N,) [J]"""
        return self["kinetic_energy"]

    @property
    def potential_energy(self):
        """(N,) in the field of gravity [J]"""
        return self["potential_energy"]

    def __repr__(self):
        more = [f"{self.steps} steps", f"nq = {self.model.nq}"]
        if self.stopped:
            more.append(f"diverged in step {self.stopped['step']}")
        return self._repr(f" '{self.model.name}'", *more)


def simulate(file, *, duration=None, step=None, integrator='', every=None, state=None, contact='', tolerance=None,
             friction=True, armature=True, set=None, record=None, forces=False):
    """Runs a scene (TOML) or a robot (URDF) as `twinarm simulate` does, with bitwise the same results: contacts,
    couplings, constraints, limits. Defaults are the scene's.

      duration, step  [s]
      integrator      one of integrators()
      every           output interval [s]; default: start and end
      state           a state file (JSON)
      contact         'rigid', 'compliant' or 'event'
      tolerance       of dopri5, relative and absolute
      set             {path: value}: changes of the scene, as by `twinarm replay --set`:
                      {'coupling.pull.stiffness': 800, 'gravity': [0, 0, -1.62]}
      record          file of a recording of each step, for open_recording() and view()
      forces          more columns, as of `--csv --forces`: accelerations, wrenches of joints, constraints, springs
                      and contacts in world axes: run['joint/elbow/fz']

    Returns a Run. If the run diverges it ends, with the reason in Run.stopped.
    """
    return Run(_core._simulate(file, duration, step, integrator, every, state, contact, tolerance, friction,
                               armature, set, record, forces))
