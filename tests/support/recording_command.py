"""What the tests of recordings share: two robots, two scenes, and running the commands."""
import json

from program import data, line_of
from robot_command import HINGE, RobotCommand, joint, link, robot

DOUBLE = robot('<link name="base"/>', link("upper"), link("lower"),
               joint("shoulder", "continuous", "base", "upper", axis="0 1 0",
                     more='<dynamics damping="0.1" friction="0.3"/>'),
               joint("elbow", "continuous", "upper", "lower", xyz="0 0 -1", axis="1 0 0"))
BOXES = data("boxes.toml")
DRIVEN = data("driven.toml")


def held(stiffness, damping, more=""):
    return data("held.toml", stiffness=stiffness, damping=damping) + more


class RecordingCommand(RobotCommand):
    def setUp(self):
        super().setUp()
        self.cwd = self.folder

    def record(self, text, *options, name="run.twinrec", urdf=HINGE, state=None, code=0):
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
        return self.json_of("export", file)

    def replayed(self, file, *options, code=0):
        return self.json_of("replay", file, *options, code=code)

    def refused(self, *arguments):
        return self.twinarm(*arguments, code=2).stderr

    def refused_as(self, code, *arguments):
        return line_of(self.fault(code, *arguments))

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
