#!/usr/bin/env python3
"""Gyroscopic precession and nutation: what does the torque of the weight change?  Lesson 9, from Python.

A wheel spins at the end of a horizontal arm. Write down before you run: with half the spin, is the precession faster
or slower? Pushed in the direction of the precession, does it precess faster?
"""
import numpy as np
import twinarm

from lesson import folder_of, picture, say

HERE = folder_of(__file__)


def wheel(state=None, **change):
    """t, and (N, 3) where the wheel is."""
    run = twinarm.simulate(HERE / "wheel.toml", state=state, every=0.005,
                           set={f"robot.qd.{joint}": rate for joint, rate in change.items()})
    number = run.model.bodies.index("wheel")
    return run.t, np.array([twinarm.poses(run.model, q)[number, :3, 3] for q in run.q])


def azimuth(place):
    return np.arctan2(place[80, 1], place[80, 0])


# %% Four runs
runs = {"precession rate": wheel(), "released at rest": wheel(pivot=[0, 0, 0]),
        "half the spin": wheel(pivot=[0, 0, 7.63], axle=75), "pushed": wheel(state=HERE / "push.json")}
say("precession rate: azimuth after 0.4 s [rad]", azimuth(runs["precession rate"][1]))
say("precession rate: largest height error [m]", np.abs(runs["precession rate"][1][:, 2]).max())
say("half the spin: azimuth after 0.4 s [rad]", azimuth(runs["half the spin"][1]))
t, place = runs["released at rest"]
say("released at rest: lowest [deg]", -np.degrees(np.arcsin(place[:, 2].min() / 0.1)))
say("released at rest: first return to the top [s]", t[30 + place[30:70, 2].argmax()])

# %% The trap: pushed in the direction of the precession it rises
say("pushed: elevation after 1 s [rad]", np.arcsin(runs["pushed"][1][-1, 2] / 0.1))

# %% Picture
picture(__file__, "t [s]", ("height [m]", {name: (t, place[:, 2]) for name, (t, place) in runs.items()}))
