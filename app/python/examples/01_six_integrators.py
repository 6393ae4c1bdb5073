#!/usr/bin/env python3
"""Energy drift of six integrators: how does the integrator change the energy of a pendulum?  Lesson 1, from Python.

Write down before you run: the energy after 10 s at a step of 10 ms, in parts of that at the start, for each.
"""
import numpy as np
import twinarm

from lesson import picture, say

# %% A bob of 1 kg on a rod of 1 m, let go at 0.01 rad; nothing brakes it.
pendulum = twinarm.load("assets/robots/teaching/pendulum.urdf")
START = np.array([0.01])
BOTTOM = twinarm.energy(pendulum, [0.0], [0.0])[1]
AT_START = sum(twinarm.energy(pendulum, START, [0.0])) - BOTTOM


def swing(integrator, h, steps, every=1):
    """t, q, qd, and the energy in parts of that at the start."""
    t, q, qd = twinarm.Simulation(pendulum, START, integrator=integrator, h=h).run(steps, every)
    energy = np.array([sum(twinarm.energy(pendulum, *state)) for state in zip(q, qd)])
    return t, q[:, 0], qd[:, 0], (energy - BOTTOM) / AT_START


# %% 10 s at 10 ms
runs = {name: swing(name, 0.01, 1000)
        for name in ("euler", "implicit-euler", "semi-implicit", "verlet", "implicit-midpoint", "rk4")}
for name in ("euler", "implicit-euler"):
    say(f"{name}: energy after 10 s", runs[name][3][-1])
say("semi-implicit: lowest", runs["semi-implicit"][3].min())
say("semi-implicit: highest", runs["semi-implicit"][3].max())
say("verlet: lowest", runs["verlet"][3].min())
say("rk4: lowest", runs["rk4"][3].min())

# %% The race: 10 000 steps of 0.2 s, a tenth of the period
long = {name: swing(name, 0.2, 10_000, every=8) for name in ("rk4", "semi-implicit")}
say("rk4 after 2000 s", long["rk4"][3][-1])
say("semi-implicit, 2000 s: lowest", long["semi-implicit"][3].min())
say("semi-implicit, 2000 s: highest", long["semi-implicit"][3].max())

# %% What semi-implicit keeps is not the energy
_, q, v, _ = runs["semi-implicit"]
ww = 9.81 / twinarm.crba(pendulum, [0.0])[0, 0]
kept = v * v + ww * q * q - 0.01 * ww * q * v
say("semi-implicit: largest change of what it keeps", np.abs(kept - kept[0]).max())

# %% Picture
picture(__file__, "t [s]", ("energy / start, 10 ms", {n: (r[0], r[3]) for n, r in runs.items()}),
        ("energy / start, 0.2 s", {n: (r[0], r[3]) for n, r in long.items()}))
