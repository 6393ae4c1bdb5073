"""Cases of each reader: files that are read well, changed by hostile_grammar, and commands that read them."""
import pathlib
import re
import shlex
import subprocess
import tempfile
import tomllib

from hostile_grammar import changed
from hostile_run import Case

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA, FUZZ, ASSETS = ROOT / "tests/data", ROOT / "tests/fuzz", ROOT / "assets"
MESHES = ROOT / "tests/collision/mesh_files/tetrahedron"
CASES = tomllib.loads((DATA / "hostile_cases.toml").read_text())
NO_SCENE = {"refusals.toml", "likely_mistakes.toml", "hostile_cases.toml", "faulty_start.toml", "floor.toml"}


def literal(file, name):
    """A text of the fuzzer's C++."""
    return re.search(rf'{name} = R"\((.*?)\)";', (FUZZ / file).read_text(), re.S)[1]


def files_of(*patterns):
    return {path.name: path.read_bytes() for pattern in patterns for path in sorted(ROOT.glob(pattern))
            if path.is_file()}


def companions():
    """What the files that are read name."""
    found = files_of("tests/data/*.urdf", "tests/data/flag.obj", "tests/fuzz/seeds/image/rgb.png")
    found |= {name: (MESHES / source).read_bytes() for name, source in
              {"box.stl": "text.stl", "lower.stl": "text.stl", "upper.stl": "bytes.stl"}.items()}
    found["flag.mtl"] = b"newmtl cloth\nKd 1 1 1\nmap_Kd rgb.png\n"
    found["hand.csv"] = b"".join((ASSETS / "traces/synthetic_seed1.csv").read_bytes().splitlines(True)[:100])
    return found


MAP = ("map map_hinge.toml --x coupling.damping:0.5:20:40 --y step:0.005:0.05:40 --duration 0.1 --jobs 2 --job 0 "
       "--checkpoint")


def device_scene():
    return (ASSETS / "scenes/hand_and_obstacles.toml").read_bytes().replace(b"../", f"{ASSETS}/".encode())


def made_by(program):
    """Recordings, and the map file of one of two jobs, as the program writes them today."""
    made = {}
    with tempfile.TemporaryDirectory(prefix="twinarm-hostile-") as folder:
        for name in ("bouncing_ball", "rod", "hinge", "two_balls"):
            file = pathlib.Path(folder) / f"{name}.twinrec"
            subprocess.run([program, "simulate", DATA / f"{name}.toml", "--duration", "0.02", "--record", file],
                           check=True, capture_output=True)
            made[file.name] = file.read_bytes()
        file = pathlib.Path(folder) / "made.map"
        subprocess.run([program, *MAP.split(), file], check=True, capture_output=True, cwd=DATA)
        made[file.name] = file.read_bytes()
    return made


class Readers:
    """names: of the readers; case(name, dice): one of its cases; seeds(): each file as it is, with a command."""

    def __init__(self, made):
        self.beside = companions()
        self.fuzz_arm = literal("scene.cpp", "kArm").encode()
        self.couplings = files_of("tests/fuzz/seeds/scene/*.toml")
        self.settings = {f"assets/study/{path.name}": path.read_bytes() for path in (ASSETS / "study").iterdir()
                         if path.name in ("settings.toml", "calibration.json", "predictions.toml")}
        self.files = {name: files_of(*given["files"]) for name, given in CASES["readers"].items()}
        for name in NO_SCENE:
            del self.files["scene"][name]
        self.files["recording"] |= {name: data for name, data in made.items() if name.endswith(".twinrec")}
        self.files["trace"]["hand.csv"] = self.beside["hand.csv"]
        self.files["settings"], self.files["map"]["made.map"] = self.settings, made["made.map"]
        self.names = list(self.files)

    def case(self, name, dice, file=None, is_changed=True):
        files = self.files[name]
        file = file or dice.choice(list(files))
        data = changed(file, files[file], dice) if is_changed else files[file]
        words = dice.choice(CASES["readers"][name]["commands"]).replace("{map}", MAP).replace("{f}", file).split()
        beside = {file: data, **self.needed(name, file, data)}
        may_write = {file} if name == "map" and "--checkpoint" in words else set()
        links = {"assets/robots": ASSETS / "robots"} if name == "settings" else {}
        return Case(name, f"{name} {file}", words, beside, links, may_write)

    def needed(self, name, file, data):
        beside = {key: value for key, value in self.beside.items() if key != file}
        if name == "scene" and file in self.couplings:
            beside["arm.urdf"] = self.fuzz_arm
        elif name == "trace":
            beside["traced.toml"] = self.couplings["couplings.toml"].replace(b"hand.csv", file.encode())
            beside |= {"arm.urdf": self.fuzz_arm, "device.toml": device_scene()}
        elif name == "mesh":
            beside["meshed.urdf"] = self.beside["flag.urdf"].replace(b"flag.obj", file.encode()).replace(
                b"</link>", b'<collision><geometry><mesh filename="%s"/></geometry></collision></link>' % file.encode())
            beside["meshed.toml"] = self.couplings["mesh.toml"].replace(b"box.stl", file.encode())
        elif name == "texture":
            beside["flag.mtl"] = self.beside["flag.mtl"].replace(b"rgb.png", file.encode())
        elif name == "settings":
            return {key: value for key, value in self.settings.items() if key != file}
        elif name == "recipe":
            beside |= {f"meshes/{part}.stl": beside["box.stl"] for part in ("lower", "upper")}
        elif name == "map":
            beside[file + "2"], beside["map_hinge.toml"] = data, (DATA / "map_hinge.toml").read_bytes()
        return beside

    def seeds(self, dice):
        for name in self.names:
            for file in self.files[name]:
                yield self.case(name, dice, file, is_changed=False)


def refused_command_lines():
    """Those of tests/data/refusals.toml and likely_mistakes.toml."""
    files = {path.name: path.read_bytes() for path in DATA.iterdir()}
    rows = [row for rows in tomllib.loads((DATA / "refusals.toml").read_text()).values() for row in rows]
    rows += tomllib.loads((DATA / "likely_mistakes.toml").read_text())["mistake"]
    for row in rows:
        words = shlex.split(row["words"].replace("{out}", "out"))
        made = {f"out/{name}": row[key].encode() for key, name in (("state", "state.json"), ("scene", "scene.toml"))
                if key in row}
        if "state" in row:
            words += ["--state", "out/state.json"] * ("--state" not in words)
        if words and words[0] not in ("trace", "make-robot", "help"):
            words.append("--json")
        yield Case("refusal", f"refusal: {row['words']}", words, files | made | {"out/.keep": b""})
