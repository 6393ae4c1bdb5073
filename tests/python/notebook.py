"""What the tests of the Python module share: the module itself, the program, seeded states.

Each test is run as  test_NAME.py FOLDER_OF_THE_MODULE PATH/TO/twinarm
"""
import json
import os
import sys
import unittest

import numpy as np

import program as command
from program import ROOT, SCENES, ProgramTest  # noqa: F401: for the tests

PUMA = "assets/robots/puma560/puma560.urdf"
DOUBLE_PENDULUM = "assets/robots/teaching/double_pendulum.urdf"
os.chdir(ROOT)
sys.path.insert(0, sys.argv.pop(1))
command.PROGRAM = os.path.abspath(sys.argv.pop(1))
import twinarm  # noqa: F401: for the tests

# Where the module is watched by a sanitizer, Python has loaded its runtime first; the program has its own.
PRELOADED = {name: os.environ.pop(name) for name in ["LD_PRELOAD"] if name in os.environ}


def states(model, count, seed=1):
    """q, qd and a third vector by velocity, in rows; quaternions of unit length."""
    random = np.random.default_rng(seed)
    q, qd, third = (random.uniform(-1.5, 1.5, (count, n)) for n in (model.nq, model.nv, model.nv))
    for joint, kind in zip(model.joints, model.joint_types):
        if kind in ("spherical", "free"):
            place = model.q_of[joint]
            quaternion = slice(place.stop - 4, place.stop)
            q[:, quaternion] /= np.linalg.norm(q[:, quaternion], axis=1, keepdims=True)
    return q, qd, third


def program(*arguments):
    """What the program prints as JSON."""
    return json.loads(command.twinarm(*arguments, "--json").stdout)


# A robot in which each joint type stands, its axes askew, and its base free to move.
def inertia(k):
    return (f'<inertial><origin xyz="0.0{k} -0.02 0.1"/><mass value="{1 + k}"/><inertia ixx="0.0{k}4" '
            f'ixy="0.001" ixz="-0.002" iyy="0.0{k}5" iyz="0.001" izz="0.0{k}3"/></inertial>')


def every_joint():
    kinds = [("continuous", '<axis xyz="0.6 0 0.8"/>'), ("prismatic", '<axis xyz="0 0.6 -0.8"/>'),
             ("spherical", ""), ("universal", '<axis xyz="0.8 0 0.6"/>'),
             ("cylindrical", '<axis xyz="0 1 0"/>'), ("screw", '<axis xyz="0.6 0.8 0"/>'),
             ("planar", '<axis xyz="0.28 0 0.96"/>')]
    beyond = {"spherical": "floating", "universal": "continuous", "cylindrical": "continuous", "screw": "continuous"}
    text = f'<robot name="all"><link name="l0">{inertia(1)}</link>'
    for n, (kind, axis) in enumerate(kinds):
        more = ""
        if kind in beyond:
            more = f'<twinarm type="{kind}"' + (' pitch="0.2"/>' if kind == "screw" else "/>")
        limit = '<limit lower="-10" upper="10" effort="7" velocity="3"/>' if kind == "prismatic" else ""
        text += (f'<link name="l{n + 1}">{inertia(n + 2)}</link>'
                 f'<joint name="{kind}" type="{beyond.get(kind, kind)}"><parent link="l{n}"/>'
                 f'<child link="l{n + 1}"/><origin xyz="0.1 0.2 -0.1" rpy="0.3 -0.2 0.5"/>'
                 f'{axis}{limit}{more}</joint>')
    return text + "</robot>"


def main():
    unittest.main()
