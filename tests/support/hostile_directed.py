"""The cases of tests/data/hostile_cases.toml, and files that are too large or too odd to stand there."""
import math
import random
import re

import recording_format
from hostile_cases import ASSETS, CASES, DATA, FUZZ, MESHES, companions, literal
from hostile_run import Case

PIECES = {"{ARM}": '[[robot]]\nname = "r"\nmodel = "arm.urdf"\n',
          "{FREE}": '[[robot]]\nname = "r"\nmodel = "ball_joint.urdf"\n',
          "{SPRING}": '[[coupling]]\ntype = "torsional"\nmeasure = "joint"\nlink = "upper"\nstiffness = 1\n',
          "{DEVICE}": '[[coupling]]\ntype = "god-object"\ntarget = "device"\n',
          "{BODY}": '[[body]]\nname = "b"\nshape = { sphere = { radius = 0.1 } }\nmass = 1\n'}
LARGE = {"scene.too-many": "[[body]]\n" * 10001, "faults.too-many": "[[body]]\n" * 300,
         "toml.too-deep": "a = " + "[" * 300}
LARGE_URDF = {"urdf.too-many": ("</robot>", '<link name="x"/>' * 40001 + "</robot>"),
              "file.too-large": ("<robot", " " * (17 << 20) + "<robot")}
GALLERIES = {"gallery.empty": "", "gallery.look": "look = 1\n", "gallery.name-taken": "\n[[scene]]\nname = 'a'\n",
             "gallery.variants": "variants = { path = 'x', values = [] }\n"}


def whole(text):
    for name, piece in PIECES.items():
        text = text.replace(name, piece)
    return text + "\n"


def points_on_sphere(count):
    """A mesh, all of whose points are vertices of its hull."""
    dice, rows = random.Random(1), []
    for _ in range(count):
        z, turn = dice.uniform(-1, 1), dice.uniform(0, 2 * math.pi)
        r = math.sqrt(1 - z * z)
        rows.append(f"v {r * math.cos(turn):.5f} {r * math.sin(turn):.5f} {z:.5f}")
    return "\n".join(rows + [f"f {n} {n + 1} {n + 2}" for n in range(1, count - 1)]).encode()


def long_chain(count):
    link = ('<link name="l{1}"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
            '</inertial></link><joint name="j{1}" type="continuous"><parent link="l{0}"/><child link="l{1}"/></joint>')
    links = "".join(link.format(n, n + 1) for n in range(count))
    return f'<robot name="r"><link name="l0"/>{links}</robot>'.encode()


def recordings(made):
    """Of the ball, with another header, version or first column."""
    data = made["bouncing_ball.twinrec"]
    blocks = recording_format.blocks(data)
    header = recording_format.header(blocks)

    def with_header(**changes):
        return recording_format.file_of(recording_format.with_header(blocks, header | changes))
    return {"run.twinrec": data, "robot.twinrec": (FUZZ / "seeds/recording/robot.twinrec").read_bytes(),
            "empty.twinrec": b"", "form.twinrec": b"x" * 99, "version.twinrec": recording_format.file_of(blocks, 9),
            "header.twinrec": recording_format.file_of([("H", b"{}"), *blocks[1:]]),
            "path.twinrec": with_header(files=["x.toml"] * len(header["files"])),
            "numbers.twinrec": with_header(columns=header["columns"][:1])}


def recipes(stl):
    cube = next(DATA.parent.rglob("cube.toml")).read_bytes()
    found = {"open/cube.toml": cube, "value.toml": cube.replace(b"[1, 0, 0, 1]", b"[1, 0, 0, 2]"),
             "robot.toml": cube.replace(b'"heavy"', b'"x"')}
    for part in ("lower", "upper"):
        found |= {f"meshes/{part}.stl": stl, f"open/meshes/{part}.stl": stl.replace(b"facet", b"x", 1)}
    return found


def studies():
    settings = (ASSETS / "study/settings.toml").read_text()
    wrong = settings.replace("[1.0, 6.0]", "[6, 1]").replace(
        "[30, 60, 120, 250, 1000]", "[30]").replace("seeds = 100", "seeds = 1.5")
    wrong = re.sub(r"^link = .*$", "", wrong.replace("[60, 150]", "[]"), flags=re.M)
    return {"ranges/study/settings.toml": wrong.replace("[[robot.mount]]", "[[robot.mounts]]", 1).encode(),
            "uncalibrated/study/settings.toml": settings.encode()}


def all_files(made):
    found = companions() | recordings(made) | studies() | {
        name: whole(text).encode() for name, text in CASES["files"].items()}
    head = (ASSETS / "traces/synthetic_seed1.csv").read_text().splitlines()[1]
    return found | recipes(found["box.stl"]) | {
        "arm.urdf": literal("scene.cpp", "kArm").encode(), "jointed.urdf": (DATA / "arm.urdf").read_bytes(),
        "x.obj": (MESHES / "t.obj").read_bytes().rpartition(b"f ")[0],  # a tetrahedron without one face
        "socket.json": None, "large.json": b" " * (5 << 20), "long.csv": b"1," * 50000, "long.urdf": long_chain(1001),
        "wrong.csv": (head + "\n" + "x,y,z,1,2,3,4,5\n" * 60).encode(), "made.map": made["made.map"],
        "outside.map": made["made.map"] + b"4000,4000,0,,,,\n",
        "map_hinge.toml": (DATA / "map_hinge.toml").read_bytes()}


def directed(made):
    files = all_files(made)
    for code, text in (CASES["scenes"] | LARGE).items():
        needed = companions() | {name: data for name, data in files.items() if name in text}
        if "round.obj" in text:
            needed["round.obj"] = points_on_sphere(60000)
        yield Case("directed", code, ["simulate", "s.toml", "--duration", "0.01", "--json"],
                   needed | {"arm.urdf": files["arm.urdf"], "s.toml": whole(text).encode()})
    for code, (old, new) in (CASES["urdf"] | LARGE_URDF).items():
        yield Case("directed", code, ["dynamics", "a.urdf", "--strict", "--json"],
                   {"a.urdf": files["arm.urdf"].replace(old.encode(), new.encode(), 1), "box.stl": files["box.stl"]})
    links = {f"{name}/robots": ASSETS / "robots" for name in ("ranges", "uncalibrated")}
    for code, words in CASES["words"].items():
        yield Case("directed", code, words.split(), files, links, {"value.urdf"},
                   before=["simulate still.toml --record still.twinrec"] if "still" in words else [],
                   stop_after=4 if words.startswith(("lab", "hand")) else 0)
    film = "render b.toml --mp4 o.mp4 --to 0.1 --size 64x48 --json".split()
    yield Case("directed", "program.missing", film, files, path="/nowhere")
    yield Case("directed", "program.failed", film, files, path="{here}/bin")
    yield Case("directed", "program.not-started", film, files | {"bin/ffmpeg": b"\x7fELF not one"}, path="{here}/bin")
    for code, text in GALLERIES.items():
        text = "[[scene]]\nname = 'a'\nfile = 'b.toml'\ntitle = 't'\n" + text if text else ""
        files = {"assets/scenes/gallery/gallery.toml": text.encode(), "assets/scenes/b.toml": whole("{BODY}").encode(),
                 "bin/sub/.keep": b""}
        yield Case("directed", code, ["lab", "--no-browser", "--port", "0", "--json"], files,
                   {"assets/robots": ASSETS / "robots"}, stop_after=2, has_own_assets=True)
