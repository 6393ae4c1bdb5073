"""What is struck by scripts/check/kill_test: each kind of command, and what is promised of it."""
import http.client
import json
import signal
import subprocess
import threading

from blows import ROOT, Victim, demand
from whole_files import check_whole, map_cells, recorded_blocks

from live_socket import Lab
from program import data
from waiting import TIMEOUT

ARM = ROOT / "assets/scenes/robot_beside_obstacles.toml"


def beginning_of(whole, file, words):
    """What is whole of a recording that was cut short must be the undisturbed one's beginning; its frames."""
    data = file.read_bytes()
    blocks = [b for b in recorded_blocks(data) if b[0] != "E"]
    end = blocks[-1][2] if blocks else 0
    demand(whole.startswith(data[:end]), f"{file.name}, {words}: it is no beginning of the whole run")
    return sum(kind == "F" for kind, _, _ in blocks)


class Simulate(Victim):
    """Frames up to the last flush are there: FILE.part after a kill, FILE (end: interrupted) after Ctrl-C."""
    name = "simulate"

    def command(self):
        return [self.program, "simulate", ARM, "--duration", "3", "--record", self.out / "run.twinrec"]

    def keep_reference(self):
        self.whole = (self.out / "run.twinrec").read_bytes()

    def strike(self, blow):
        if self.random.random() < 0.5:
            (self.out / "run.twinrec").unlink(missing_ok=True)
        return super().strike(blow)

    def look(self, is_done):
        run, part = self.out / "run.twinrec", self.out / "run.twinrec.part"
        if is_done:
            demand(run.read_bytes() == self.whole, "run.twinrec is not that of the undisturbed run")
        elif run.exists():
            beginning_of(self.whole, run, "under its own name")
        if not part.exists():
            return
        frames = beginning_of(self.whole, part, "after a kill")
        if run.exists():
            return
        read = subprocess.run([self.program, "replay", run, "--json"], capture_output=True, text=True, timeout=TIMEOUT)
        if frames == 0:
            demand(read.returncode == 2 and "record it again" in read.stderr, f"of no frames: {read.stderr}")
        else:
            answer = json.loads(read.stdout)
            demand(read.returncode == 0 and answer["bit_exact"] and answer["compared"] == frames - 1,
                   f"of {frames} frames, replay: {answer} {read.stderr}")


class Map(Victim):
    """What is finished stays, the same command goes on from it, and gives the bytes of an undisturbed map."""
    name = "map"

    def command(self):
        scene = self.out.parent / "hinge.toml"
        if not scene.exists():
            scene.write_text(data("map_hinge.toml", duration=0.5))
            (self.out.parent / "hinge.urdf").write_text(data("hinge.urdf"))
        return [self.program, "map", scene, "--x", "coupling.damping:0.5:20:64", "--y",
                "coupling.stiffness:10:1e5:64:log", "--no-simd", "--force", "--checkpoint", self.out / "work.twinmap",
                "--csv", self.out / "map.csv", "--svg", self.out / "map.svg"]

    def keep_reference(self):
        self.whole = {p.name: p.read_bytes() for p in self.files()}
        self.cells = map_cells(self.whole["work.twinmap"])
        self.kept = set()
        self.begin_anew()

    def begin_anew(self):
        for path in self.files():
            path.unlink()
        self.kept = set()

    def look(self, is_done):
        work = self.out / "work.twinmap"
        now = map_cells(work.read_bytes()) if work.exists() else {}
        demand(self.kept <= set(now), f"finished cells are lost: {sorted(self.kept - set(now))}")
        demand(all(self.cells[place] == values for place, values in now.items()), "a cell has other values")
        self.kept = set(now)
        if is_done:
            for name, whole in self.whole.items():
                demand((self.out / name).read_bytes() == whole, f"{name} is not that of the undisturbed map")
            self.begin_anew()


