#!/usr/bin/env python3
"""The paper's experiments, reproduced: what caused the published difference?  Lesson 12, from Python.

Write down before you run: from E3 (torsional) to E4 (linear) the largest tracking error of joint 1 falls by 4.9. How
much of that is "linear instead of torsional", and how much the damper?
"""
import numpy as np
import twinarm

from lesson import folder_of, picture, say

HERE = folder_of(__file__)
E3, E4 = "assets/scenes/study_e3.toml", "assets/scenes/study_e4.toml"
PULLS = ("pull_joint1", "pull_joint2")


def both(**change):
    """A change of both pulls, and not of what holds the gripper."""
    return {f"coupling.{pull}.{key}": value for key, value in change.items() for pull in PULLS}


def errors(scene, change=None):
    """t, and (N, 2) how far joints 1 and 2 lag [deg], in each step of the coupling."""
    run = twinarm.simulate(scene, every=1 / 150, set=change)
    return run.t, np.degrees(run.targets["pull_joint1"] - run.q)[:, :2]


# %% Six runs
damped = both(type="torsional", discretization="explicit", damping=5)
runs = {"E3": errors(E3), "E4": errors(E4), "E3, damped": errors(E3, damped),
        "fair, torsional": errors(HERE / "fair_torsional.toml"), "fair, linear": errors(HERE / "fair_linear.toml")}
for name, (_, e) in runs.items():
    for joint in (0, 1):
        say(f"{name}: largest tracking error of joint {joint + 1} [deg]", np.abs(e[:, joint]).max())
    for joint in (0, 1):
        say(f"{name}: mean tracking error of joint {joint + 1} [deg]", np.abs(e[:, joint]).mean())

# %% The trap: springs that are 5 % stiffer, and the frequency of the undamped oscillation
runs["E3, 5 % stiffer"] = errors(E3, both(stiffness=213.5))
say("E3, 5 % stiffer: largest tracking error of joint 1 [deg]", np.abs(runs["E3, 5 % stiffer"][1][:, 0]).max())
say("E3, damped: slow mode [rad/s]", twinarm.predict_couplings(E3, set=damped)["modes"][0]["frequency"])

# %% Picture
picture(__file__, "t [s]", ("tracking error of joint 1 [deg]", {name: (t, e[:, 0]) for name, (t, e) in runs.items()}))
