"""What a scene's bodies have, from their poses and velocities alone: energies and momenta, by
Newton's and Euler's formulas, body by body. Shares nothing with the program but the files."""
import math
import tomllib
import xml.etree.ElementTree as xml

from program import ROOT
from robot_command import cross, dot, times, transpose

GRAVITY = (0, 0, -9.81)


def add(a, b, scale=1):
    return tuple(x + scale * y for x, y in zip(a, b))


def symmetric(xx, yy, zz, xy=0, xz=0, yz=0):
    return ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))


def inertia_of_shape(shape, m):
    """Of the solid uniform body, about its centre."""
    (kind, size), = shape.items()
    if kind == "sphere":
        i = 0.4 * m * size["radius"] ** 2
        return symmetric(i, i, i)
    if kind == "box":
        x, y, z = (s * s for s in size["size"])
        return symmetric(m * (y + z) / 12, m * (x + z) / 12, m * (x + y) / 12)
    if kind == "cylinder":
        r, h = size["radius"] ** 2, size["length"] ** 2
        return symmetric(m * (3 * r + h) / 12, m * (3 * r + h) / 12, m * r / 2)
    raise ValueError(kind)


def with_point(m, com, inertia, more, point):
    """A body and a point mass on it as one, inertia about their common centre (Steiner)."""
    both = m + more
    center = tuple((m * c + more * p) / both for c, p in zip(com, point))
    for part, place in ((m, com), (more, point)):
        d = add(place, center, -1)
        inertia = tuple(tuple(value + part * ((dot(d, d) if i == j else 0) - d[i] * d[j])
                              for j, value in enumerate(row)) for i, row in enumerate(inertia))
    return both, center, inertia


def has_motors(scene):
    """Whether motors turn with its joints: their inertia is in no body."""
    robots = tomllib.loads(scene.read_text()).get("robot", [])
    files = (f for robot in robots for f in (scene.parent / robot["model"],
                                             ROOT / "assets" / robot["model"]) if f.exists())
    return any("armature" in file.read_text() for file in files)


def bodies_of(scene):
    """{link: (mass, centre of mass, inertia about it)}, of all that forces can move."""
    description = tomllib.loads(scene.read_text())
    bodies = {}
    many = len(description.get("robot", [])) > 1
    for robot in description.get("robot", []):
        beside = scene.parent / robot["model"]
        tree = xml.parse(beside if beside.exists() else ROOT / "assets" / robot["model"]).getroot()
        children = {joint.find("child").get("link") for joint in tree.findall("joint")}
        for link in tree.findall("link"):
            inertial = link.find("inertial")
            if inertial is None or link.get("name") not in children:
                continue
            origin = inertial.find("origin")
            com = (0, 0, 0)
            if origin is not None:
                com = tuple(map(float, origin.get("xyz", "0 0 0").split()))
                assert set(origin.get("rpy", "0 0 0").split()) <= {"0", "0.0"}
            i = {k: float(v) for k, v in inertial.find("inertia").attrib.items()}
            name = robot["name"] + "/" + link.get("name") if many else link.get("name")
            scale = robot.get("mass_scale", {}).get(link.get("name"), 1)
            bodies[name] = (scale * float(inertial.find("mass").get("value")), com,
                            symmetric(*(scale * i[k] for k in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))))
            for load in robot.get("payload", []):
                if load["link"] == link.get("name"):
                    bodies[name] = with_point(*bodies[name], load["mass"], load["point"])
    for body in description.get("body", []):
        if body.get("fixed") or "motion" in body:
            continue
        m = body["mass"]
        inertia = body.get("inertia")
        solid = (m, tuple(body.get("com", (0, 0, 0))),
                 symmetric(*inertia) if inertia else inertia_of_shape(body["shape"], m))
        copies = math.prod(body.get("copies", {}).get("count", [1]))
        names = [body["name"]] if copies == 1 else [f"{body['name']}{i + 1}" for i in range(copies)]
        bodies.update(dict.fromkeys(names, solid))
    return bodies


class Contents:
    """Kinetic and potential energy, momentum, angular momentum about the world's origin."""

    def __init__(self, bodies, links):
        self.kinetic = self.potential = 0
        self.linear, self.angular = (0, 0, 0), (0, 0, 0)
        self.weight_moved = 0
        for name, (m, com, inertia) in bodies.items():
            link = links[name]
            rotation, w = link["rotation"], link["angular_velocity"]
            arm = times(rotation, com)
            c = add(link["position"], arm)
            v = add(link["linear_velocity"], cross(w, arm))
            spin = times(rotation, times(inertia, times(transpose(rotation), w)))
            self.kinetic += 0.5 * m * dot(v, v) + 0.5 * dot(w, spin)
            self.potential -= m * dot(GRAVITY, c)
            self.linear = add(self.linear, v, m)
            self.angular = add(self.angular, add(spin, cross(c, v), m))


def size(v):
    return math.sqrt(dot(v, v))
