#!/usr/bin/env python3
"""Torsional and linear couplings: which track a target robot better, and why?  Lesson 4, from Python.

Two rods follow a target robot that makes the paper's motion, by torsional or linear couplings with the same fast
mode. Write down before you run: by what factor is the tracking error of the torsional one larger?
"""
import numpy as np
import twinarm

from lesson import folder_of, picture, say

HERE = folder_of(__file__)
K = {"torsional": 70.24, "linear": 5513.0}  # both make a fast mode of 40 rad/s
POINTS = {"arm1": [0.2, 0, 0], "arm2": [0.15, 0, 0]}

# %% The slow mode, in a straight line: M^-1 Kq, with Kq the sum of J^T k J
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
errors = {}
for kind in K:
    run = twinarm.simulate(HERE / f"arm_{kind}.toml", every=0.002)
    errors[kind] = run.t, np.degrees(run.targets["pull1"] - run.q)[:, run.model.q_of["joint1"]][:, 0]
for kind, (_, e) in errors.items():
    say(f"{kind}: largest tracking error of joint 1 [deg]", np.abs(e).max())
for kind, (_, e) in errors.items():
    say(f"{kind}: mean tracking error of joint 1 [deg]", np.abs(e).mean())

# %% The trap: one hinge released at 178 degrees; for small errors the two springs are the same
hinge = {"torsional": twinarm.simulate(HERE / "hinge.toml", every=0.005),
         "linear": twinarm.simulate(HERE / "hinge.toml", every=0.005, set={
             "coupling.type": "linear", "coupling.point": [0, 0, -1]})}
for kind, run in hinge.items():
    say(f"{kind}: the hinge after 0.1 s [rad]", run.q[20, 0])

# %% Picture
picture(__file__, "t [s]", ("tracking error of joint 1 [deg]", errors),
        ("hinge [rad]", {kind: (run.t, run.q[:, 0]) for kind, run in hinge.items()}))