class Hand(Victim):
    """hand.csv: rows up to the last flush. From it the run is made again."""
    name = "hand"
    stopped_codes = (0, 130)  # Ctrl-C is an ordinary end; in the recording after it, it is not

    def command(self):
        return [self.program, "hand", ROOT / "assets/scenes/hand_and_obstacles.toml", "--simulated", "--duration",
                "8", "--record", "--out", self.out]

    def keep_reference(self):
        self.log = (self.out / "hand.csv").read_bytes()
        self.whole = (self.out / "run.twinrec").read_bytes()
        (self.out / "scene.toml").rename(self.out.parent / "scene.toml")

    def may_be_cut(self, path):
        return path.name == "hand.csv"

    def look(self, is_done):
        log, run = self.out / "hand.csv", self.out / "run.twinrec"
        data = log.read_bytes() if log.exists() else b""
        demand(self.log.startswith(data), "hand.csv is no beginning of the undisturbed log")
        if is_done and run.exists() and data == self.log:
            demand(run.read_bytes() == self.whole, "run.twinrec is not that of the undisturbed run")
        rows = data.count(b"\n") - 1
        if rows < 100 or self.random.random() < 0.5:
            return
        # Its last row may be torn: the run is made again without it.
        again = self.out.parent / "again.twinrec"
        done = subprocess.run([self.program, "simulate", self.out.parent / "scene.toml", "--duration",
                               repr(min(rows, 1000) / 1000), "--record", again], capture_output=True, text=True,
                              timeout=TIMEOUT)
        demand(done.returncode == 0, f"of a log of {rows} rows: {done.stderr}")
        check_whole(again)


class Render(Victim):
    """A film is there whole or not at all; ffmpeg ends too."""
    name = "film"

    def command(self):
        return [self.program, "render", ARM, "--to", "2", "--fps", "30", "--size", "320x180", "--quality", "draft",
                "--mp4", self.out / "film.mp4"]


class Frames(Victim):
    """Each picture of a film is whole."""
    name = "frames"

    def command(self):
        return [self.program, "render", ARM, "--to", "1", "--fps", "30", "--size", "320x180", "--quality", "draft",
                "--frames", self.out / "frames"]


class Study(Victim):
    """Every file below --out is whole, and after all that the study is the undisturbed one's."""
    name = "study"

    def command(self):
        return [self.program, "study", "--out", self.out]

    def keep_reference(self):
        self.tables = {p.name: p.read_bytes() for p in (self.out / "csv").iterdir()}

    def look(self, is_done):
        if is_done:
            for name, table in self.tables.items():
                demand((self.out / "csv" / name).read_bytes() == table, f"csv/{name} is not the undisturbed one")


class BriefStudy(Study):
    """The same, struck in its first seconds, without an undisturbed one to compare with."""

    def prepare(self):
        self.length = 6

    def finish(self):
        pass


class LabUnderFire(Victim):
    """Runs saved over the socket and files dropped on it: what has come is whole."""
    name = "lab"
    stopped_codes = (0,)

    def command(self):
        return [self.program, "lab", ARM, "--json", "--no-browser"]

    def prepare(self):
        self.length, self.saved = 4, threading.Event()

    def finish(self):
        """It lives until a run is saved, then ends as it is reported to."""
        self.saved.clear()
        self.length = None
        code = self.strike(signal.SIGTERM)
        demand(code == 0, f"ended with {code}")

    def wait_in(self, process, seconds):
        self.client = threading.Thread(target=self.live_with, args=(process,), daemon=True)
        self.client.start()
        if self.length is None:
            demand(self.saved.wait(TIMEOUT), "not one run could be saved")
        else:
            self.client.join(seconds)

    def live_with(self, process):
        """A client, until the lab is gone."""
        try:
            lab = Lab(json.loads(process.stdout.readline())["url"])
            with lab.live() as live:
                live.wait_for("frame", timeout=TIMEOUT)
                for n in range(10**6):
                    lab.upload(f"ball{n}.toml", (ROOT / "assets/scenes/pendulum.toml").read_text(), live)
                    reply = lab.get("/save")
                    if reply.status == 200:  # else it says that it is ending
                        (self.out / "saved.twinrec").write_bytes(reply.body)
                        self.saved.set()
        except (OSError, ValueError, http.client.HTTPException):  # the lab is gone, in an answer perhaps
            pass

    def judge(self, *what):
        self.client.join(20)
        demand(not self.client.is_alive(), "its client waits for ever")
        super().judge(*what)


KINDS = {kind.name: kind for kind in (Simulate, Map, Hand, Render, Frames, LabUnderFire, Study)}
SHORT = KINDS | {"study": BriefStudy}
