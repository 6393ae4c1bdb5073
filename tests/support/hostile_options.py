"""Cases of the command line, by the program's own help: each option of each command with values that it cannot mean,
outputs onto inputs and devices, inputs that are no files. scripts/check/hostile."""
import re
import subprocess

from hostile_cases import CASES, DATA, companions, device_scene
from hostile_run import Case

VALUES = ["", "0", "-1", "1", "2", "3", "-0", "1e9", "-1e9", "1e300", "1e-300", "1e400", "nan", "-nan", "inf", "-inf",
          "abc", "0x10", "1,5", "1e", "+1", " 1", "1 ", "9999999999999999999999", "-9223372036854775808", "1.5",
          "gr\udcfcn", "\udcff\udcfe", "a" * 5000, "%s%n", "../../x", "--json", "-", "'", "a=b", "a=1,2", "0,0,0",
          "nan,0,0",
          "1:2:3", "a:1:2:3", "a:1:2:3:log", "rk4,rk5", "0,0", "1e9x1e9", "16x16", "\x01", "none", "all", "list",
          "coupling.stiffness=1e300", "a.b.c.d.e=1", "gravity=nan,0,0", "[0]", "body[99].mass=1", "step=1e-300",
          "step:0.001:0.01:4096", "virtual", "virtual:trace:hand.csv", "virtual:x", "virtual:synthetic:-1"]
FILES = ["nowhere.toml", "nowhere/deep/x.png", ".", "..", "empty.urdf", "arm.urdf", "hinge.urdf", "ball.toml",
         "hand.csv",
         "run.twinrec", "box.stl", "state.json", "latin\udcfc.toml", "o.png", "o.svg", "o.csv", "o.twinrec", "o.html",
         "o.mp4", "o", "o/x", "arm.urdf/x", "linked.twinrec", "linked.png", "dangling.toml", "round.toml", "full",
         "zero.toml", "zero.urdf", "a" * 300, "{here}/ball.toml", "./ball.toml", "x\n.png"]
OPTION = re.compile(r"^  (?:-\w,)?(--[\w-]+)(?: ([A-Z|a-z,.={}]+(?: \.\.\.)?))?(?:\s|$)", re.M)
POSITIONAL = re.compile(r"^  ([a-z]+)(?: (PATH|TEXT))", re.M)


def help_of(program, command):
    return subprocess.run([program, *command.split(), "--help"], capture_output=True, text=True, check=True).stdout


def commands_of(program):
    """{"coupling predict": [(option, kind of its value), ..]}, as the program's help has them."""
    found = {}

    def look(command):
        text = help_of(program, command)
        below = re.findall(r"^  ([a-z-]+) ", text.partition("Subcommands:\n")[2], re.M)
        if not below:
            found[command] = [(name, kind or "") for name, kind in OPTION.findall(text)]
            found[command] += [("", kind) for _, kind in POSITIONAL.findall(text.partition("Positionals:")[2])]
        for name in below:
            look(f"{command} {name}".strip())
    look("")
    return found


class CommandLines:
    def __init__(self, program):
        self.commands = commands_of(program)
        self.files = companions() | {
            "run.twinrec": (DATA.parent / "fuzz/seeds/recording/bouncing_ball.twinrec").read_bytes(),
            "cube.toml": next(DATA.parent.rglob("cube.toml")).read_bytes(), "hand_scene.toml": device_scene(),
            "state.json": b'{"q": {}}', "empty.urdf": b"", "latin\udcfc.toml": b'[[body]]\nname = "gr\xfcn"\n',
            "victim": b"precious",
            **{name: (DATA / name).read_bytes() for name in ("ball.toml", "hinge.toml", "map_hinge.toml")}}
        self.links = {"linked.twinrec": "victim", "linked.png": "ball.toml", "dangling.toml": "nowhere", "round.toml":
                      "round.toml", "zero.toml": "/dev/zero", "zero.urdf": "/dev/zero", "full": "/dev/full",
                      "o.twinrec.part": "victim", "o.png.part": "victim", "o.csv.part": "victim"}

    def case(self, dice, command=None, option=None):
        command = command or dice.choice(list(self.commands))
        words = CASES["bases"].get(command, command).split()
        if ("--json", "") in self.commands[command]:
            words.append("--json")
        for n in range(dice.choice((1, 1, 2, 3))):
            name, kind = option if option and n == 0 else dice.choice(self.commands[command])
            values = FILES if kind.startswith("PATH") else VALUES
            value = dice.choice(values if dice.random() < 0.85 else VALUES + FILES)
            if not kind:
                words.append(name if dice.random() < 0.9 else f"{name}={value}")
            elif not name:
                words.append(value)
            elif dice.random() < 0.1:
                words.append(name)
            elif name in words and dice.random() < 0.5:
                words[words.index(name) + 1:][:1] = [value]
            else:
                words += [f"{name}={value}"] if dice.random() < 0.5 else [name, value]
        return Case("option", f"option of {command}", words, self.files, self.links, may_write={"cube.urdf"},
                    stop_after=1.0 if command == "lab" else 4.0 if command in ("study", "hand") else 0)

    def each(self, dice):
        for command, options in self.commands.items():
            for option in options:
                yield self.case(dice, command, option)
