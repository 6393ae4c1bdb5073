#!/usr/bin/env python3
"""Mass matrix and normal modes: when is an eigenvalue the frequency of an oscillation?  Lesson 11, from Python.

Two equal rods hang one below the other. Write down before you run: let go in the slow shape, what does the elbow do
while the shoulder swings? Upside down, which "frequencies" will be printed?
"""
import numpy as np
import twinarm

from lesson import crossings, folder_of, picture, say

arm = twinarm.load("assets/robots/teaching/double_pendulum.urdf")


# %% Small motions about q: M x'' + K x = 0, K the derivative of what inverse dynamics asks for
def weight(q):
    return twinarm.rnea(arm, q, np.zeros(2), np.zeros(2))


def modes(q, d=0.05):
    """Eigenvalues of x' = A x, slow ones first, and their shapes (2, 4)."""
    K = np.array([(8 * (weight(q + e) - weight(q - e)) - (weight(q + 2 * e) - weight(q - 2 * e))) / (12 * d)
                  for e in d * np.eye(2)]).T
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(twinarm.crba(arm, q), K), np.zeros((2, 2))]])
    values, vectors = np.linalg.eig(A)
    order = np.argsort(np.abs(values))
    return values[order], vectors[:2, order]


# %% Hanging: frequencies and shapes
values, shapes = modes(np.zeros(2))
slow, fast = 0, 2  # each frequency is there twice, as +i and -i
say("slow [rad/s]", abs(values[slow]))
say("fast [rad/s]", abs(values[fast]))
for name, n in (("slow", slow), ("fast", fast)):
    say(f"{name}: elbow over shoulder", (shapes[1, n] / shapes[0, n]).real)

# %% Let go in the slow shape, small and large
SCENE = folder_of(__file__) / "slow.toml"
small = twinarm.simulate(SCENE, every=0.005)
large = twinarm.simulate(SCENE, every=0.005, set={"robot.q.shoulder": 1.0, "robot.q.elbow": 0.43052})
say("small: the shoulder crosses zero first at [s]", crossings(small.t, small.q[:, 0])[0])

# %% The trap: upside down the same numbers, and nothing swings
values, _ = modes(np.array([np.pi, 0]))
print("upside down:", np.round(values, 4))
say("upside down: size of the slow eigenvalue [rad/s]", abs(values[0]))
say("upside down: its growing one [1/s]", values[:2].real.max())
say("upside down: the fast one that dies out [1/s]", values[2:].real.min())
level = np.array([np.pi / 2, 0])
say("level: 'frequency' [rad/s]", np.abs(modes(level)[0]).max())
say("level: joints whose weight nothing holds", np.sum(np.abs(weight(level)) > 1e-9))

# %% Picture
picture(__file__, "t [s]", *((f"{name} [rad]", {joint: (run.t, run.q[:, run.model.q_of[joint]][:, 0])
                                                for joint in ("shoulder", "elbow")})
                             for name, run in (("small", small), ("large", large))))
