#!/usr/bin/env python3
"""One pendulum, all integrators: which keep its energy?  Run from the project's folder.

A bob on a rod of 1 m is let go at 150 degrees; nothing brakes it. The step is long on purpose, 20 ms.
Predict before you look: which integrators gain energy, which lose it, which keep it on average?
"""
import numpy as np
import twinarm

model = twinarm.load("assets/robots/teaching/pendulum.urdf")
start, h, steps = np.radians([150.0]), 0.02, 1000


def energies(integrator):
    sim = twinarm.Simulation(model, start, integrator=integrator, h=h)
    t, q, qd = sim.run(steps)
    return np.array([sum(twinarm.energy(model, *state)) for state in zip(q, qd)])


print(f"{'integrator':18} {'order':>5} {'energy after 20 s [J]':>22} {'largest swing of it [J]':>24}")
drift = {}
for facts in twinarm.integrators():
    E = energies(facts["name"]) - energies("rk4")[0]
    drift[facts["name"]] = E[-1]
    print(f"{facts['name']:18} {facts['order']:5} {E[-1]:22.2e} {np.ptp(E):24.2e}")

assert drift["euler"] > 1 and drift["implicit-euler"] < -1
assert abs(drift["rk4"]) < 1e-3 and abs(drift["implicit-midpoint"]) < 1e-2
print("holds: euler gains energy, implicit-euler loses it, rk4 and implicit-midpoint keep it")
