#!/usr/bin/env python3
"""Writes puma560.urdf from the published table of the PUMA 560 (see README.md).

    python3 make_urdf.py > puma560.urdf

Standard Denavit-Hartenberg: A_i = Rz(q_i) Tz(d_i) Tx(a_i) Rx(alpha_i) leads from frame i-1 to frame i.
A URDF joint applies its fixed origin first and rotates afterwards, so URDF link i is frame i-1 rotated by
q_i about its z; the rest of A_i, C_i = Tz(d_i) Tx(a_i) Rx(alpha_i), is fixed in link i. It is the origin of joint
i+1, and it carries the published inertia (in axes of frame i, about the centre of mass) into link i.
The motor's constants are referred to the joint: armature G^2 Jm, damping G^2 B, Coulomb |G| Tc.

Products are computed in decimal arithmetic, so the written values are exact; alpha is pi/2 rounded to a double.
"""
from dataclasses import dataclass
from decimal import Decimal as D

QUARTER_TURN = 1.5707963267948966
PI_OVER_180 = 0.017453292519943295


@dataclass
class Row:
    a: str            # m
    d: str            # m
    alpha: int        # quarter turns
    mass: str         # kg
    com: tuple        # m, in frame i
    inertia: tuple    # kg m^2: xx yy zz about the centre of mass, in axes of frame i; no products
    motor: str        # Jm, kg m^2
    gear: str         # G; negative where the motor turns against the joint
    viscous: str      # B, N m s / rad, at the motor
    coulomb: tuple    # Tc, N m, at the motor: for positive and for negative JOINT rate
    limits: tuple     # degrees
    torque: str       # N m, the most that the drive gives, at the joint


TABLE = [
    Row("0", "0", 1, "0", ("0", "0", "0"), ("0", "0.35", "0"),
        "200e-6", "-62.6111", "1.48e-3", ("0.395", "-0.435"), (-160, 160), "97.6"),
    Row("0.4318", "0", 0, "17.4", ("-0.3638", "0.006", "0.2275"), ("0.13", "0.524", "0.539"),
        "200e-6", "107.815", "0.817e-3", ("0.126", "-0.071"), (-45, 225), "186.4"),
    Row("0.0203", "0.15005", -1, "4.8", ("-0.0203", "-0.0141", "0.070"), ("0.066", "0.086", "0.0125"),
        "200e-6", "-53.7063", "1.38e-3", ("0.132", "-0.105"), (-225, 45), "89.4"),
    Row("0", "0.4318", 1, "0.82", ("0", "0.019", "0"), ("1.8e-3", "1.3e-3", "1.8e-3"),
        "33e-6", "76.0364", "71.2e-6", ("11.2e-3", "-16.9e-3"), (-110, 170), "24.2"),
    Row("0", "0", -1, "0.34", ("0", "0", "0"), ("0.3e-3", "0.4e-3", "0.3e-3"),
        "33e-6", "71.923", "82.6e-6", ("9.26e-3", "-14.5e-3"), (-100, 100), "20.1"),
    Row("0", "0", 0, "0.09", ("0", "0", "0.032"), ("0.15e-3", "0.15e-3", "0.04e-3"),
        "33e-6", "76.686", "36.7e-6", ("3.96e-3", "-10.5e-3"), (-266, 266), "21.3"),
]

# Visual geometry in link axes: (material, shape, xyz, rpy). Not published, and without effect on the
# dynamics. The joints' zeros put the shoulder at
# the origin, the floor 0.672 m below it.
H = "1.5707963267948966"
DRAWN = [
    [("steel", '<box size="0.32 0.32 0.02"/>', "0 0 -0.662", "0 0 0"),
     ("steel", '<cylinder radius="0.085" length="0.532"/>', "0 0 -0.386", "0 0 0")],
    [("white", '<cylinder radius="0.095" length="0.24"/>', "0 0 0", "0 0 0"),
     ("white", '<cylinder radius="0.08" length="0.2"/>', "0 -0.1 0", f"{H} 0 0")],
    [("orange", '<box size="0.6 0.16 0.08"/>', "0.14 0 0.24", "0 0 0"),
     ("orange", '<cylinder radius="0.07" length="0.09"/>', "0.4318 0 0.24", "0 0 0")],
    [("white", '<cylinder radius="0.06" length="0.1"/>', "0 0 0.15005", "0 0 0"),
     ("white", '<box size="0.09 0.44 0.09"/>', "0.0203 0.13 0.15005", "0 0 0")],
    [("steel", '<cylinder radius="0.04" length="0.05"/>', "0 0 0.375", "0 0 0"),
     ("steel", '<box size="0.03 0.02 0.06"/>', "0 0.034 0.42", "0 0 0"),
     ("steel", '<box size="0.03 0.02 0.06"/>', "0 -0.034 0.42", "0 0 0")],
    [("white", '<cylinder radius="0.024" length="0.048"/>', "0 0 0", "0 0 0")],
    [("steel", '<cylinder radius="0.018" length="0.03"/>', "0 0 0.034", "0 0 0"),
     ("orange", '<cylinder radius="0.03" length="0.008"/>', "0 0 0.053", "0 0 0")],
]


