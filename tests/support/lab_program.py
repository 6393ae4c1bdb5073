"""`twinarm lab` as a process, and clients of it that measure, for scripts/measure/lab_load, scripts/check/soak_lab."""
import json
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

from live_socket import FRAME_HEAD

ROOT = pathlib.Path(__file__).resolve().parents[2]
TICK = os.sysconf("SC_CLK_TCK")


def resident(pid):
    """Memory of a process [MB]."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+)", status)[1]) / 1024


class Program:
    """twinarm lab, with figures of the operating system."""

    def __init__(self, program, *words):
        command = [program or ROOT / "build/release/twinarm", "lab", "--json", "--no-browser", *map(str, words)]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        if not line:
            sys.exit(f"{' '.join(map(str, command))} ended with {self.process.wait()}")
        self.url = json.loads(line)["url"]

    def stop(self):
        """Its exit code; None: it had to be killed."""
        self.process.send_signal(signal.SIGINT)
        try:
            return self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return None

    def memory(self):
        return resident(self.process.pid)

    def descriptors(self):
        return len(os.listdir(f"/proc/{self.process.pid}/fd"))

    def _schedule(self, name):
        """Time on a processor and time of waiting for one, of a thread [s]; zeros: unknown."""
        for task in pathlib.Path(f"/proc/{self.process.pid}/task").iterdir():
            if (task / "comm").read_text().strip() == name and (task / "schedstat").exists():
                return [1e-9 * int(number) for number in (task / "schedstat").read_text().split()[:2]]
        return [0.0, 0.0]

    def ran(self, name="lab run"):
        return self._schedule(name)[0]

    def waited(self, name="lab run"):
        return self._schedule(name)[1]

    def processor(self):
        """Of each thread, by name and number [s]."""
        times = {}
        for task in pathlib.Path(f"/proc/{self.process.pid}/task").iterdir():
            name, fields = (task / "stat").read_text().rpartition(")")[::2]
            fields = fields.split()
            times[f"{name.partition('(')[2]}/{task.name}"] = (int(fields[11]) + int(fields[12])) / TICK
        return times


class Watcher:
    """A client that measures arrivals of frames and latencies of inputs."""

    def __init__(self, lab):
        self.live = lab.live()
        self.clear()

    def clear(self):
        self.arrivals, self.times, self.ages, self.trips, self.size = [], [], [], [], 0
        self.stamp = None

    def take(self):
        for kind, payload in self.live.pump():
            if kind != "frame":
                continue
            now = time.time()
            head = FRAME_HEAD.unpack_from(payload)
            self.arrivals.append(now)
            self.times.append(head[2])
            self.size += len(payload)
            if head[3] != self.stamp:  # the first message that shows this input
                if self.stamp is not None and head[3] > 0:
                    self.ages.append(head[4])
                    self.trips.append(now - head[3])
                self.stamp = head[3]


class Hand:
    """Oscillates a driven joint about its position."""

    def __init__(self, live):
        self.live, self.next, self.start = live, time.time(), time.time()
        scene, state = json.loads(live.newest["scene"]), json.loads(live.newest["state"])
        driven = [joint["driven"] for joint in scene["joints"] if joint.get("driven") is not None]
        self.index = driven[0] if driven else None
        self.middle = (state.get("hand") or {}).get("q", [0.0])[self.index] if driven else 0.0

    def take(self):
        self.live.do("request_control")
        self.live.do("play", on=True)
        if self.index is not None:
            self.live.do("input", source="joints")

    def move(self):
        now = time.time()
        if now < self.next:
            return
        self.next = max(self.next + 1 / 60, now - 1 / 60)
        if self.index is not None:
            value = self.middle + 0.2 * math.sin(2 * math.pi * 0.5 * (now - self.start))
            self.live.do("joint", index=self.index, value=value, stamp=now)
