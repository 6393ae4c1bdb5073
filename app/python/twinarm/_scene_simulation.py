"""A scene step by step, with a control loop in Python."""
import json
import os

import numpy as np

from twinarm import _core
from twinarm._inspection import Inspection
from twinarm._run import Run
from twinarm._samples import unknown
from twinarm._viewer import view

CONTACT = ("a", "b", "depth", "point", "normal", "force", "torque")
COUPLING = ("force", "error", "target_q", "target_qd")


class SceneSimulation(_core._SceneStepper):
    """A scene (TOML) step by step, as `twinarm simulate` runs it: contacts, couplings, constraints, limits.
    Between steps joint forces (tau) and targets of couplings can be set, by a callback or from outside."""

    def __init__(self, file, *, step=None, integrator='', state=None, contact='', friction=True, armature=True,
                 set=None, record=None):
        """
          step        [s]; default: the scene's
          integrator  one of integrators() with a fixed step; default: the scene's
          state       a state file (JSON)
          contact     'rigid', 'compliant' or 'event'
          set         {path: value}: changes of the scene, as of simulate()
          record      file of a recording of each step, until close(), reset() or the end of a `with` block
        """
        if os.path.splitext(os.fspath(file))[1] != ".toml":
            raise ValueError(f"SceneSimulation: '{file}' is not a scene (TOML); for a robot alone use Simulation")
        super().__init__(file, step, integrator, state, contact, friction, armature, set, record)
        self._file, self._record = os.fspath(file), record
        self._h, self._name_of_integrator, self._units = self._settings()
        if self._name_of_integrator == "dopri5":
            raise ValueError("SceneSimulation needs a fixed step; give integrator='rk4' or another one than dopri5")
        self._of_robot = self._model()
        before = self.tau
        self._set_tau(np.ones(self._of_robot.nv))
        self._drivable = self._now()[4] != 0
        self._set_tau(before)

    # State and settings

    @property
    def t(self):
        """time [s]"""
        return self._now()[0]

    @property
    def steps(self):
        """number of steps taken"""
        return self._now()[1]

    @property
    def q(self):
        """(nq,) coordinates [rad, m]; a copy, set by reset()"""
        return self._now()[2]

    @property
    def qd(self):
        """(nv,) velocities [rad/s, m/s]; a copy, set by reset()"""
        return self._now()[3]

    @property
    def tau(self):
        """(nv,) joint forces [N m, N], constant until set again, in addition to couplings, friction and limits:
        sim.tau = [..] or {'elbow': 3}. At the start those of the state file."""
        return self._now()[4]

    @tau.setter
    def tau(self, value):
        if isinstance(value, dict):
            value = self._by_joint(value, self._of_robot.qd_of, np.zeros(self._of_robot.nv), "tau")
        numbers = np.asarray(value)
        if numbers.shape == self._drivable.shape and numbers.dtype.kind in "fiu":
            for i in np.flatnonzero((numbers != 0) & ~self._drivable):
                raise ValueError(f"tau[{i}] is {numbers[i]:g}, must be 0: it belongs to a free body or a mimic joint")
        self._set_tau(value)

    @property
    def model(self):
        """all bodies of the scene, as one Model; for aba(), crba(), jacobian(), ..."""
        return self._of_robot

    @property
    def h(self):
        """the step [s]"""
        return self._h

    @property
    def integrator(self):
        """its name"""
        return self._name_of_integrator

    @property
    def warnings(self):
        """warnings of the files and of the run"""
        return self._of_robot.warnings + self._warnings()

    # Targets of couplings

    @property
    def couplings(self):
        """names of the couplings"""
        return self._couplings()

    def target_joints(self, coupling=None):
        """Joints of the target robot that set_target() moves, at most three; default: of the first coupling
        that has any."""
        names = self._couplings()
        if coupling is not None:
            return self._target_joints(self._index(coupling))
        return next((joints for joints in map(self._target_joints, range(len(names))) if joints), [])

    def set_target(self, q, qd=None, *, coupling=None, gripper_closed=False):
        """Sets the target robot at the start of the next step: it moves with qd during that step, then rests
        until it is set again. Before the first call it moves as the scene says.

          q, qd     (n,) of target_joints(coupling) [rad, m; rad/s, m/s], or {joint: number}; qd is 0 by default
          coupling  its name; default: every coupling whose target can be set
        """
        names = self._couplings()
        which = range(len(names)) if coupling is None else [self._index(coupling)]
        which = [c for c in which if self._target_joints(c)]
        if not which:
            raise ValueError("set_target(): no target can be set, because " + (
                "the scene has no coupling with a target robot" if coupling is None else
                f"coupling '{coupling}' has no joint with one degree of freedom, or another speed than 1"))
        for c in which:
            places = {joint: n for n, joint in enumerate(self._target_joints(c))}
            target_q, target_qd = self._coupling(c)[2:]
            held = [target_q[self._of_robot.q_of[joint]][0] for joint in places]
            self._set_target(c, self._by_joint(q, places, np.array(held), "target q"),
                             self._by_joint(np.zeros(len(places)) if qd is None else qd, places,
                                            np.zeros(len(places)), "target qd"), bool(gripper_closed))

    def _index(self, coupling):
        names = self._couplings()
        if coupling not in names:
            raise KeyError(unknown("coupling", coupling, names, "couplings"))
        return names.index(coupling)

    def _by_joint(self, value, places, default, what):
        """An array from {joint: number}, or the value itself."""
        if not isinstance(value, dict):
            return value
        for joint, number in value.items():
            if joint not in places:
                raise KeyError(f"{what}: {unknown('joint', joint, places, 'joints')}")
            default[places[joint]] = number
        return default

    # Steps

    def step(self, count=1, control=None):
        """Takes `count` steps. control(sim) is called before each: it returns joint forces, as for tau, or None
        if it has set tau and targets itself. An exception in it ends step() before that step. Raises
        FloatingPointError if the run diverges, with the first body; the state is then invalid until reset()."""
        if count < 0:
            raise ValueError(f"count must not be negative, is {count}")
        if control is None:
            self._step(count)
            return
        if not callable(control):
            raise TypeError(f"control must be a function of the simulation, is a {type(control).__name__}")
        for _ in range(count):
            tau = control(self)
            if tau is not None:
                self.tau = tau
            self._step(1)

    def run(self, duration, control=None, *, every=None):
        """Steps for `duration` [s], with control(sim) before each step. Returns a Run with samples at the start
        and every `every` [s], by default each step; its balances are those since the start or reset(). A run
        that diverges ends there, with the reason in Run.stopped."""
        count, per_sample = self._steps_in("duration", duration), self._steps_in("every", every or self._h)
        samples, stopped = [self._sample()], None
        try:
            while count > 0:
                self.step(min(per_sample, count), control)
                count -= per_sample
                samples.append(self._sample())
        except FloatingPointError as error:
            stopped = {"time": self.t, "step": self.steps, "reason": str(error), "body": "", "joint": "", "field": ""}
        table = {name: np.array([row[name] for row in samples]) for name in ("t", "q", "qd", "tau", "values")}
        targets = {name: np.array([row["targets"][c] for row in samples]) for c, name in enumerate(self._couplings())}
        energy, input_work, momentum = self._balances()
        return Run({**table, "targets": targets, "units": self._units, "model": self._of_robot, "steps": self.steps,
                    "end": self.t, "stopped": stopped, "energy_balance": energy, "momentum": momentum,
                    "input_work": input_work, "contacts": len(self._contacts()), "warnings": self.warnings})

    def _steps_in(self, name, seconds):
        count = seconds / self._h
        if not (np.isfinite(count) and count > 0.5 and abs(count - round(count)) < 1e-6 * count):
            raise ValueError(f"{name} must be a whole number of steps of {self._h:g} s, is {seconds:g} s")
        return round(count)

    def _sample(self):
        t, _, q, qd, tau = self._now()
        targets = [self._coupling(c)[2] for c in range(len(self._couplings()))]
        return {"t": t, "q": q, "qd": qd, "tau": tau, "values": self._values(), "targets": targets}

    # Readings

    def observation(self):
        """The present instant as a dict: t, q, qd, tau; poses (bodies, 4, 4) and velocities (bodies, 6), world
        axes; kinetic_energy, potential_energy [J]; couplings {name: force [N or N m], error (target minus link)
        [m or rad], target_q, target_qd}; contacts, as the property. Forces are those of the last step."""
        t, _, q, qd, tau = self._now()
        kinetic, potential = _core.energy(self._of_robot, q, qd)
        couplings = {name: dict(zip(COUPLING, self._coupling(c))) for c, name in enumerate(self._couplings())}
        return {"t": t, "q": q, "qd": qd, "tau": tau, "poses": _core.poses(self._of_robot, q),
                "velocities": _core.velocities(self._of_robot, q, qd), "kinetic_energy": kinetic,
                "potential_energy": potential, "couplings": couplings, "contacts": self.contacts}

    @property
    def contacts(self):
        """active contact points of the last step, each a dict: a, b (names), depth [m], point [m], normal, and
        force [N] and torque [N m] on b, world axes"""
        return [dict(zip(CONTACT, contact)) for contact in self._contacts()]

    def inspect(self, check=False):
        """What the inspector reads, at this instant: every quantity of ABA of each body, every named force, the
        balance of wrenches, the energy balance; check=True: with the cross-checks. Returns an Inspection."""
        return Inspection(json.loads(self._inspection(bool(check))))

    @property
    def energy_balance(self):
        """{row: work [J]} since the start or reset(); 'numerical' is the residual of the integrator"""
        return self._balances()[0]

    @property
    def momentum(self):
        """{row: (6,)}: balance of angular and linear momentum, world axes [N m s, N s]"""
        return self._balances()[2]

    @property
    def input_work(self):
        """{coupling: work of its target [J]}"""
        return self._balances()[1]

    # Saved states and recordings

    def save(self):
        """Everything that the next steps depend on, as a SavedState for reset()."""
        return self._save()

    def reset(self, state=None, *, q=None, qd=None):
        """To the start, or to a state of save(), bit for bit, with the tau and targets of then; or to the start
        with other coordinates q (nq,) or {joint: number}, and velocities qd. Ends a recording."""
        if state is not None and not isinstance(state, _core.SavedState):
            raise TypeError(f"reset(): state must be a SavedState, of save(), is a {type(state).__name__}")
        if state is not None and (q is not None or qd is not None):
            raise ValueError("reset(): give a state, or q and qd")
        model = self._of_robot
        self._reset(state, self._by_joint(q, model.q_of, model.q.copy(), "q"),
                    self._by_joint(qd, model.qd_of, model.qd.copy(), "qd"))

    def close(self):
        """Ends the recording."""
        self._close()

    def view(self, page=None, *, open=True):
        """Ends the recording (record=) and opens the page that replays it, as twinarm.view()."""
        if self._record is None:
            raise ValueError("view(): nothing is recorded; give SceneSimulation(.., record='out/run.twinrec')")
        self.close()
        return view(self._record, page, open=open)

    def __enter__(self):
        """Itself; the end of the `with` block ends the recording."""
        return self

    def __exit__(self, kind, value, trace):
        """Ends the recording."""
        self.close()

    def __repr__(self):
        return (f"<twinarm.SceneSimulation '{self._of_robot.name}': t = {self.t:g} s, {self.steps} steps of "
                f"{self._h:g} s, {self._name_of_integrator}, nq = {self._of_robot.nq}, "
                f"{len(self._couplings())} couplings>")