def text(number):
    """A decimal without exponent and without trailing zeros."""
    number = D(number)
    if number == 0:
        return "0"
    plain = format(number, "f")
    return plain.rstrip("0").rstrip(".") if "." in plain else plain


def triple(numbers):
    return " ".join(text(n) for n in numbers)


def turned(row, vector):
    """Rx(alpha) vector, for whole quarter turns: without rounding."""
    x, y, z = (D(v) for v in vector)
    return {0: (x, y, z), 1: (x, -z, y), -1: (x, z, -y)}[row.alpha]


def rpy(row):
    return f"{row.alpha * QUARTER_TURN!r} 0 0" if row.alpha else "0 0 0"


def shapes(number):
    lines = []
    for material, shape, xyz, angles in DRAWN[number]:
        lines += ["    <visual>",
                  f'      <origin xyz="{xyz}" rpy="{angles}"/>',
                  f"      <geometry>{shape}</geometry>",
                  f'      <material name="{material}"/>',
                  "    </visual>"]
    return lines


def link(number):
    row = TABLE[number - 1]
    com = [s + c for s, c in zip((D(row.a), D(0), D(row.d)), turned(row, row.com))]
    xx, yy, zz = (text(i) for i in row.inertia)
    return [f'  <link name="link{number}">',
            "    <inertial>",
            f'      <origin xyz="{triple(com)}" rpy="{rpy(row)}"/>',
            f'      <mass value="{text(row.mass)}"/>',
            f'      <inertia ixx="{xx}" ixy="0" ixz="0" iyy="{yy}" iyz="0" izz="{zz}"/>',
            "    </inertial>", *shapes(number), "  </link>"]


def joint(number):
    row = TABLE[number - 1]
    gear = abs(D(row.gear))
    plus, minus = (gear * abs(D(t)) for t in row.coulomb)
    lower, upper = (repr(angle * PI_OVER_180) for angle in row.limits)
    parent = f"link{number - 1}" if number > 1 else "base"
    before = TABLE[number - 2] if number > 1 else Row("0", "0", 0, *[None] * 9)
    return [f'  <joint name="j{number}" type="revolute">',
            f'    <parent link="{parent}"/>',
            f'    <child link="link{number}"/>',
            f'    <origin xyz="{triple((before.a, "0", before.d))}" rpy="{rpy(before)}"/>',
            '    <axis xyz="0 0 1"/>',
            f'    <limit lower="{lower}" upper="{upper}" effort="{row.torque}" velocity="0"/>',
            f'    <dynamics damping="{text(gear ** 2 * D(row.viscous))}"'
            f' friction="{text((plus + minus) / 2)}"/>',
            f'    <twinarm armature="{text(gear ** 2 * D(row.motor))}"'
            f' coulomb_plus="{text(plus)}" coulomb_minus="{text(minus)}"/>',
            "  </joint>"]


def main():
    lines = ['<?xml version="1.0"?>',
             "<!-- Made by make_urdf.py; change its table and run it again. Origin, conventions and",
             "     what is odd about the published numbers: README.md. SI units, radians. -->",
             '<robot name="puma560">',
             '  <material name="steel"><color rgba="0.45 0.46 0.49 1"/></material>',
             '  <material name="white"><color rgba="0.9 0.9 0.86 1"/></material>',
             '  <material name="orange"><color rgba="0.93 0.45 0.1 1"/></material>',
             '  <link name="base">', *shapes(0), "  </link>"]
    for number in range(1, len(TABLE) + 1):
        lines += link(number)
    for number in range(1, len(TABLE) + 1):
        lines += joint(number)
    print("\n".join([*lines, "</robot>"]))


if __name__ == "__main__":
    main()
