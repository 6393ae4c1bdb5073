#!/usr/bin/env python3
"""Torsional and linear couplings: which track a target robot better, and why?  Lesson 4, from Python.

Two rods follow a twin that makes the paper's motion, by torsional or by linear springs whose fast mode is the same.
Write down before you run: by what factor does the torsional one lag farther?
"""
import numpy as np
import twinarm

from lesson import folder_of, picture, say

HERE = folder_of(__file__)
K = {"torsional": 70.24, "linear": 5513.0}  # both make a fast mode of 40 rad/s
POINTS = {"arm1": [0.2, 0, 0], "arm2": [0.15, 0, 0]}

# %% The slow mode, stretched out: M^-1 Kq, with Kq the sum of J^T k J
arm = twinarm.load(HERE / "arm_torsional.toml")
stretched = np.zeros(arm.nq)
M = twinarm.crba(arm, stretched)
for kind, k in K.items():
    J = [twinarm.jacobian(arm, stretched, link, point) for link, point in POINTS.items()]
    Kq = sum(k * j[rows].T @ j[rows] for j in J for rows in [slice(0, 3) if kind == "torsional" else slice(3, 6)])
    modes = np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(M, Kq)).real))
    print(f"{kind}: fast mode {modes[1]:.2f} rad/s")
    say(f"{kind}: slow mode [rad/s]", modes[0])

# %% The paper's motion
lags = {}
for kind in K:
    run = twinarm.simulate(HERE / f"arm_{kind}.toml", every=0.002)
    lags[kind] = run.t, np.degrees(run.targets["pull1"] - run.q)[:, run.model.q_of["joint1"]][:, 0]
for kind, (_, e) in lags.items():
    say(f"{kind}: largest error of joint 1 [deg]", np.abs(e).max())
for kind, (_, e) in lags.items():
    say(f"{kind}: mean error of joint 1 [deg]", np.abs(e).mean())

# %% The trap: one hinge from 178 degrees away; near the target the two springs are the same
hinge = {"torsional": twinarm.simulate(HERE / "hinge.toml", every=0.005),
         "linear": twinarm.simulate(HERE / "hinge.toml", every=0.005, set={
             "coupling.type": "linear", "coupling.point": [0, 0, -1]})}
for kind, run in hinge.items():
    say(f"{kind}: the hinge after 0.1 s [rad]", run.q[20, 0])

# %% Picture
picture(__file__, "t [s]", ("error of joint 1 [deg]", lags),
        ("hinge [rad]", {kind: (run.t, run.q[:, 0]) for kind, run in hinge.items()}))
