"""Hostile requests, frames and commands for a running lab; a well-behaved client is served afterwards.
scripts/check/hostile."""
import json
import os
import random
import select
import shutil
import signal
import socket
import subprocess
import time

from hostile_cases import DATA, FUZZ
from hostile_grammar import VALUES, change_bytes, change_pair
from hostile_run import LIMITED, Case
from live_socket import Lab

QUERIES = ["", "?", "?from=nan", "?from=-1e308", "?width=1e9&height=1e9", "?width=nan",
           "?name=..%2f..%2fx.toml&secret=x",
           "?name=%00", "?" + "a" * 5000, "?token=" + "x" * 40]
PATHS = ["/", "/scene", "/history", "/frame.png", "/save", "/share", "/open", "/live", "/mesh/0",
         "/mesh/../../etc/passwd",
         "/texture/%2e%2e/x", "/gallery/x.png", "/gallery/../gallery.toml", "//", "/\udcff", "*",
         "http://other/", "/%zz"]
METHODS = ["GET", "POST", "PUT", "HEAD", "OPTIONS", "DELETE", "TRACE", "CONNECT", "G\0T", "A" * 9000]
HEADERS = ["Content-Length: -1", "Content-Length: 99999999999", "Content-Length: x", "Transfer-Encoding: chunked",
           "Host: other.example", "Origin: http://other.example", "Cookie: " + "a=b; " * 3000, "Upgrade: websocket",
           "X: \0",
           "Accept-Encoding: gzip;q=nan", "Connection: Upgrade", "Sec-WebSocket-Key: x", "Range: bytes=0-", " folded"]
COMMANDS = [path.read_text() for path in sorted((FUZZ / "seeds/lab_message").iterdir())] + [
    json.dumps(one) for one in (
        {"do": "scene", "name": "nowhere"}, {"do": "scene", "name": "pendulum"}, {"do": "preset", "name": "E9"},
        {"do": "set", "changes": ["step=1e-9"]}, {"do": "set", "changes": ["step=fast"]}, {"do": "set", "changes": []},
        {"do": "set", "changes": ["coupling.stiffness=1e8"]}, {"do": "set", "changes": ["robot.x=1"]},
        {"do": "input", "source": "nothing"}, {"do": "input", "source": "device", "spec": "omni"}, {"do": "fly"},
        {"do": 1},
        {"do": "input", "source": "device", "spec": "vrpn:a@nowhere.invalid"}, {"do": "edit", "what": "nothing"}, {},
        {"do": "edit", "what": "link-spring", "name": "nothing"}, {"do": "play"}, {"do": "speed", "factor": 9e9},
        {"do": "layers", "names": ["nothing"]}, {"do": "step", "steps": 100000}, {
            "do": "branch", "at": 1e300, "changes": []},
        {"do": "release"}, {"do": "reset"}, {"do": "reset_parameters"}, {"do": "inspect", "on": True, "body": 99999},
        {"do": "inspect", "on": "x"}, [], {"do": "drag_body", "body": 1, "point": [0, 0, 0], "goal": [1e308, 0, 0]})]


