#!/usr/bin/env python3
"""Haptic walls, stability and passivity: how stiff can a virtual wall be?  Lesson 5, from Python.

A device of 45 g and 0.1 N s/m renders F = -K y - B (y - y_before)/T, held for a tick. Write down before you run: what
becomes of the largest K at 4 kHz, and at 500 Hz?
"""
import pathlib
import tempfile

import numpy as np
import twinarm

from lesson import picture, say

DAMPING = 0.1  # [N s/m], of the device
DEVICE = """<robot name="device"><link name="frame"/>
  <link name="grip"><inertial><mass value="0.045"/>
    <inertia ixx="1e-5" ixy="0" ixz="0" iyy="1e-5" iyz="0" izz="1e-5"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="frame"/><child link="grip"/><axis xyz="1 0 0"/>
    <limit lower="-1e9" upper="1e9" effort="1e9" velocity="1e9"/><dynamics damping="0.1"/></joint></robot>"""
with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder) / "device.urdf"
    file.write_text(DEVICE)
    device = twinarm.load(file)


# %% A tick of the device under a held force, by the solver: (x, v) after it from x, v and F, one at a time
def tick(T):
    after = []
    for x, v, F in np.eye(3):
        sim = twinarm.Simulation(device, [x], [v], integrator="rk4", h=T)
        sim.tau = [F]
        sim.step()
        after.append([sim.q[0], sim.qd[0]])
    return np.array(after).T  # (2, 3)


def bisect(holds):
    low, high = 0.0, 1e6
    while high - low > 1e-6 * high:
        low, high = ((low + high) / 2, high) if holds((low + high) / 2) else (low, (low + high) / 2)
    return low


# %% Nobody holds it: it is quiet if no eigenvalue of a tick leaves the unit circle
def stable_stiffness(rate, delay, B):
    T = 1 / rate
    xv = tick(T)

    def is_quiet(K):
        n = delay + 3  # x, v, and x one tick ago, two ...
        step = np.zeros((n, n))
        read, before = [0, *range(2, n)][delay], [0, *range(2, n)][delay + 1]
        force = np.zeros(n)
        force[read] -= K + B / T
        force[before] += B / T
        step[:2, :2] = xv[:, :2]
        step[:2] += np.outer(xv[:, 2], force)
        step[2, 0] = 1
        step[range(3, n), range(2, n - 1)] = 1
        return np.abs(np.linalg.eigvals(step)).max() <= 1

    return bisect(is_quiet)


# %% Any hand moves it to and fro, at each frequency up to half the rate: who gets work out of it?
def passive_stiffness(rate, B):
    T, N = 1 / rate, 512
    n, m = np.arange(N), np.arange(1, N // 2 + 1)[:, None]
    before, x, after = (np.cos(2 * np.pi * m * k / N) for k in (n - 1, n, n + 1))
    way = after - x
    by_K = (x * way).sum(axis=1)  # the hand's work in a cycle is K by_K + rest, by frequency
    rest = ((B * (x - before) + DAMPING * way) * way / T).sum(axis=1)
    return max(0.0, (rest[by_K < 0] / -by_K[by_K < 0]).min())


# %% Walls
say("1 kHz, nobody holds it, B = 1 [N/m]", stable_stiffness(1000, 0, 1.0))
say("1 kHz and one tick of delay [N/m]", stable_stiffness(1000, 1, 1.0))
say("1 kHz, no hand gets energy, B = 0 [N/m]", passive_stiffness(1000, 0.0))
for rate in (4000, 500):
    say(f"{rate} Hz, nobody holds it, B = 1 [N/m]", stable_stiffness(rate, 0, 1.0))
    say(f"{rate} Hz, no hand gets energy, B = 0 [N/m]", passive_stiffness(rate, 0.0))

# %% Through a coupling of 1000 N/m
for wall in (2000, 20000):
    say(f"a wall of {wall} N/m behind a coupling of 1000 N/m [N/m]", 1 / (1 / 1000 + 1 / wall))

# %% The trap: the wall's damping, which is passive only as far as the device's own
dampings = np.linspace(0, 0.12, 25)
passive = np.array([passive_stiffness(1000, B) for B in dampings])
say("the largest B of which some K is passive [N s/m]", dampings[passive > 1e-3].max())

# %% Picture
picture(__file__, "damping of the wall [N s/m]", ("K [N/m]", {
    "no hand gets energy": (dampings, passive),
    "nobody holds it": (dampings, [stable_stiffness(1000, 0, B) for B in dampings])}))
