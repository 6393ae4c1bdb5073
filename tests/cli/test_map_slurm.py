"""A map through a real Slurm controller and node daemon on this machine, and through GNU parallel.

Needs root, slurm-wlm and munge (scripts/setup --cluster); says so and is skipped where they are not
installed. All daemons belong to this test, live in a temporary folder with ports of their own, and
are ended by their process numbers. One part of the map dies on the way.
"""
import os
import shutil
import socket
import subprocess

import program
from program import ROOT, ProgramTest, data, main
from waiting import TIMEOUT, wait_for

NEEDED = ("slurmctld", "slurmd", "munged", "sbatch", "sinfo", "scontrol")
AXES = ["--x", "coupling.damping:0.5:20:48", "--y", "coupling.stiffness:10:1e5:48:log"]


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


# In place of the program: the first that computes part 2 kills itself.
DIES_ONCE = """#!/bin/sh
case "$*" in *"--job 2 "*) mkdir "$0.died" 2> /dev/null && kill -KILL $$ ;; esac
exec '{program}' "$@"
"""


class OnCluster(ProgramTest):
    def setUp(self):
        super().setUp()
        self.folder.chmod(0o755)
        self.write("hinge.urdf", data("hinge.urdf"))
        self.scene = self.write("scene.toml", data("map_hinge.toml", duration=1))
        dies_once = self.write("twinarm", DIES_ONCE.format(program=program.PROGRAM))
        dies_once.chmod(0o755)
        self.environment = dict(os.environ, TWINARM=str(dies_once), SLURM_CONF=str(self.folder / "slurm.conf"))
        whole = self.folder / "whole.twinmap"
        self.twinarm("map", self.scene, *AXES, "--checkpoint", whole)
        self.whole = whole.read_bytes()

    def daemon(self, *command, log):
        with open(self.folder / log, "wb") as out:
            process = subprocess.Popen([*map(str, command)], env=self.environment, stdout=out, stderr=subprocess.STDOUT)
        self.addCleanup(self.end, process)
        return process

    def end(self, process):
        process.terminate()
        try:
            process.wait(timeout=15)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def logs(self):
        return "\n".join(f"{f.name}:\n{f.read_text(errors='replace')[-1500:]}" for f in self.folder.glob("*.log"))

    def start_slurm(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        host = socket.gethostname().split(".")[0]
        (self.folder / "slurm.conf").write_text(data("slurm.conf").format(
            host=host, ctld=free_port(), node=free_port(), folder=self.folder, user="root"))
        (self.folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n")
        self.daemon("munged", "--foreground", "--force", "--key-file", key, "--socket", self.folder / "munge.socket",
                    "--pid-file", self.folder / "munged.pid", "--log-file", self.folder / "munged.log", "--seed-file",
                    self.folder / "munged.seed", log="munged.out.log")
        wait_for(lambda: (self.folder / "munge.socket").exists(), "munged")
        self.daemon("slurmctld", "-D", log="slurmctld.out.log")
        self.daemon("slurmd", "-D", "-N", host, log="slurmd.out.log")
        wait_for(lambda: subprocess.run(["sinfo", "--noheader", "--format=%T"], env=self.environment,
                                        capture_output=True, text=True).stdout.strip() == "idle", "slurm")

    def test_a_job_array_with_one_part_killed_gives_the_bytes_of_one_machine(self):
        absent = [p for p in NEEDED if not shutil.which(p)]
        if absent:
            self.skipTest(f"Slurm is not installed ({', '.join(absent)} missing): scripts/setup --cluster")
        if os.getuid() != 0:
            self.skipTest("starts slurmd, which needs root")
        self.start_slurm()
        out = self.folder / "parts"
        done = subprocess.run([ROOT / "scripts/cluster/map_slurm", "4", out, self.scene, *AXES], env=self.environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=TIMEOUT)
        self.assertEqual(done.returncode, 0, done.stdout + self.logs())
        self.assertEqual((out / "map.twinmap").read_bytes(), self.whole)
        logs = "".join(f.read_text() for f in out.glob("*.log"))
        self.assertIn("part 2: the program ended with 137, try 1 of 3", logs)

    def test_gnu_parallel_gives_the_bytes_of_one_machine(self):
        if not shutil.which("parallel"):
            self.skipTest("GNU parallel is not installed: scripts/setup --cluster")
        out = self.folder / "parts"
        subprocess.run([ROOT / "scripts/cluster/map_parallel", "5", out, self.scene, *AXES], check=True,
                       env=self.environment, timeout=TIMEOUT, stdout=subprocess.DEVNULL)
        self.assertEqual((out / "map.twinmap").read_bytes(), self.whole)


if __name__ == "__main__":
    main()
