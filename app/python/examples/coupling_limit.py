#!/usr/bin/env python3
"""How stiff may a spring be at a step?  Theory before the run, then the run.  From the project's folder.

A pendulum is held by a spring at its hinge, stepped explicitly. Predicted is the longest step that is
stable; measured, by bisection over runs, the longest after which the run does not stop by itself.
"""
import pathlib
import tempfile

import numpy as np
import twinarm

SCENE = """
step = {h}
duration = 30
integrator = "{integrator}"
[[robot]]
name = "pendulum"
model = "{robot}"
q = {{ hinge = 0.01 }}
collide = false
[[coupling]]
name = "hold"
type = "torsional"
measure = "joint"
link = "bob"
stiffness = 5000
damping = {damping}
treatment = "explicit"
"""
robot = pathlib.Path("assets/robots/teaching/pendulum.urdf").resolve()


def measured(folder, damping, integrator, predicted):
    def explodes(h):
        scene = folder / "scene.toml"
        scene.write_text(SCENE.format(h=float(h), damping=damping, integrator=integrator, robot=robot))
        return twinarm.simulate(scene).stopped is not None

    stable, unstable = 0.5 * predicted, 2 * predicted
    while unstable - stable > 1e-3 * predicted:
        middle = (stable + unstable) / 2
        stable, unstable = (stable, middle) if explodes(middle) else (middle, unstable)
    return stable


print(f"{'integrator':15} {'damping [N m s/rad]':>20} {'predicted h [ms]':>17} {'measured h [ms]':>16}")
worst = 0.0
with tempfile.TemporaryDirectory() as kept:
    folder = pathlib.Path(kept)
    for integrator, damping in (("semi-implicit", 0.0), ("semi-implicit", 20.0), ("rk4", 20.0)):
        scene = folder / "scene.toml"
        scene.write_text(SCENE.format(h=0.001, damping=damping, integrator=integrator, robot=robot))
        predicted = twinarm.predict_couplings(scene)["scene"]["largest_step"]
        found = measured(folder, damping, integrator, predicted)
        worst = max(worst, abs(found / predicted - 1))
        print(f"{integrator:15} {damping:20} {1e3 * predicted:17.3f} {1e3 * found:16.3f}")
assert worst < 0.01, worst
print("holds: theory and runs agree to one part in a hundred")
