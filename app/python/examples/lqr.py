#!/usr/bin/env python3
"""Linearisation and linear-quadratic regulators (LQR) by the analytic derivatives of forward dynamics: the Acrobot
balances upright by its elbow alone; the S-103 on soft springs comes to rest where only their target is moved.

Write down before you run: from how far can the Acrobot rise? How many times sooner do the springs settle?
"""
import pathlib

import numpy as np
import twinarm

from lesson import picture, say

HERE = pathlib.Path(__file__).resolve().parent


# %% x' = A x + B u near an equilibrium, x = (q, qd): of u = -L x the one with the least integral of x^T Q x + u^T R u
def linearised(dqdd_dq, dqdd_dqd, dqdd_du):
    n = len(dqdd_dq)
    A = np.block([[np.zeros((n, n)), np.eye(n)], [dqdd_dq, dqdd_dqd]])
    return A, np.vstack([np.zeros_like(dqdd_du), dqdd_du])


def regulator(A, B, Q, R):
    """L and the eigenvalues of A - B L; Riccati's equation by the stable eigenvectors of the Hamiltonian matrix."""
    values, vectors = np.linalg.eig(np.block([[A, -B @ np.linalg.solve(R, B.T)], [-Q, -A.T]]))
    stable = vectors[:, values.real < 0]
    P = np.real(stable[len(A):] @ np.linalg.inv(stable[:len(A)]))
    L = np.linalg.solve(R, B.T @ P)
    return L, np.linalg.eigvals(A - B @ L)


# %% The Acrobot: two rods, a motor at the elbow only
sim = twinarm.SceneSimulation(HERE / "lqr_acrobot.toml")
upright, still = np.array([np.pi, 0]), np.zeros(2)
by_q, by_qd, by_tau = twinarm.aba_derivatives(sim.model, upright, still, still)
A, B = linearised(by_q, by_qd, by_tau[:, 1:])
L, values = regulator(A, B, Q=np.eye(4), R=np.eye(1))
say("Acrobot: fastest growth without control [1/s]", np.linalg.eigvals(A).real.max())
say("Acrobot: slowest decay with LQR [1/s]", -values.real.max())


def balance(lean):
    sim.reset(q=upright - [lean, 0], qd=still)
    return sim.run(6, lambda sim: [0, -(L @ np.append(sim.q - upright, sim.qd)).item()], every=0.01)


def size(run, goal):
    return np.linalg.norm(np.hstack([run.q - goal, run.qd]), axis=1)


near = size(balance(1e-3), upright)
say("Acrobot: decay of the nonlinear motion nearby, from 4 s to 5 s [1/s]", np.log(near[400] / near[500]))
largest = max(lean for lean in np.radians(np.arange(0.1, 4, 0.1)) if size(balance(lean), upright)[-1] < 1e-3)
say("Acrobot: largest lean from which it rises [deg]", np.degrees(largest))  # the straight pair, about the shoulder
risen = balance(largest)

# %% The S-103: forces of the springs are K (u - q) - D qd, u the joints of the target
K, D = np.diag([40, 10, 0.5, 400]), np.diag([2, 0.5, 0.02, 10])  # as in lqr_s103.toml
sim = twinarm.SceneSimulation(HERE / "lqr_s103.toml")
goal, still = sim.q + [0.3, 0.3, 0, 0], np.zeros(4)
weight = twinarm.rnea(sim.model, goal, still, still)
goal = goal - np.linalg.solve(K, weight)  # of the gripper's lift, whose spring carries it
by_q, by_qd, by_tau = twinarm.aba_derivatives(sim.model, goal, still, weight)
A, B = linearised(by_q - by_tau @ K, by_qd - by_tau @ D, (by_tau @ K)[:, :3])  # the target has joints 1 to 3
L, values = regulator(A, B, Q=np.diag([1, 1, 1, 1, 0, 0, 0, 0]), R=0.1 * np.eye(3))
say("S-103: slowest decay of the springs alone [1/s]", -np.linalg.eigvals(A).real.max())
say("S-103: slowest decay with LQR [1/s]", -values.real.max())


def settle(L):
    sim.reset()
    return sim.run(6, lambda sim: sim.set_target(goal[:3] - L @ np.append(sim.q - goal, sim.qd)), every=0.002)


runs = {"target at rest": settle(0 * L), "target moved by LQR": settle(L)}
for name, run in runs.items():
    out = np.abs(run.q[:, :2] - goal[:2]).max(axis=1) > 0.02 * 0.3
    say(f"S-103, {name}: within 2 % from [s]", run.t[np.flatnonzero(out)[-1]])

# %% Picture
picture(__file__, "t [s]",
        ("Acrobot [rad]", {joint: (risen.t, risen["q/" + joint]) for joint in ("shoulder", "elbow")}),
        ("S-103: joint 1 [rad]", {name: (run.t, run["q/joint1"]) for name, run in runs.items()}))
