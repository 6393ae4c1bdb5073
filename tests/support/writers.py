"""Every command that writes files, small: what tests of full disks and of read-only folders go through.

Names of files are relative to the folder in which the command is run; run.twinrec lies in the one above."""
import shutil

from program import ROOT, SCENES, ProgramTest

PENDULUM = SCENES / "pendulum.toml"
ROBOT = ROOT / "assets/robots/puma560/puma560.urdf"
MAP = ["map", SCENES / "tracking_map.toml", "--x", "coupling.stiffness:1e4:1e6:4:log", "--y",
       "coupling.damping:10:100:4", "--duration", "0.05"]
SMALL = ["--size", "64x48", "--quality", "draft"]

# name: (words, files that may be left when it fails, though cut short)
WRITERS = {
    "recording": (["simulate", PENDULUM, "--record", "run.twinrec"], {"run.twinrec.part"}),
    "map": ([*MAP, "--checkpoint", "work.twinmap"], set()),
    "table of a map": ([*MAP, "--checkpoint", "../work.twinmap", "--csv", "map.csv"], set()),
    "picture of a map": ([*MAP, "--checkpoint", "../work.twinmap", "--svg", "map.svg"], set()),
    "cell of a map": ([*MAP, "--cell", "1,1", "--record", "cell.twinrec"], {"cell.twinrec.part", "cell.toml"}),
    "hand": (["hand", SCENES / "hand_and_obstacles.toml", "--simulated", "--duration", "0.5", "--record", "--out",
              "."], {"hand.csv"}),
    "picture": (["render", PENDULUM, "--png", "p.png", *SMALL], set()),
    "pictures": (["render", PENDULUM, "--frames", "film", "--to", "0.1", *SMALL], set()),
    "film": (["render", PENDULUM, "--mp4", "p.mp4", "--to", "0.1", *SMALL], set()),
    "page": (["export", "../run.twinrec", "run.html"], set()),
    "fork": (["replay", "../run.twinrec", "--from", "0", "--set", "gravity=0,0,-1", "--plot", "fork.svg"], set()),
    "inspection": (["inspect", ROBOT, "--html", "robot.html"], set()),
    "cases": (["compare", "A1", "--html", "."], set()),
    "trace": (["trace", "--out", "trace.csv"], set()),
    "trial": (["trial", "--simulated", "--yes", "--device", "virtual:synthetic", "--seconds", "0.5", "--time-limit",
               "0.5", "--out", "."], set()),
    "study": (["study", "--out", "."], set()),
}


class WritersTest(ProgramTest):
    """The commands run in self.folder, below self.base."""

    def setUp(self):
        super().setUp()
        self.base, self.folder = self.folder, self.folder / "here"
        self.folder.mkdir()

    def record_pendulum(self):
        self.twinarm("simulate", PENDULUM, "--record", self.base / "run.twinrec")

    def need_ffmpeg(self, words):
        if "--mp4" in words and not shutil.which("ffmpeg"):
            self.skipTest("ffmpeg is not installed: scripts/setup --film")
