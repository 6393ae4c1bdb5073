#!/usr/bin/env python3
"""The articulated-body algorithm by hand, compared with the workspace of the solver.  Lesson 3, from Python.

A double pendulum, RBDA table 7.1 in numpy: every quantity is compared with model.workspace(). Write down before you
run: 1 N pushes the box along x, then along y: which accelerations? The two rods are let go level: which at the
shoulder, which at the elbow?
"""
import numpy as np
import twinarm

from lesson import folder_of, picture, say

HERE = folder_of(__file__)

# %% Each body's own: two rods of 0.5 m and 1 kg
length, com, mass, I_com, gravity = 0.5, np.array([0, 0, -0.25]), 1.0, np.diag([1 / 48, 1 / 48, 1e-5]), 9.81


def skew(r):
    return np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])


def X_of(angle, r):
    """Motion transform (2.24) to axes turned by `angle` about -y, whose origin is r in the old ones."""
    c, s = np.cos(angle), np.sin(angle)
    E = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    return np.block([[E, np.zeros((3, 3))], [-E @ skew(r), E]])


def crm(v):  # (2.31)
    return np.block([[skew(v[:3]), np.zeros((3, 3))], [skew(v[3:]), skew(v[:3])]])


C = skew(com)
I = np.block([[I_com - mass * C @ C, mass * C], [-mass * C, mass * np.eye(3)]])  # (2.63)
S = np.array([0, -1, 0, 0, 0, 0])


# %% The three passes
def aba_by_hand(q, qd, tau):
    """All quantities of table 7.1, by the solver's names."""
    X = [X_of(q[0], np.zeros(3)), X_of(q[1], [0, 0, -length])]
    rows = range(2)

    # Pass 1, base to tips
    v, c, pA, IA = np.zeros((2, 6)), np.zeros((2, 6)), np.zeros((2, 6)), [I.copy(), I.copy()]
    for i in rows:
        v[i] = X[i] @ (v[i - 1] if i else np.zeros(6)) + S * qd[i]
        c[i] = crm(v[i]) @ S * qd[i]
        pA[i] = -crm(v[i]).T @ I @ v[i]
    # Pass 2, tips to base
    U, D, u = np.zeros((2, 6)), np.zeros(2), np.zeros(2)
    for i in reversed(rows):
        U[i] = IA[i] @ S
        D[i] = S @ U[i]
        u[i] = tau[i] - S @ pA[i]
        if i:
            Ia = IA[i] - np.outer(U[i], U[i]) / D[i]
            pa = pA[i] + Ia @ c[i] + U[i] * u[i] / D[i]
            IA[i - 1] += X[i].T @ Ia @ X[i]
            pA[i - 1] += X[i].T @ pa
    # Pass 3, base to tips; gravity is an upward acceleration of the base
    a, qdd = np.zeros((2, 6)), np.zeros(2)
    for i in rows:
        above = X[i] @ (a[i - 1] if i else np.array([0, 0, 0, 0, 0, gravity])) + c[i]
        qdd[i] = (u[i] - U[i] @ above) / D[i]
        a[i] = above + S * qdd[i]
    return {"v": v, "c": c, "IA": np.array(IA), "pA": pA, "U": U, "D": np.diag(D), "u": u, "qdd": qdd, "a": a}


# %% Beside the solver, in a state of no symmetry
model = twinarm.load("assets/robots/teaching/double_pendulum.urdf")
bodies = [model.bodies.index(name) for name in ("upper", "lower")]
BY_BODY = {"v", "c", "IA", "pA", "a"}


def compare(q, qd, tau):
    twinarm.aba(model, q, qd, tau)
    ws, mine = model.workspace(), aba_by_hand(q, qd, tau)
    print(f"{'quantity':9} {'by hand less the solver':>24}   what it is")
    for row in ws.describe():
        name = row["name"]
        if name in mine:
            off = np.abs(mine[name] - (ws[name][bodies] if name in BY_BODY else ws[name])).max()
            print(f"{name:9} {off:24.1e}   {row['equation']}")
            assert off < 1e-12, name
    return mine


compare(np.array([0.4, -0.9]), np.array([1.5, -2.0]), np.array([0.3, 0.1]))

# %% The box with a cylinder in it: 1 N along x, then along y; nothing weighs anything
box = twinarm.load(HERE / "box.urdf", floating=True)
box.gravity = [0, 0, 0]
for axis in (0, 1):
    push = np.zeros((len(box.bodies), 6))
    push[box.bodies.index("box"), 3 + axis] = 1
    qdd = twinarm.aba(box, box.q, np.zeros(box.nv), np.zeros(box.nv), push)
    say(f"box: acceleration along {'xy'[axis]} [m/s^2]", qdd[3 + axis])

# %% The two rods, level, at rest
level = np.array([np.pi / 2, 0])
hand = compare(level, np.zeros(2), np.zeros(2))
say("D of the elbow [kg m^2]", hand["D"][1, 1])
say("D of the shoulder [kg m^2]", hand["D"][0, 0])
say("shoulder, let go [rad/s^2]", hand["qdd"][0])
say("elbow, let go [rad/s^2]", hand["qdd"][1])

# %% The trap: M11 holds the elbow still, what is felt holds it free
say("M11 [kg m^2]", twinarm.crba(model, level)[0, 0])
falls = {elbow: twinarm.simulate(HERE / f"{elbow}.toml", every=0.005) for elbow in ("free", "locked")}
shoulder = {elbow: run.q[:, run.model.q_of["shoulder"]][:, 0] for elbow, run in falls.items()}
say("elbow locked: the shoulder's acceleration [rad/s^2]", 2 * (np.pi / 2 - shoulder["locked"][4]) / 0.02**2)

# %% Picture
picture(__file__, "t [s]", ("shoulder [rad]", {elbow: (run.t, shoulder[elbow]) for elbow, run in falls.items()}))
