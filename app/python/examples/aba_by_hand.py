#!/usr/bin/env python3
"""The articulated-body algorithm by hand, beside what the solver left.  Run from the project's folder.

A double pendulum, RBDA table 7.1 in numpy: every quantity is compared with model.workspace().
"""
import numpy as np
import twinarm

q, qd, tau = np.array([0.4, -0.9]), np.array([1.5, -2.0]), np.array([0.3, 0.1])
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

model = twinarm.load("assets/robots/teaching/double_pendulum.urdf")
twinarm.aba(model, q, qd, tau)
ws = model.workspace()
bodies = [model.bodies.index(name) for name in ("upper", "lower")]
mine = {"v": v, "c": c, "IA": np.array(IA), "pA": pA, "U": U, "D": np.diag(D), "u": u, "qdd": qdd, "a": a}
by_body = {"v", "c", "IA", "pA", "a"}
largest = 0.0
print(f"{'quantity':9} {'by hand less the solver':>24}   what it is")
for row in ws.describe():
    name = row["name"]
    if name in mine:
        solver = ws[name][bodies] if name in by_body else ws[name]
        off = np.abs(mine[name] - solver).max()
        largest = max(largest, off)
        print(f"{name:9} {off:24.1e}   {row['equation']}")
assert largest < 1e-12
print("holds: all quantities agree to 1e-12")
