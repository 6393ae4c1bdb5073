#!/usr/bin/env python3
"""Closed loops and constraint forces: which forces act in a joint of a loop?  Lesson 6, from Python.

A slider-crank is a chain that a pin closes. Write down before you run: the force in the pin, and whether it pulls or
pushes the piston; whether the four-bar linkage moves, of which Gruebler's count says -5 freedoms.
"""
import numpy as np
import twinarm

from lesson import crossings, picture, say

ENGINE = "assets/scenes/slider_crank.toml"
chain = twinarm.load(ENGINE)
q, qd = chain.q, chain.qd

# %% M qdd + C = J^T f and J qdd + Jdot qd = 0: one linear system for the accelerations and the pin's force f


def apart(q):
    """(3, nv): velocity of the pin at the rod less that at the piston. The pin is 0.4 m along x at the start."""
    rows = []
    for link in ("rod", "piston"):
        pose = twinarm.poses(chain, chain.q)[chain.bodies.index(link)]
        point = pose[:3, :3].T @ (np.array([0.4, 0, 0]) - pose[:3, 3])
        rows.append(twinarm.jacobian(chain, q, link, point)[3:])
    return rows[0] - rows[1]


J, d = apart(q), 1e-5
Jdot_qd = (apart(q + d * qd) - apart(q - d * qd)) @ qd / (2 * d)
M, C = twinarm.crba(chain, q), twinarm.rnea(chain, q, qd, 0 * qd)
system = np.block([[M, -J.T], [J, np.zeros((3, 3))]])
on_rod = np.linalg.lstsq(system, np.concatenate([-C, -Jdot_qd]), rcond=None)[0][chain.nv:]
say("force of the pin on the piston, along x [N]", -on_rod[0])

# %% The engine runs: the loop stays closed, the energy stays
run = twinarm.simulate(ENGINE, every=0.02)
x = np.array([twinarm.poses(chain, row)[chain.bodies.index("piston"), 0, 3] for row in run.q])
theta = run.q[:, chain.q_of["crank"]][:, 0]
say("piston, from r cos + sqrt(l^2 - r^2 sin^2) [m]",
    np.abs(x - 0.1 * np.cos(theta) - np.sqrt(0.09 - (0.1 * np.sin(theta)) ** 2)).max())
energy = run.kinetic_energy + run.potential_energy
say("change of the engine's energy in 5 s [J]", abs(energy[-1] - energy[0]))
say("piston at 60 degrees [m]", 0.1 * np.cos(np.pi / 3) + np.sqrt(0.09 - (0.1 * np.sin(np.pi / 3)) ** 2))

# %% The four-bar linkage comes round
bars = twinarm.simulate("assets/scenes/four_bar.toml", duration=4, every=0.02)
beam = bars.model.bodies.index("beam0")
z = np.array([twinarm.poses(bars.model, row)[beam, 2, 3] for row in bars.q])
passes = crossings(bars.t, z)
say("the linkage comes round in [s]", passes[2] - passes[0])

# %% Picture
picture(__file__, "t [s]", ("piston [m]", {"engine": (run.t, x)}), ("beam [m]", {"four-bar": (bars.t, z)}))
