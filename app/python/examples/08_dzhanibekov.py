#!/usr/bin/env python3
"""Rotation about the intermediate axis: why is it unstable?  Lesson 8, from Python.

A T-handle rotates about its intermediate axis, with a small rate about another. Write down before you run: how much
longer is the time between two flips if that rate is ten times smaller?
"""
import twinarm

from lesson import crossings, folder_of, picture, say

SCENE = folder_of(__file__) / "spin.toml"


def spin(aside):
    """The run, and vertical component of the stem."""
    run = twinarm.simulate(SCENE, every=0.01, set={"robot.angular_velocity": [0, aside, 10]})
    w, x, y, z = run.q[:, 3:7].T
    return run, 2 * (x * z - w * y)


# %% Three starts
runs = {aside: spin(aside) for aside in (0.01, 0.001, 0.0)}
for aside in (0.01, 0.001):
    run, stem = runs[aside]
    sideways = crossings(run.t, stem)
    say(f"{aside} rad/s about axis 1: between two flips [s]", sideways[1] - sideways[0])

# %% Conserved quantities
run, _ = runs[0.01]
say("relative change of energy in 12 s", abs(run.kinetic_energy[-1] / run.kinetic_energy[0] - 1))

# %% The trap: no perturbation. The time of a flip by rounding errors is an artefact.
run, stem = runs[0.0]
print("exactly about the stem: it lies on its side at", crossings(run.t, stem), "s")
say("exactly about the stem: number of flips", len(crossings(run.t, stem)))

# %% Picture
picture(__file__, "t [s]", ("vertical component of the stem", {
    f"{aside} rad/s beside": (run.t, stem) for aside, (run, stem) in runs.items()}))
