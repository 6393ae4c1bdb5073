#!/usr/bin/env python3
"""Numerical dissipation of implicit springs: how much energy do they remove?  Lesson 10, from Python.

A spring of 10 rad/s without a damper, stepped implicitly. Write down before you run: the remaining amplitude after
2 s at 20 ms; and with gravity, is the static deflection smaller, larger or equal to that with an explicit spring?
"""
import numpy as np
import twinarm

from lesson import folder_of, picture, say

SCENE = folder_of(__file__) / "swing.toml"

# %% Three steps; the energy balance lists the dissipation
runs = {h: twinarm.simulate(SCENE, step=h, every=0.02) for h in (0.001, 0.01, 0.02)}
left = {}
for h, run in runs.items():
    energy = run.kinetic_energy + 0.5 * 100.144 * run.q[:, 0] ** 2
    left[h] = energy[-1] / energy[0]
    say(f"step {h} s: removed by the discretization [J]", run.energy_balance["coupling/hold/implicit"])
    say(f"step {h} s: energy left", left[h])

# %% With gravity and a damper, target horizontal: the static deflection does not depend on it
for discretization in ("explicit", "implicit"):
    sagged = twinarm.simulate(SCENE, duration=10, set={
        "coupling.discretization": discretization, "coupling.damping": 20, "coupling.target.q.hinge": np.pi / 2,
        "gravity": [0, 0, -9.81]})
    say(f"{discretization}: static deflection [rad]", np.pi / 2 - sagged.q[-1, 0])

# %% The trap: a damping ratio that is not a property of the robot
say("damping ratio at 10 ms", -np.log(left[0.01]) / (2 * 10 * 2))

# %% Picture
picture(__file__, "t [s]", ("angle [rad]", {f"{1e3 * h:.0f} ms": (run.t, run.q[:, 0]) for h, run in runs.items()}))
