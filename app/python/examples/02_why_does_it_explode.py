#!/usr/bin/env python3
"""Stability limit of a discrete spring-damper: how stiff may a spring be at a given step?  Lesson 2, from Python.

A hinge is held by a spring-damper that is stepped explicitly, 10 ms. Write down before you run: which of the four
pairs of stiffness and damping hold, and how large the angle is at its largest.
"""
import numpy as np
import twinarm

from lesson import folder_of, picture, say

SCENE = folder_of(__file__) / "hinge.toml"


def hinge(stiffness, damping, treatment="explicit"):
    """t and the angle, a sample in each step; the run ends where it explodes."""
    run = twinarm.simulate(SCENE, every=0.01, set={
        "coupling.stiffness": stiffness, "coupling.damping": damping, "coupling.treatment": treatment})
    return run.t, run.q[:, 0], run.stopped


# %% Four runs
runs = {"A": hinge(39000, 0), "B": hinge(41000, 0), "C": hinge(30000, 45), "D": hinge(30000, 60)}
for name, (t, q, stopped) in runs.items():
    print(name, "holds" if stopped is None else f"explodes at {stopped['time']:.2f} s: {stopped['reason']}")
A, B, C, D = (q for _, q, _ in runs.values())
say("A: largest angle [rad]", np.abs(A).max())
say("B: after 30 steps [rad]", B[30])
say("B: grown in the last by", -B[30] / B[29])
say("C: largest angle [rad]", np.abs(C).max())
say("C: at the end [rad]", abs(C[-1]))
say("D: after 30 steps [rad]", D[30])
say("D: grown in the last by", -D[30] / D[29])

# %% Theory, before any run: the longest step of this spring; then over the plane of both numbers
say("largest stable step by theory [s]", twinarm.predict_couplings(SCENE)["scene"]["largest_step"])
inertia = twinarm.crba(twinarm.load(SCENE), [0.0])
explodes = [[twinarm.largest_stable_step(inertia, [[k]], [[b]], "semi-implicit Euler") < 0.01
             for k in np.linspace(2000, 44000, 64)] for b in np.linspace(0, 110, 64)]
say("part of the plane that explodes", np.mean(explodes))

# %% The trap's way out: the force from the END of the step
say("implicit, a hundred times too stiff: at the end [rad]", abs(hinge(4e6, 0, "implicit")[1][-1]))

# %% Picture
picture(__file__, "t [s]", *((f"angle [rad], {name}", {name: (t[:31], q[:31])}) for name, (t, q, _) in runs.items()))
