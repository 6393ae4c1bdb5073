"""`twinarm lab` as a process, and tests that talk to it over its socket."""
import json
import signal

from live_socket import Frame, Lab
from program import ProgramTest, data, start
from waiting import TIMEOUT

ROD = data("rod.urdf")
SCENE = data("rod.toml")


class Running:
    """The lab with a scene, and its page's address."""

    def __init__(self, scene, *words, **more):
        self.process = start("lab", scene, *words, "--json", "--no-browser", **more)
        self.url = json.loads(self.process.stdout.readline())["url"]

    def end(self, how=signal.SIGINT):
        """Exit code and output."""
        self.process.send_signal(how)
        _, errors = self.process.communicate(timeout=TIMEOUT)
        return self.process.returncode, errors


class LabTest(ProgramTest):
    """A lab with rod.toml, and a client of it."""

    def setUp(self):
        super().setUp()
        self.write("rod.urdf", ROD)
        self.running = Running(self.write("rod.toml", SCENE))
        self.lab = Lab(self.running.url)
        self.live = self.lab.live()

    def tearDown(self):
        self.live.close()
        self.assertEqual(self.running.end(), (0, ""))

    def state(self, condition=lambda state: True, live=None):
        return (live or self.live).wait_for("state", condition)

    def frame(self, condition=lambda frame: True):
        return self.live.wait_for("frame", condition)

    def newest_frame(self, condition):
        """The newest frame if the condition holds for it, else the next for which it does:
        for frames that come before a state or after it."""
        newest = self.live.newest.get("frame")
        return Frame(newest) if newest and condition(Frame(newest)) else self.frame(condition)

    def stand(self):
        """The frame of the pause."""
        self.live.do("play", on=False)
        self.state(lambda s: not s["playing"])
        return self.newest_frame(lambda f: f.paused)

    def saved(self, name):
        file = self.folder / name
        file.write_bytes(self.lab.get("/save").body)
        return file

    def reported(self, state):
        return " ".join(note["text"] for note in state["notes"])

    def by_step(self, file):
        """Of a recording: coordinates and link positions by step."""
        reported = self.json_of("export", file)
        names = [column["name"] for column in reported["columns"]]
        return {frame["step"]: {"t": frame["t"], "values": dict(zip(names, frame["values"]))}
                for frame in reported["frames"]}
