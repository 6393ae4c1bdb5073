#!/usr/bin/env python3
"""Friction and impact: when does a block slide, and which balls move?  Lesson 7, from Python.

Write down before you run: a block on 30 degrees, does it stay with friction 0.577, and with 0.578? One ball meets two
that rest and touch: what happens?
"""
import numpy as np
import twinarm

from lesson import folder_of, picture, say

HERE = folder_of(__file__)


def place(run, row, body):
    return twinarm.poses(run.model, run.q[row])[run.model.bodies.index(body), :3, 3]


# %% The block: how far down the slope
def slide(friction):
    run = twinarm.simulate(HERE / "incline.toml", every=0.01, set={"body.friction": friction})
    return run.t, np.array([(place(run, n, "block")[0] - 0.025) / np.cos(np.pi / 6) for n in range(len(run.t))])


slides = {f"friction {mu}": slide(mu) for mu in (0.5, 0.577, 0.578)}
for name, (_, way) in slides.items():
    say(f"{name}: slid after 1 s [m]", abs(way[-1]))

# %% What holds it: the force that inverse dynamics asks for, along the slope's normal and across it
incline = twinarm.load(HERE / "incline.toml")
held = twinarm.rnea(incline, incline.q, np.zeros(incline.nv), np.zeros(incline.nv))[3:]
normal = twinarm.poses(incline, incline.q)[incline.bodies.index("block"), :3, 2]
say("normal force [N]", normal @ held)
say("friction [N]", np.linalg.norm(held - (normal @ held) * normal))


# %% Three balls
def balls(scene, **more):
    """Their speeds along x at the end [m/s]."""
    run = twinarm.simulate(HERE / scene, **more)
    speeds = twinarm.velocities(run.model, run.q[-1], run.qd[-1])
    return [speeds[run.model.bodies.index(ball), 3] for ball in ("ball1", "ball2", "ball3")]


for scene in ("balls_apart.toml", "balls_touching.toml"):
    for n, speed in enumerate(balls(scene)):
        say(f"{scene}: ball {n + 1} [m/s]", speed)

# %% The trap: a gap that nobody can measure decides; contacts that are springs have no such gap
for gap in (0.040002, 0.0400009):
    say(f"a gap of {1e6 * (gap - 0.04):.1f} um: ball 3 [m/s]",
        balls("balls_apart.toml", set={"body.ball3.position": [gap, 0, 0]})[2])
for n, speed in enumerate(balls("balls_touching.toml", contact="compliant", step=1e-6, duration=0.07)):
    say(f"springs in the contacts: ball {n + 1} [m/s]", speed)

# %% Picture
picture(__file__, "t [s]", ("slid [m]", slides))
