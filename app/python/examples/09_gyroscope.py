#!/usr/bin/env python3
"""Gyroscopic precession and nutation: what does the torque of the weight change?  Lesson 9, from Python.

A wheel spins at the end of a level arm. Write down before you run: with half the spin, does it go round faster or
slower? Pushed in the direction in which it goes round anyway, does it go round faster?
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


def round_by(place):
    return np.arctan2(place[80, 1], place[80, 0])


# %% Four runs
runs = {"given its turn": wheel(), "let go at rest": wheel(pivot=[0, 0, 0]),
        "half the spin": wheel(pivot=[0, 0, 7.63], axle=75), "pushed": wheel(state=HERE / "push.json")}
say("given its turn: round by, after 0.4 s [rad]", round_by(runs["given its turn"][1]))
say("given its turn: farthest from level [m]", np.abs(runs["given its turn"][1][:, 2]).max())
say("half the spin: round by, after 0.4 s [rad]", round_by(runs["half the spin"][1]))
t, place = runs["let go at rest"]
say("let go at rest: lowest [deg]", -np.degrees(np.arcsin(place[:, 2].min() / 0.1)))
say("let go at rest: first time back up [s]", t[30 + place[30:70, 2].argmax()])

# %% The trap: pushed forward it climbs
say("pushed: above level after 1 s [rad]", np.arcsin(runs["pushed"][1][-1, 2] / 0.1))

# %% Picture
picture(__file__, "t [s]", ("height [m]", {name: (t, place[:, 2]) for name, (t, place) in runs.items()}))
