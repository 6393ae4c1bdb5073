#!/usr/bin/env python3
"""A map through a real Slurm controller and node daemon on this machine, and through GNU parallel.

    test_map_slurm.py PATH/TO/twinarm

Needs root, slurm-wlm and munge (scripts/setup --cluster); says so and is skipped where they are not
installed. All daemons belong to this test, live in a temporary folder with ports of their own, and
are ended by their process numbers. One part of the map is killed on the way.
"""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

from waiting import TIMEOUT  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ""
NEEDED = ("slurmctld", "slurmd", "munged", "sbatch", "sinfo", "scontrol")
SCENE = """
duration = 1
gravity = [0, 0, 0]
[[robot]]
name = "hinge"
model = "hinge.urdf"
[[coupling]]
type = "torsional"
measure = "joint"
link = "arm"
stiffness = 500
damping = 1
treatment = "explicit"
target = { q = { hinge = 0.01 } }
"""
HINGE = ('<robot name="hinge"><link name="base"/><link name="arm"><inertial><mass value="1"/>'
         '<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.5"/></inertial></link>'
         '<joint name="hinge" type="continuous"><parent link="base"/><child link="arm"/>'
         '<axis xyz="0 0 1"/></joint></robot>')
AXES = ["--x", "coupling.damping:0.5:20:48", "--y", "coupling.stiffness:10:1e5:48:log"]
CONF = """
ClusterName=twinarm
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ctld}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=0
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class OnCluster(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="twinarm-slurm-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.folder.chmod(0o755)
        (self.folder / "hinge.urdf").write_text(HINGE)
        self.scene = self.folder / "scene.toml"
        self.scene.write_text(SCENE)
        self.environment = dict(os.environ, TWINARM=PROGRAM,
                                SLURM_CONF=str(self.folder / "slurm.conf"))
        whole = self.folder / "whole.twinmap"
        subprocess.run([PROGRAM, "map", self.scene, *AXES, "--work", whole], check=True, timeout=TIMEOUT,
                       stdout=subprocess.DEVNULL)
        self.whole = whole.read_bytes()

    def daemon(self, *command, log):
        with open(self.folder / log, "wb") as out:
            process = subprocess.Popen([*map(str, command)], env=self.environment, stdout=out,
                                       stderr=subprocess.STDOUT)
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
        return "\n".join(f"{f.name}:\n{f.read_text(errors='replace')[-1500:]}"
                         for f in self.folder.glob("*.log"))

    def start_slurm(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        host = socket.gethostname().split(".")[0]
        (self.folder / "slurm.conf").write_text(CONF.format(
            host=host, ctld=free_port(), node=free_port(), folder=self.folder, user="root"))
        (self.folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n")
        self.daemon("munged", "--foreground", "--force", "--key-file", key, "--socket",
                    self.folder / "munge.socket", "--pid-file", self.folder / "munged.pid",
                    "--log-file", self.folder / "munged.log", "--seed-file",
                    self.folder / "munged.seed", log="munged.out.log")
        self.wait_for(lambda: (self.folder / "munge.socket").exists(), "munged")
        self.daemon("slurmctld", "-D", log="slurmctld.out.log")
        self.daemon("slurmd", "-D", "-N", host, log="slurmd.out.log")
        self.wait_for(lambda: subprocess.run(
            ["sinfo", "--noheader", "--format=%T"], env=self.environment, capture_output=True,
            text=True).stdout.strip() == "idle", "slurm")

    def wait_for(self, is_so, what):
        end = time.time() + TIMEOUT
        while not is_so():
            self.assertLess(time.time(), end, f"{what} does not come up\n{self.logs()}")
            time.sleep(0.2)

    def kill_part(self, number, submitted):
        """The program that computes the part, once it has kept a block. Its process number."""
        end = time.time() + TIMEOUT
        while time.time() < end and submitted.poll() is None:
            for entry in pathlib.Path("/proc").glob("[0-9]*"):
                try:
                    words = (entry / "cmdline").read_bytes().decode(errors="replace").split("\0")
                except OSError:
                    continue
                mine = words[0] == PROGRAM and str(self.scene) in words and "--tile" in words
                if mine and words[words.index("--tile") + 1] == str(number):
                    os.kill(int(entry.name), signal.SIGKILL)
                    return int(entry.name)
            time.sleep(0.01)
        return 0

    def test_a_job_array_with_one_part_killed_gives_the_bytes_of_one_machine(self):
        absent = [p for p in NEEDED if not shutil.which(p)]
        if absent:
            self.skipTest(f"Slurm is not installed ({', '.join(absent)} missing): scripts/setup --cluster")
        if os.getuid() != 0:
            self.skipTest("starts slurmd, which needs root")
        self.start_slurm()
        out = self.folder / "parts"
        run = subprocess.Popen([ROOT / "scripts/cluster/map_slurm", "4", out, self.scene, *AXES],
                               env=self.environment, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True)
        killed = self.kill_part(2, run)
        try:
            told, _ = run.communicate(timeout=TIMEOUT)
        except subprocess.TimeoutExpired:
            run.kill()
            self.fail(self.logs())
        self.assertGreater(killed, 0, told)
        self.assertEqual(run.returncode, 0, told + self.logs())
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
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
