#!/usr/bin/env python3
"""Rotation about the intermediate axis: why is it unstable?  Lesson 8, from Python.

A T-handle spins about its middle axis, and a little beside it. Write down before you run: how much longer does it take
to turn over if you are ten times as careful?
"""
import numpy as np
import twinarm

from lesson import crossings, folder_of, picture, say

SCENE = folder_of(__file__) / "spin.toml"


def spin(aside):
    """The run, and how upright the stem is."""
    run = twinarm.simulate(SCENE, every=0.01, set={"robot.angular_velocity": [0, aside, 10]})
    w, x, y, z = run.q[:, 3:7].T
    return run, 2 * (x * z - w * y)


# %% Three starts
runs = {aside: spin(aside) for aside in (0.01, 0.001, 0.0)}
for aside in (0.01, 0.001):
    run, stem = runs[aside]
    sideways = crossings(run.t, stem)
    say(f"{aside} rad/s beside: between two turnings-over [s]", sideways[1] - sideways[0])

# %% What stays
run, _ = runs[0.01]
say("change of energy in 12 s, of itself", abs(run.kinetic_energy[-1] / run.kinetic_energy[0] - 1))

# %% The trap: nothing beside, exactly. The time at which rounding tips it is an artefact.
run, stem = runs[0.0]
print("exactly about the stem: it lies on its side at", crossings(run.t, stem), "s")
say("exactly about the stem: how often it turned over", len(crossings(run.t, stem)))

# %% Picture
picture(__file__, "t [s]", ("how upright the stem is", {
    f"{aside} rad/s beside": (run.t, stem) for aside, (run, stem) in runs.items()}))
