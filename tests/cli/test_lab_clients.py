"""`twinarm lab`: what clients without control cannot do, and the log of what the others change."""
import json
import re

from lab_test import ROD, LabTest, Running
from live_socket import Lab
from program import ROOT, SCENES, ProgramTest, main

STIFFNESS = "coupling[0].stiffness=21"
# A valid message for each command.
COMMANDS = {
    "layers": {"names": ["bodies"]}, "inspect": {"on": True, "body": 1}, "request_control": {},
    "grant_control": {"to": 2}, "seek": {"at": 0.0}, "play": {"on": False}, "step": {"steps": 5},
    "speed": {"factor": 0.5}, "set": {"changes": [STIFFNESS]}, "branch": {"at": 0.0, "changes": [STIFFNESS]},
    "preset": {"name": "s103"}, "scene": {"name": "gyroscope"}, "edit": {"what": "floor"}, "reset": {},
    "reset_parameters": {}, "input": {"source": "joints"}, "drag_stylus": {"goal": [0, 0, 1]},
    "joint": {"index": 0, "value": 1.0}, "rotate_stylus": {"yaw": 1, "pitch": 0, "roll": 0},
    "axes": {"rates": [1, 0, 0, 0, 0, 0]}, "button": {"index": 0, "down": True},
    "drag_body": {"body": 1, "point": [0, 0, 0], "goal": [0, 0, 1]}, "release": {}}
FREE = {"layers", "inspect", "request_control"}


def steady(state):
    """What no onlooker changes."""
    kept = ("scene", "name", "changes", "variants", "controller", "playing", "speed", "at", "branch", "failure")
    return {key: state[key] for key in kept} | {"source": state["input"]["source"]}


class Onlookers(LabTest):
    def setUp(self):
        super().setUp()
        self.other = self.lab.live()
        self.state(live=self.other)
        self.addCleanup(self.other.close)

    def test_each_command_that_changes_something_needs_control_whatever_else_the_message_says(self):
        source = (ROOT / "app/lab/session/lab_command.cpp").read_text()
        forms = re.findall(r'\{"(\w+)",\s*(true|false)', source)
        self.assertEqual({name for name, _ in forms}, set(COMMANDS))
        you = self.state()["you"]
        before, gripper = steady(self.state()), self.state()["input"]["gripper"]
        lies = {"you": you, "client": you, "controller": you, "secret": json.loads(self.live.newest["state"])["secret"]}
        for name, details in COMMANDS.items():
            if name in FREE:
                continue
            with self.subTest(name):
                self.other.do(name, **(details | lies))
                self.other.say(json.dumps({"do": "layers", "names": []})[:-1] + f', "do": "{name}"}}')
        self.state(lambda s: "control" in self.reported(s))
        self.live.do("speed", factor=2.0)  # after all of them
        after = self.state(lambda s: s["speed"] == 2.0)
        self.assertEqual(steady(after), before | {"speed": 2.0})
        self.assertEqual(after["input"]["gripper"], gripper)

    def test_each_request_that_changes_something_needs_the_secret_of_the_client_in_control(self):
        secret, you = self.state()["secret"], self.state()["you"]
        own = json.loads(self.other.newest["state"])["secret"]
        before = steady(self.state())
        queries = ["", f"&secret={own}", "&secret=", f"&secret={you}", f"&secret={secret[:-1]}",
                   f"&secret={secret}0", f"&secret={own}&secret={secret}"]
        for path in ("/open", "/save", "/scene", "/", "/live", "/history"):
            for query in queries:
                with self.subTest(path + query):
                    self.assertEqual(self.lab.post(f"{path}?name=a.urdf{query}", ROD).status, 403)
        for path in ("/open?name=a.urdf", f"/open?name=a.urdf&secret={secret}"):
            self.assertEqual(self.lab.get(path).status, 404)  # only POST opens
        self.assertEqual(steady(self.state()), before)
        self.assertEqual(self.lab.upload("a.urdf", ROD, self.live).status, 200)

    def test_a_flood_of_invalid_commands_hides_no_notes_of_others(self):
        self.live.do("set", changes=["coupling[0].stiffness=-5"])
        self.state(lambda s: "-5" in self.reported(s))
        for n in range(300):
            self.other.do(f"nothing{n}")
        notes = self.state(lambda s: "nothing" in self.reported(s))["notes"]
        self.live.do("fly")  # those of the client in control are all shown
        notes = self.state(lambda s: "fly" in self.reported(s))["notes"]
        self.assertIn("-5", notes[0]["text"])
        self.assertLess(len(notes), 10)


class Audit(ProgramTest):
    def test_the_log_says_which_client_changed_what(self):
        self.write("rod.urdf", ROD)
        running = Running(SCENES / "bouncing_ball.toml", "--listen", "0.0.0.0")
        self.addCleanup(running.process.kill)
        lab = Lab(running.url)
        with lab.live() as live, lab.live() as other:
            second = other.wait_for("state")["you"]
            first = live.wait_for("state", lambda s: s["clients"] == 2)["you"]
            live.do("speed", factor=0.5, padding="x" * 5000)
            for n in range(100):
                live.do("drag_body", body=1, point=[0, 0, 0], goal=[0, 0, 0.01 * n])
            other.do("speed", factor=3.0)
            other.do("layers", names=["bodies"])
            live.do("preset", name="\x1b[2J\n" + "n" * 1000)
            live.wait_for("state", lambda s: "nnn" in str(s["notes"]))
            self.assertEqual(lab.upload("new.urdf", ROD, live).status, 200)
            live.do("grant_control", to=second)
            other.wait_for("state", lambda s: s["controller"] == second)
            other.do("play", on=False)
            other.wait_for("state", lambda s: not s["playing"])
        code, errors = running.end()
        self.assertEqual(code, 0)
        stamp = r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ "
        one, two = (f"client {n} at 127.0.0.1: " for n in (first, second))
        expected = [one + "speed factor = 0.5 ", one + "drag_body", one + 'preset name = "\\', one + "open new.urdf",
                    one + f"grant_control to client {second} at 127.0.0.1", two + "play on = false "]
        lines = errors.splitlines()
        self.assertEqual(len(lines), len(expected), errors)
        for line, start in zip(lines, expected):
            self.assertRegex(line, "^" + stamp)
            self.assertTrue(re.sub("^" + stamp, "", line).startswith(start), f"{line!r} begins not with {start!r}")
            self.assertLess(len(line), 500)
            self.assertTrue(line.isprintable())


if __name__ == "__main__":
    main()
