#!/usr/bin/env python3
"""Stability limit of a discrete spring-damper: how stiff may a spring be at a given step?  Lesson 2, from Python.

A hinge is held by a spring-damper that is stepped explicitly, 10 ms. Write down before you run: which of the four
pairs of stiffness and damping are stable, and what the largest angle is.
"""
import numpy as np
import twinarm

from lesson import folder_of, picture, say

SCENE = folder_of(__file__) / "hinge.toml"


def hinge(stiffness, damping, discretization="explicit"):
    """t and the angle, a sample in each step; a diverged run ends early."""
    run = twinarm.simulate(SCENE, every=0.01, set={
        "coupling.stiffness": stiffness, "coupling.damping": damping, "coupling.discretization": discretization})
    return run.t, run.q[:, 0], run.stopped


# %% Four runs
runs = {"A": hinge(39000, 0), "B": hinge(41000, 0), "C": hinge(30000, 45), "D": hinge(30000, 60)}
for name, (t, q, stopped) in runs.items():
    print(name, "stable" if stopped is None else f"diverged at {stopped['time']:.2f} s: {stopped['reason']}")
A, B, C, D = (q for _, q, _ in runs.values())
say("A: largest angle [rad]", np.abs(A).max())
say("B: after 30 steps [rad]", B[30])
say("B: growth in the last step", -B[30] / B[29])
say("C: largest angle [rad]", np.abs(C).max())
say("C: at the end [rad]", abs(C[-1]))
say("D: after 30 steps [rad]", D[30])
say("D: growth in the last step", -D[30] / D[29])

# %% Prediction without a run: largest stable step; then stability over stiffness and damping
say("largest stable step by theory [s]", twinarm.predict_couplings(SCENE)["scene"]["max_stable_step"])
inertia = twinarm.crba(twinarm.load(SCENE), [0.0])
unstable = [[twinarm.largest_stable_step(inertia, [[k]], [[b]], "semi-implicit Euler") < 0.01
             for k in np.linspace(2000, 44000, 64)] for b in np.linspace(0, 110, 64)]
say("unstable part of the plane", np.mean(unstable))

# %% Remedy: the force from the END of the step
say("implicit, a hundred times too stiff: at the end [rad]", abs(hinge(4e6, 0, "implicit")[1][-1]))

# %% Picture
picture(__file__, "t [s]", *((f"angle [rad], {name}", {name: (t[:31], q[:31])}) for name, (t, q, _) in runs.items()))
