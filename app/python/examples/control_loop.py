#!/usr/bin/env python3
"""Control loops on a scene with contacts: computed torque and impedance control of the S-103 against the
spring-damper couplings that follow the same target robot.

The target sweeps joint 1 from 90 to -90 degrees and joint 2 from -45 to 45 degrees in 1 s, through a box that stops
the robot. Write down before you run: which of the three follows best before the box, and which presses hardest on it?
"""
import pathlib

import numpy as np
import twinarm

from lesson import ROOT, picture, say

HERE = pathlib.Path(__file__).resolve().parent
FREE, END = 0.5, 0.9  # [s] the gripper reaches the box at 0.58 s
TIP = "quill"  # its origin is at the axis of joint 3

# %% The target robot: q and qd at the time t
begin = np.array([np.pi / 2, -np.pi / 4, 0, 0])
speed = np.array([-np.pi, np.pi / 2, 0, 0])


def target(t):
    return begin + speed * t, speed


# %% Computed torque: tau = M (w^2 e + 2 w e') + bias makes every joint a damped oscillator of w = 40 rad/s
def computed_torque(sim, w=40):
    q, qd = target(sim.t)
    e, e_dot = q - sim.q, qd - sim.qd
    return twinarm.rnea(sim.model, sim.q, sim.qd, w * w * e + 2 * w * e_dot)  # M qdd + bias


# %% Impedance control: a spring-damper in world axes from the tip to that of the target, by tau = J^T F + bias.
# K and B are the robot's stiffness and damping at the tip, so K limits the force on an obstacle.
# The quill and the gripper are held by oscillators as above.
K, B = 2000, 80  # [N/m], [N s/m]


def impedance(sim, w=40):
    q, qd = target(sim.t)
    model = sim.model
    J, J_target = (twinarm.jacobian(model, at, TIP)[3:] for at in (sim.q, q))
    error = tip_of(model, q) - tip_of(model, sim.q)
    F = K * error + B * (J_target @ qd - J @ sim.qd)
    held = np.array([0, 0, 1, 1]) * np.diag(twinarm.crba(model, sim.q))
    hold = held * (w * w * (q - sim.q) + 2 * w * (qd - sim.qd))
    return J.T @ F + hold + twinarm.rnea(model, sim.q, sim.qd, np.zeros(model.nv))


def tip_of(model, q):
    return twinarm.poses(model, q)[model.bodies.index(TIP), :3, 3]


# %% One loop for all: the force on the box is read before each step
def simulate(scene, control=None):
    sim = twinarm.SceneSimulation(scene)
    forces = []

    def step(sim):
        forces.append(sum((c["force"] if c["b"] == "tall_box" else -c["force"] for c in sim.contacts), np.zeros(3)))
        return control(sim) if control else None

    run = sim.run(END, step)
    forces.append(forces[-1])
    return sim, run, np.linalg.norm(forces, axis=1)


results = {"couplings": simulate(ROOT / "assets/scenes/robot_beside_obstacles.toml"),
           "computed torque": simulate(HERE / "control_loop.toml", computed_torque),
           "impedance": simulate(HERE / "control_loop.toml", impedance)}

# %% Tracking before the box, force on it at the end
errors, pushes = {}, {}
for name, (sim, run, force) in results.items():
    goal = np.array([target(t)[0] for t in run.t])
    e = np.degrees(goal - run.q)[:, 0]
    errors[name], pushes[name] = (run.t, e), (run.t, force)
    say(f"{name}: largest error of joint 1 before the box [deg]", np.abs(e[run.t <= FREE]).max())
say("computed torque: predicted, speed / (e w), at the velocity jump of the start [deg]", np.degrees(np.pi / 40 / np.e))
for name, (sim, run, force) in results.items():
    say(f"{name}: force on the box at {END} s [N]", force[-1])

# %% At rest the joints are in balance: tau + J^T f of the contacts = bias
for name in ("computed torque", "impedance"):
    sim = results[name][0]
    sum_of = sim.tau - twinarm.rnea(sim.model, sim.q, sim.qd, np.zeros(sim.model.nv))
    for c in sim.contacts:
        body, sign = (c["a"], -1) if c["b"] == "tall_box" else (c["b"], 1)
        pose = twinarm.poses(sim.model, sim.q)[sim.model.bodies.index(body)]
        at = pose[:3, :3].T @ (c["point"] - pose[:3, 3])  # in the link
        sum_of = sum_of + sign * twinarm.jacobian(sim.model, sim.q, body, at)[3:].T @ c["force"]
    say(f"{name}: largest joint force without balance [N m]", np.abs(sum_of[:3]).max())
sim = results["impedance"][0]
say("impedance: K times the error of the tip at the end [N]",
    K * np.linalg.norm(tip_of(sim.model, target(sim.t)[0]) - tip_of(sim.model, sim.q)))

# %% Once more from a saved state, bit for bit
saved = sim.save()
again = sim.run(0.05, impedance).q
sim.reset(saved)
say("impedance: difference of a run from the saved state", np.abs(sim.run(0.05, impedance).q - again).max())
print("articulated-body inertia of the tip there:", sim.inspect().quantity("IA", TIP).diagonal().round(3))

# %% Picture
picture(__file__, "t [s]", ("error of joint 1 [deg]", errors), ("force on the box [N]", pushes))
