"""What the tests of recordings share: two robots, two scenes, and running the commands."""
import json
import subprocess

import robot_command
from robot_command import RobotCommand, joint, link, robot
from waiting import TIMEOUT

DOUBLE = robot('<link name="base"/>', link("upper"), link("lower"),
               joint("shoulder", "continuous", "base", "upper", axis="0 1 0",
                     more='<dynamics damping="0.1" friction="0.3"/>'),
               joint("elbow", "continuous", "upper", "lower", xyz="0 0 -1", axis="1 0 0"))
ROD = robot('<link name="base"/>', link("rod", 1, (0, 0, 0), (1, 0, 0, 1, 0, 0.5)),
            joint("hinge", "continuous", "base", "rod"))
HELD = """
[[robot]]
name = "arm"
model = "test.urdf"
q = { hinge = 0.5 }
[[coupling]]
name = "pull"
type = "torsional"
measure = "joint"
link = "rod"
stiffness = %s
damping = %s
treatment = "explicit"
%s
target = { q = { hinge = 0.0 } }
"""
BOXES = """
step = 0.002
%s
[[body]]
name = "floor"
fixed = true
shape = { halfspace = { normal = [0, 0, 1], offset = 0 } }
[[body]]
name = "low"
shape = { box = { size = [0.2, 0.2, 0.2] } }
mass = 1
position = [0, 0, 0.12]
linear_velocity = [0.8, 0, 0]
angular_velocity = [0, 0, 3]
[[body]]
name = "high"
shape = { box = { size = [0.2, 0.2, 0.2] } }
mass = 1
position = [0.03, 0.01, 0.35]
restitution = 0.3
"""
DRIVEN = """
integrator = "rk4"
[[body]]
name = "wheel"
shape = { cylinder = { radius = 0.5, length = 0.1 } }
position = [0, 0, 1]
motion = { angular = [0, 0, 3], linear = [0.2, 0, 0] }
group = 1
[[body]]
name = "bob"
shape = { box = { size = [0.1, 0.2, 0.6] } }
mass = 2
position = [0.5, 0, 0.7]
linear_velocity = [0.2, 1.5, 0]
group = 1
[[constraint]]
name = "hook"
type = "ball"
a = "bob"
b = "wheel"
point = [0.5, 0, 1]
"""


class RecordingCommand(RobotCommand):
    def twinarm(self, *arguments, code=0):
        result = subprocess.run([robot_command.PROGRAM, *map(str, arguments)], cwd=self.folder,
                                capture_output=True, text=True, timeout=TIMEOUT)
        self.assertEqual(result.returncode, code, result.stderr + result.stdout[:2000])
        return result

    def record(self, text, *options, name="run.twinrec", urdf=ROD, state=None, code=0):
        is_scene = not text.startswith("<robot")
        (self.folder / "test.urdf").write_text(urdf if is_scene else text)
        model = self.folder / ("scene.toml" if is_scene else "test.urdf")
        if is_scene:
            model.write_text(text)
        arguments = ["simulate", model, *options, "--json", "--record", self.folder / name]
        if state is not None:
            (self.folder / "state.json").write_text(json.dumps(state))
            arguments += ["--state", self.folder / "state.json"]
        self.simulated = self.twinarm(*arguments, code=code)
        return self.folder / name

    def exported(self, file):
        return json.loads(self.twinarm("export", file, "--json").stdout)

    def replayed(self, file, *options, code=0):
        return json.loads(self.twinarm("replay", file, *options, "--json", code=code).stdout)

    def refused(self, *arguments):
        result = self.twinarm(*arguments, code=2)
        return result.stderr

    def refused_as(self, code, *arguments):
        """One fault, of that code; returns all that it says."""
        (fault,) = json.loads(self.twinarm(*arguments, "--json", code=2).stdout)["errors"]
        self.assertEqual(fault["code"], code, fault)
        return " ".join((fault["file"], fault["where"], fault["rule"], fault["remedy"]))

    def goes_on_with_the_same_bits(self, file, times):
        frames = self.exported(file)["frames"]
        for t in times:
            answer = self.replayed(file, "--from", t)
            at = max(n for n, f in enumerate(frames) if f["t"] <= t + 1e-12)
            self.assertEqual(answer["hash"], frames[at]["hash"])
            self.assertEqual(answer["hash_again"], answer["hash"])
            self.assertEqual(answer["compared"], len(frames) - 1 - at)
            self.assertEqual(answer["equal"], answer["compared"], answer)
            self.assertTrue(answer["bit_exact"])