class HostileLab:
    def __init__(self, program, folder, scene):
        self.place = folder / "lab"
        shutil.rmtree(self.place, ignore_errors=True)
        (self.place / "tmp").mkdir(parents=True)
        for path in DATA.glob("rod.*"):
            shutil.copy(path, self.place)
        for name in ("ball.toml", "flag.urdf", "flag.obj"):
            shutil.copy(DATA / name, self.place)
        (self.place / "fixed.toml").write_text('[[robot]]\nname = "r"\nmodel = "flag.urdf"\n'
                                               '[[coupling]]\ntype = "linear"\nlink = "pole"\nstiffness = 1\n')
        limits = LIMITED.replace("ulimit -t 11", "ulimit -t 3600")
        self.process = subprocess.Popen(["sh", "-c", limits, "sh", program, "lab", scene, "--json", "--no-browser"],
                                        cwd=self.place, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                        env=dict(os.environ, TMPDIR=str(self.place / "tmp")), start_new_session=True)
        self.lab, self.notes = Lab(json.loads(self.process.stdout.readline())["url"]), set()
        self.live = None

    def connected(self):
        if self.live is None:
            self.live = self.lab.live()
            self.live.do("request_control")
        return self.live

    def request(self, dice):
        """Bytes that are nearly a request, with the token or without."""
        if dice.random() < 0.3:
            data = change_bytes(dice.choice(list((FUZZ / "seeds/http").iterdir())).read_bytes(), dice)
        else:
            lines = [f"{dice.choice(METHODS[:2] * 4 + METHODS)} {dice.choice(PATHS)}{dice.choice(QUERIES)} HTTP/1.1",
                     f"Host: {self.lab.host}:{self.lab.port}"][:dice.choice((1, 2, 2, 2))]
            lines += [f"Cookie: {self.lab.cookie}"] * (dice.random() < 0.7) + dice.sample(HEADERS, dice.randrange(4))
            data = "\r\n".join([*lines, "", ""]).encode("utf-8", "surrogateescape") + dice.randbytes(dice.randrange(9))
        with socket.create_connection((self.lab.host, self.lab.port), timeout=5) as wire:
            wire.sendall(data)
            wire.settimeout(dice.choice((0.01, 0.05)))
            try:
                wire.recv(4096)
            except (TimeoutError, ConnectionError):
                pass

    def upload(self, dice):
        files = [DATA / "ball.toml", DATA / "hinge.urdf", FUZZ / "seeds/recording/bouncing_ball.twinrec"]
        file = dice.choice(files)
        self.lab.upload(dice.choice([file.name, file.name, "x.stl", "..%2fx.toml", "%ff.toml", ""]),
                        change_bytes(file.read_bytes(), dice), self.connected())

    def frame(self, dice):
        live = self.connected()
        opcode = dice.choice((1, 1, 1, 0, 2, 3, 8, 9, 10, 15))
        live.send_frame(opcode, dice.choice((b"", b"\xff\xfe", b"[" * 300, b"{", dice.randbytes(50), b"a" * 70000)))

    def command(self, dice):
        text = dice.choice(COMMANDS)
        for _ in range(dice.choice((0, 0, 1, 1, 2))):
            text = change_pair(text, dice, False)
        if dice.random() < 0.1:
            text = text.replace("1", dice.choice(VALUES), 1)
        self.connected().send_frame(1, text.encode("utf-8", "surrogateescape"))

    def read(self):
        """The notes of what has arrived."""
        while self.live and select.select([self.live], [], [], 0)[0]:
            for kind, payload in self.live.pump():
                if kind == "state":
                    self.notes |= {note["text"] for note in json.loads(payload)["notes"]}

    def attack(self, dice):
        how = dice.choice((self.request, self.upload, self.frame, self.command, self.command, self.command))
        try:
            how(dice)
            self.read()
        except (ConnectionError, TimeoutError, OSError):
            self.live = None  # the lab hangs up on who breaks the protocol

    def faults(self):
        """Of a well-behaved client after the attacks, and of the end."""
        faults = []
        try:
            with self.lab.live() as live:
                live.wait_for("frame", timeout=20)
                if self.lab.get("/scene").status != 200:
                    faults.append("does not answer /scene")
        except OSError as fault:
            faults.append(f"does not answer a well-behaved client: {fault!r}")
        self.process.send_signal(signal.SIGINT)
        try:
            _, errors = self.process.communicate(timeout=20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            return [*faults, "does not end by SIGINT"], self.process.communicate()[1]
        if self.process.returncode != 0:
            faults.append(f"ended with {self.process.returncode}")
        left = [str(path) for path in (self.place / "tmp").iterdir()]
        return faults + [f"left {left}"] * bool(left) + ["internal error"] * ("exception in" in errors), errors

    def kill(self):
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()


def attack_lab(program, folder, options, tally):
    """Attacks in groups of a hundred, each on a new lab."""
    count = options.cases if options.only == "lab" and options.cases else 40 if options.short else 600
    for first in range(0, count, 100):
        dice = random.Random(f"lab/{options.seed}/{first}")
        lab = HostileLab(program, folder, ("rod.toml", "ball.toml", "fixed.toml")[first // 100 % 3])
        end = time.monotonic() + 60
        try:
            for _ in range(min(100, count - first)):
                if time.monotonic() < end and lab.process.poll() is None:
                    lab.attack(dice)
            time.sleep(0.3)
            lab.attack(dice)
            faults, errors = lab.faults()
        finally:
            lab.kill()
        tally.readers["lab"] += min(100, count - first) - 1
        tally.add(Case("lab", f"lab {first // 100}", ["lab", "--seed", options.seed]), faults, [],
                  errors + "\n".join(lab.notes))
