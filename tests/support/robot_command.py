"""What the tests of `twinarm dynamics` and `twinarm simulate` share: running it, small URDFs, and
enough linear algebra to compute what they must print."""
import json
import pathlib

from program import ProgramTest, line_of, run

# A body that nothing about is simple: mass, centre of mass, inertia about it (xx xy xz yy yz zz).
MASS, COM = 2.5, (0.1, -0.2, 0.3)
INERTIA = (0.4, 0.03, -0.05, 0.5, 0.02, 0.6)


def link(name, mass=MASS, com=COM, inertia=INERTIA):
    xx, xy, xz, yy, yz, zz = inertia
    return (f'<link name="{name}"><inertial><origin xyz="{com[0]} {com[1]} {com[2]}"/>'
            f'<mass value="{mass}"/><inertia ixx="{xx}" ixy="{xy}" ixz="{xz}" iyy="{yy}" '
            f'iyz="{yz}" izz="{zz}"/></inertial></link>')


def joint(name, kind, parent, child, xyz="0 0 0", rpy="0 0 0", axis="0 0 1", more=""):
    """`kind` also of the types that URDF lacks; those come by <twinarm type>."""
    beyond = {"spherical": "floating", "universal": "continuous", "cylindrical": "continuous", "screw": "continuous"}
    if kind in beyond:
        if "<twinarm" not in more:
            more += "<twinarm/>"
        more = more.replace("<twinarm", f'<twinarm type="{kind}"')
    if kind in ("revolute", "prismatic") and "<limit" not in more:
        more += '<limit lower="-10" upper="10" effort="1" velocity="1"/>'
    axis = "" if kind in ("fixed", "floating", "spherical") else f'<axis xyz="{axis}"/>'
    return (f'<joint name="{name}" type="{beyond.get(kind, kind)}"><parent link="{parent}"/>'
            f'<child link="{child}"/><origin xyz="{xyz}" rpy="{rpy}"/>{axis}{more}</joint>')


def robot(*parts):
    return f'<robot name="test">{"".join(parts)}</robot>'


PENDULUM = robot('<link name="base"/>', link("bob", 1, (0, 0, -1), (0,) * 6),
                 joint("hinge", "continuous", "base", "bob", axis="0 -1 0"))


# A rod about a vertical axis, no gravity in its direction.
HINGE_INERTIA = 0.5
HINGE = robot('<link name="base"/>', link("rod", 1, (0, 0, 0), (1, 0, 0, 1, 0, HINGE_INERTIA)),
              joint("hinge", "continuous", "base", "rod"))
# Two wheels on parallel axes through their centres of mass.
WHEELS = robot('<link name="base"/>', link("a", 1, (0, 0, 0), (1, 0, 0, 1, 0, 0.2)),
               link("b", 1, (0, 0, 0), (1, 0, 0, 1, 0, 0.5)),
               joint("ja", "continuous", "base", "a"), joint("jb", "continuous", "base", "b"))
# A hand that leads joint 1 (twice theta1) at 1 rad/s.
HAND_COLUMNS = "t[s],theta1[rad],theta2[rad],theta3[rad],theta4[rad],theta5[rad],theta6[rad]\n"
STEADY_HAND = HAND_COLUMNS + "0,0,0,0,0,0,0\n10,5,0,0,0,0,0\n"


class RobotCommand(ProgramTest):
    command = ""

    def run_it(self, urdf, *options, state=None):
        """`urdf` is XML or a path below the project, `state` an object, JSON text or a path."""
        if urdf.startswith("<"):
            urdf = self.write("test.urdf", urdf)
        arguments = [self.command, urdf, *options]
        if state is not None:
            if not isinstance(state, pathlib.Path):
                state = self.write("state.json", state if isinstance(state, str) else json.dumps(state))
            arguments += ["--state", state]
        return run(*arguments)

    def answer(self, urdf, *options, state=None):
        result = self.run_it(urdf, *options, "--json", state=state)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        return json.loads(result.stdout)

    def errors(self, urdf, *options, state=None):
        """All faults, which stand on stderr too."""
        result = self.run_it(urdf, *options, "--json", state=state)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        errors = json.loads(result.stdout)["errors"]
        self.assertEqual(len(result.stderr.splitlines()), len(errors), result.stderr)
        return [line_of(error) for error in errors]

    def close(self, found, wanted, tolerance=1e-12, message=""):
        """Numbers, or lists of them to any depth, to a part of the largest one."""
        found, wanted = list(flat(found)), list(flat(wanted))
        self.assertEqual(len(found), len(wanted), message)
        size = max([1.0] + [abs(w) for w in wanted])
        for f, w in zip(found, wanted):
            self.assertLessEqual(abs(f - w), tolerance * size, f"{message} {found} {wanted}")


def flat(values):
    if isinstance(values, (int, float)):
        yield values
    else:
        for value in values:
            yield from flat(value)


# Vectors are lists, matrices lists of rows; any of them may be complex.

def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def add(*vectors):
    return [sum(parts) for parts in zip(*vectors)]


def scale(factor, a):
    return [factor * x for x in a]


def times(A, b):
    """A matrix times a vector or a matrix."""
    if isinstance(b[0], list):
        return transpose([times(A, column) for column in transpose(b)])
    return [dot(row, b) for row in A]


def transpose(A):
    return [list(column) for column in zip(*A)]


def skew(a):
    return [[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]]


def symmetric(xx, xy, xz, yy, yz, zz):
    return [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]


def from_quaternion(q):
    w, x, y, z = q
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def unit(values):
    length = sum(v * v for v in values) ** 0.5
    return [v / length for v in values]


def inertia_about_origin(mass=MASS, com=COM, inertia=INERTIA):
    S = skew(com)
    shifted = times(S, S)
    about_com = symmetric(*inertia)
    return [[about_com[i][j] - mass * shifted[i][j] for j in range(3)] for i in range(3)]


def one_body(R, w, mass=MASS, com=COM, inertia=INERTIA, g=(0, 0, -9.81)):
    """Newton and Euler about the body's origin, in the axes that R brings body axes to:
    (mass matrix, bias) for (classical linear acceleration, angular acceleration)."""
    c = times(R, list(com))
    I = times(times(R, inertia_about_origin(mass, com, inertia)), transpose(R))
    C = skew(c)
    M = [[mass * (i == j) for j in range(3)] + [-mass * C[i][j] for j in range(3)]
         for i in range(3)] + [[mass * C[i][j] for j in range(3)] + I[i] for i in range(3)]
    force = add(scale(mass, cross(w, cross(w, c))), scale(-mass, list(g)))
    torque = add(cross(w, times(I, w)), scale(-mass, cross(c, list(g))))
    return M, force + torque


def rotation(axis, angle, cos, sin):
    """Rodrigues; cos and sin of math or cmath."""
    K = skew(axis)
    K2 = times(K, K)
    s, v = sin(angle), 1 - cos(angle)
    return [[(i == j) + s * K[i][j] + v * K2[i][j] for j in range(3)] for i in range(3)]


def slider(damping=0, friction=0, mass=2, more=""):
    return robot('<link name="base"/>', link("block", mass, (0, 0, 0)),
                 joint("slide", "prismatic", "base", "block", axis="1 0 0",
                       more=f'<dynamics damping="{damping}" friction="{friction}"/>' + more))
